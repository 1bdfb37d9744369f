// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/lattice_map.hpp"

#include "core/error.hpp"
#include "eval/map_files/lattice_votes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace mapscore::eval {
namespace {

constexpr double kSameEdge_m = 1e-9;
/// Centres of one lattice often lie on the faces of another; this is more than their rounding.
constexpr double kOnFace_m = 1e-9;
/// By how much candidates are sought beyond a voxel's bounds.
constexpr double kBoundsSlack_m = 1e-6;
constexpr double kFarthestIndex = 1e6;
/// Of a map that is resampled: a small file must not cost gigabytes.
constexpr double kMostVoxels = 5e7, kMostVoxelsAVoxel = 128, kAlwaysResampled = 2e6;

double probability_of(const MapFile& map, std::size_t n) {
  return map.probabilities.empty() ? 1.0 : map.probabilities[n];
}
std::uint32_t instance_of(const MapFile& map, std::size_t n) {
  return map.instances.empty() ? 0 : map.instances[n];
}
bool is_occupied(const MapFile& map, std::size_t n) {
  return map.occupied.empty() || map.occupied[n] != 0;
}

[[noreturn]] void refuse_far(const Eigen::Vector3d& p, double edge_m) {
  throw Error(
      fmt::format("the map reaches ({:.6g}, {:.6g}, {:.6g}) m, beyond 1000000 voxels of {} "
                  "m; is it in metres, and does --transform fit?",
                  p.x(), p.y(), p.z(), edge_m));
}

VoxelKey key_within_range(const Eigen::Vector3d& p, double edge_m) {
  // Negated, so that what is not a number is refused too.
  if (!((p / edge_m).array().abs() <= kFarthestIndex).all()) refuse_far(p, edge_m);
  return voxel_of(p, edge_m);
}

Eigen::Vector3d raised(const Eigen::Vector3d& p) {
  return p + Eigen::Vector3d::Constant(kOnFace_m);
}

LatticeVote vote_of(const MapFile& map, const std::vector<ClassId>& classes, std::size_t n,
                    const VoxelKey& key) {
  return {pack(key),           n,          probability_of(map, n),
          instance_of(map, n), classes[n], is_occupied(map, n)};
}

LatticeMap bin_points(const MapFile& map, const std::vector<ClassId>& classes,
                      const Pose& T_map_file, double edge_m) {
  std::vector<LatticeVote> votes;
  votes.reserve(map.size());
  for (std::size_t n = 0; n < map.size(); ++n)
    votes.push_back(vote_of(map, classes, n, key_within_range(T_map_file * map.points[n], edge_m)));
  return count_votes(std::move(votes), !map.instances.empty());
}

LatticeMap push_centres(const MapFile& map, const std::vector<ClassId>& classes,
                        const Pose& T_map_file, double source_edge_m, double edge_m) {
  std::vector<LatticeVote> votes;
  votes.reserve(map.size());
  for (std::size_t n = 0; n < map.size(); ++n) {
    const Eigen::Vector3d centre = T_map_file * centre_of(map.voxels[n], source_edge_m);
    votes.push_back(vote_of(map, classes, n, key_within_range(raised(centre), edge_m)));
  }
  return count_votes(std::move(votes), !map.instances.empty());
}

/// A voxel of the lattice and the element of the map that it takes after.
struct Target {
  VoxelKey key;
  std::size_t source;
};

LatticeMap map_of(const MapFile& map, const std::vector<ClassId>& classes,
                  std::vector<Target> targets) {
  if (!std::ranges::is_sorted(targets, {}, &Target::key))
    std::ranges::sort(targets, {}, &Target::key);
  LatticeMap on_lattice;
  on_lattice.voxels.reserve(targets.size());
  for (const auto& [key, n] : targets) {
    on_lattice.voxels.push_back({key, classes[n], probability_of(map, n), is_occupied(map, n)});
    if (!map.instances.empty()) on_lattice.instances.push_back(map.instances[n]);
  }
  return on_lattice;
}

LatticeMap as_they_are(const MapFile& map, const std::vector<ClassId>& classes, double edge_m) {
  std::vector<Target> targets;
  targets.reserve(map.size());
  for (std::size_t n = 0; n < map.size(); ++n) {
    const VoxelKey& key = map.voxels[n];
    if (std::max({std::abs(key.i), std::abs(key.j), std::abs(key.k)}) > kFarthestIndex)
      refuse_far(low_corner_of(key, edge_m), edge_m);
    targets.push_back({key, n});
  }
  return map_of(map, classes, std::move(targets));
}

LatticeMap pull_sources(const MapFile& map, const std::vector<ClassId>& classes,
                        const Pose& T_map_file, double source_edge_m, double edge_m) {
  const Pose T_file_map = T_map_file.inverse();
  const double half_m = source_edge_m / 2.0;
  const Eigen::Vector3d reach = T_map_file.linear().cwiseAbs() * Eigen::Vector3d::Constant(half_m) +
                                Eigen::Vector3d::Constant(kBoundsSlack_m - edge_m / 2.0);
  std::vector<Target> targets;
  targets.reserve(map.size());
  for (std::size_t n = 0; n < map.size(); ++n) {
    const VoxelKey& source = map.voxels[n];
    const Eigen::Vector3d centre = T_map_file * centre_of(source, source_edge_m);
    // The voxels whose centres lie within the bounds of the source's corners.
    const VoxelKey low = key_within_range(centre - reach, edge_m);
    const VoxelKey high = key_within_range(centre + reach, edge_m);
    for (std::int32_t i = low.i; i <= high.i; ++i)
      for (std::int32_t j = low.j; j <= high.j; ++j)
        for (std::int32_t k = low.k; k <= high.k; ++k) {
          const Eigen::Vector3d p_file = T_file_map * centre_of({i, j, k}, edge_m);
          if (voxel_of(raised(p_file), source_edge_m) == source) targets.push_back({{i, j, k}, n});
        }
  }
  return map_of(map, classes, std::move(targets));
}

void refuse_too_many(const MapFile& map, double source_edge_m, double edge_m) {
  const double voxels = static_cast<double>(map.size()) * std::pow(source_edge_m / edge_m, 3);
  const double most = std::min(
      kMostVoxels, std::max(kAlwaysResampled, kMostVoxelsAVoxel * static_cast<double>(map.size())));
  if (voxels > most)
    throw Error(
        fmt::format("{} voxels of {} m would become {:.2g} of {} m; score the map with "
                    "--voxel_m {}",
                    map.size(), source_edge_m, voxels, edge_m, source_edge_m));
}

}  // namespace

LatticeMap on_lattice(const MapFile& map, const std::vector<ClassId>& classes,
                      const Pose& T_map_file, double edge_m, Resample resample) {
  assert(classes.size() == map.size());
  const auto placed = [](LatticeMap lattice, Placing placing) {
    lattice.placing = placing;
    return lattice;
  };
  if (map.voxels.empty())
    return placed(bin_points(map, classes, T_map_file, edge_m), Placing::binned);

  const double source_edge_m = map.edge_m > 0.0 ? map.edge_m : edge_m;
  const bool same_edge = std::abs(source_edge_m - edge_m) <= kSameEdge_m;
  if (!same_edge && resample == Resample::refuse)
    throw Error(
        fmt::format("a map of {} m voxels, the truth has {}: give --voxel_m {}, or "
                    "--resample",
                    source_edge_m, edge_m, source_edge_m));
  if (same_edge && T_map_file.matrix() == Eigen::Matrix4d::Identity())
    return as_they_are(map, classes, edge_m);
  if (!same_edge && source_edge_m < edge_m)
    return placed(push_centres(map, classes, T_map_file, source_edge_m, edge_m), Placing::pushed);
  refuse_too_many(map, source_edge_m, edge_m);
  return placed(pull_sources(map, classes, T_map_file, same_edge ? edge_m : source_edge_m, edge_m),
                Placing::pulled);
}

}  // namespace mapscore::eval
