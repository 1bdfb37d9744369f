// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/explore/visible_surface.hpp"

#include "core/geometry/depth_rays.hpp"
#include "core/geometry/voxel.hpp"
#include "core/geometry/voxel_packer.hpp"

#include <algorithm>
#include <utility>

namespace mapscore::eval {
namespace {

/// A point of the cloud in its voxel, for sorting.
struct Landed {
  std::uint64_t voxel;
  ClassId class_id;
  auto operator<=>(const Landed&) const = default;
};

std::vector<Landed> landed(const std::vector<SurfacePoint>& cloud, const ClassTable& table,
                           const Pose& T_map_world, double edge_m) {
  const VoxelPacker voxel_of(T_map_world, edge_m);
  std::vector<Landed> points;
  points.reserve(cloud.size());
  for (const SurfacePoint& point : cloud) {
    const Eigen::Vector3d p = point.p_world.cast<double>();
    const std::uint64_t voxel = voxel_of(p.x(), p.y(), p.z());
    if (voxel != VoxelPacker::kNone) points.push_back({voxel, table.class_of(point.instance)});
  }
  std::ranges::sort(points);
  return points;
}

/// The class with most points of one voxel, ties to the lower id.
ClassId owner_of(std::span<const Landed> points) {
  ClassId owner = points.front().class_id;
  std::size_t most = 0;
  for (auto first = points.begin(); first != points.end();) {
    const auto last = std::find_if(first, points.end(), [&](const Landed& point) {
      return point.class_id != first->class_id;
    });
    if (static_cast<std::size_t>(last - first) > most) {
      most = static_cast<std::size_t>(last - first);
      owner = first->class_id;
    }
    first = last;
  }
  return owner;
}

double f1_of(double precision, double recall) {
  return precision + recall > 0.0 ? 2.0 * precision * recall / (precision + recall) : 0.0;
}

double ratio(std::size_t part, std::size_t all) {
  return all == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(all);
}

}  // namespace

VisibleSurface::VisibleSurface(const std::vector<SurfacePoint>& cloud, SurfaceTruth surface,
                               const ClassTable& table, const Pose& T_map_world)
    : surface_(std::move(surface)), table_(table) {
  const double edge_m = surface_.edge_m();
  const std::vector<Landed> points = landed(cloud, table, T_map_world, edge_m);
  std::vector<VisibleVoxel> detected;
  for (auto first = points.begin(); first != points.end();) {
    const auto last = std::find_if(
        first, points.end(), [&](const Landed& point) { return point.voxel != first->voxel; });
    const VoxelKey key = unpack(first->voxel);
    if (surface_.touches_any(key)) {
      const ClassId owner = owner_of({first, last});
      const bool counts = table.detected(owner) && surface_.contains(key, owner);
      positions_.emplace(first->voxel, static_cast<std::uint32_t>(class_of_.size()));
      class_of_.push_back(counts ? owner : kBackground);
      if (counts) detected.push_back({key, owner, static_cast<std::uint32_t>(last - first)});
    }
    first = last;
  }
  visible_ = VisibleTruth(std::move(detected), edge_m);
}

std::size_t VisibleSurface::find(std::uint64_t packed) const {
  const auto found = positions_.find(packed);
  return found == positions_.end() ? class_of_.size() : found->second;
}

MapState VisibleSurface::state_of(const SemanticMap& map, double threshold) const {
  const SemanticOcTree& tree = map.tree();
  std::size_t predicted = 0, right = 0, found = 0;
  double known_m3 = 0.0;
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    const double size_m = leaf.getSize();
    known_m3 += size_m * size_m * size_m;
    if (leaf->beliefs().empty() || !tree.isNodeOccupied(*leaf)) continue;
    const ClassProbability best = leaf->best();
    if (!table_.detected(best.class_id) || best.probability < threshold) continue;
    for_each_finest(tree, leaf, [&](const VoxelKey& key) {
      ++predicted;
      right += surface_.contains(key, best.class_id) ? 1 : 0;
      found += visible_.owner_of(key) == best.class_id ? 1 : 0;
    });
  }
  MapState state{ratio(right, predicted), ratio(found, visible_.voxels().size()), 0.0, known_m3};
  state.f1 = f1_of(state.precision, state.recall);
  return state;
}

SeenSurface::SeenSurface(const VisibleSurface& surface, const Calibration& truth,
                         const Pose& T_map_world)
    : surface_(surface), truth_(truth), T_map_world_(T_map_world), is_seen_(surface.size()) {}

void SeenSurface::add(const Frame& frame) {
  const DepthRays rays(truth_.depth);
  const VoxelPacker voxel_of(T_map_world_ * frame.T_world_base * truth_.T_base_depth,
                             surface_.edge_m());
  std::uint64_t last = VoxelPacker::kNone;  // neighbouring pixels mostly share a voxel
  for (int v = 0; v < frame.depth.rows; ++v) {
    for (int u = 0; u < frame.depth.cols; ++u) {
      const double z_m = frame.depth(v, u) / kDepthUnitsPerMetre;
      if (z_m == 0.0 || z_m < truth_.range_min_m || z_m > truth_.range_max_m) continue;
      const Eigen::Vector3d p = rays.point(u, v, z_m);
      const std::uint64_t voxel = voxel_of(p.x(), p.y(), p.z());
      if (voxel == last || voxel == VoxelPacker::kNone) continue;
      last = voxel;
      const std::size_t position = surface_.find(voxel);
      if (position == surface_.size() || is_seen_[position]) continue;
      is_seen_[position] = true;
      ++seen_;
      seen_detected_ += surface_.is_detected(position) ? 1 : 0;
    }
  }
}

}  // namespace mapscore::eval
