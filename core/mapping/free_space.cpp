// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/free_space.hpp"

#include "core/error.hpp"
#include "core/mapping/semantic_octree.hpp"
#include "core/space/octomap_ray.hpp"
#include "core/space/space_grid.hpp"

#include <cmath>

namespace mapscore {
namespace {

/// OctoMap's voxel of a coordinate. It multiplies by the inverse of the edge, which differs from
/// voxel_of within a rounding of a plane.
std::int32_t octomap_index(float coordinate, double inverse_edge) {
  return static_cast<std::int32_t>(std::floor(inverse_edge * coordinate));
}
VoxelKey octomap_voxel(const Point3f& p, double inverse_edge) {
  return {octomap_index(p[0], inverse_edge), octomap_index(p[1], inverse_edge),
          octomap_index(p[2], inverse_edge)};
}

Point3f octomap_centre(const VoxelKey& key, double edge_m) {
  const auto centre = [&](std::int32_t index) {
    return static_cast<float>((static_cast<double>(index) + 0.5) * edge_m);
  };
  return {centre(key.i), centre(key.j), centre(key.k)};
}

bool within_span(const Eigen::Vector3d& p, double edge_m) {
  constexpr double kSpan = 1 << 15;
  return (p.array() >= -kSpan * edge_m).all() && (p.array() < kSpan * edge_m).all();
}

/// One ray after the other from the same origin.
class Rays {
 public:
  Rays(const Eigen::Vector3d& origin, double edge_m, std::optional<double> max_range_m)
      : origin_{static_cast<float>(origin.x()), static_cast<float>(origin.y()),
                static_cast<float>(origin.z())},
        edge_m_(edge_m),
        inverse_edge_(1.0 / edge_m),
        max_range_m_(max_range_m),
        first_(octomap_voxel(origin_, inverse_edge_)) {}

  [[nodiscard]] const VoxelKey& first() const { return first_; }

  /// Frees what the ray to the centre of `last`, which is hit, passes; unless that lies beyond the
  /// range, where the ray ends and nothing is hit.
  void cast(const VoxelKey& last, SpaceGrid& grid) const {
    const Point3f centre = octomap_centre(last, edge_m_);
    if (!max_range_m_) return free_to(centre, last, grid);
    Point3f way{centre[0] - origin_[0], centre[1] - origin_[1], centre[2] - origin_[2]};
    const float squared = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
    const double length = std::sqrt(static_cast<double>(squared));
    if (length <= *max_range_m_) return free_to(centre, last, grid);
    grid.clear_hit(grid.place_of(last));
    const auto range = static_cast<float>(*max_range_m_);
    Point3f end;
    for (std::size_t n = 0; n < 3; ++n)
      end[n] = origin_[n] + way[n] / static_cast<float>(length) * range;
    free_to(end, octomap_voxel(end, inverse_edge_), grid);
  }

 private:
  void free_to(const Point3f& end, const VoxelKey& last, SpaceGrid& grid) const {
    OctomapRay(origin_, end, first_, last, edge_m_)
        .walk(grid.place_of(first_), grid.strides(),
              [&](std::ptrdiff_t place) { grid.set_free(place); });
  }

  Point3f origin_;
  double edge_m_, inverse_edge_;
  std::optional<double> max_range_m_;
  VoxelKey first_;
};

}  // namespace

SeenSpace seen_space(const Eigen::Vector3d& origin, std::span<const Eigen::Vector3d> points,
                     double edge_m, std::optional<double> max_range_m,
                     std::span<const VoxelKey> also_hit) {
  if (!(edge_m > 0.0) || !std::isfinite(edge_m))
    throw Error("voxel_m: must be a positive length in metres");
  if (max_range_m && !(*max_range_m > 0.0))
    throw Error("max_range_m: must be a positive length in metres");
  if (!within_span(origin, edge_m))
    throw Error("origin: must be finite and within 2^15 voxels of the map's origin");
  const Rays rays(origin, edge_m, max_range_m);
  VoxelBounds bounds{rays.first(), rays.first()};
  SeenSpace seen;
  std::vector<VoxelKey> ends;
  ends.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    if (!within_span(point, edge_m)) {
      ++seen.points_left_out;
      continue;
    }
    const VoxelKey key = voxel_of(point, edge_m);
    if (!ends.empty() && ends.back() == key) continue;
    ends.push_back(key);
    bounds.include(key);
  }
  for (const VoxelKey& key : also_hit)
    if (fits_octree(key)) bounds.include(key);
  bounds.include(rays.first());
  SpaceGrid grid(bounds);
  std::erase_if(ends, [&](const VoxelKey& end) {
    const std::ptrdiff_t place = grid.place_of(end);
    const bool known = grid.is_hit(place);
    grid.set_hit(place);
    return known;
  });
  for (const VoxelKey& end : ends) rays.cast(end, grid);
  for (const VoxelKey& key : also_hit)
    if (fits_octree(key)) grid.set_hit(grid.place_of(key));
  seen.blocks = grid.blocks();
  return seen;
}

}  // namespace mapscore
