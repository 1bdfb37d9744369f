// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/lattice_map.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <tuple>

namespace mapscore::eval {
namespace {

constexpr double kSameEdge_m = 1e-9;
/// Centres of one lattice often lie on the faces of another; this is more than their rounding.
constexpr double kOnFace_m = 1e-9;
/// By how much candidates are sought beyond a voxel's bounds.
constexpr double kBoundsSlack_m = 1e-6;
/// Of a map that is resampled: a small file must not cost gigabytes.
constexpr double kMostVoxels = 5e7, kMostVoxelsAVoxel = 128, kAlwaysResampled = 2e6;

double probability_of(const MapFile& map, std::size_t n) {
  return map.probabilities.empty() ? 1.0 : map.probabilities[n];
}
std::uint32_t instance_of(const MapFile& map, std::size_t n) {
  return map.instances.empty() ? 0 : map.instances[n];
}

[[noreturn]] void refuse_far(const Eigen::Vector3d& p, double edge_m) {
  throw Error(
      fmt::format("the map reaches ({:.6g}, {:.6g}, {:.6g}) m, beyond 1000000 voxels of {} "
                  "m; is it in metres (else give --scale), and does --transform fit?",
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

/// What one point, or one finer voxel, says of a voxel of the lattice.
struct LatticeVote {
  std::uint64_t packed_key = 0;
  std::size_t number = 0;  ///< of the vote; settles the order of summation
  double probability = 1.0;
  std::uint32_t instance = 0;
  ClassId class_id = kBackground;
  bool occupied = true;
};

/// The leading votes that `same` holds for, together with the first.
template <class Same>
std::span<const LatticeVote> run_of(std::span<const LatticeVote> votes, Same same) {
  std::size_t count = 1;
  while (count < votes.size() && same(votes[0], votes[count])) ++count;
  return votes.first(count);
}

/// Votes for the class with most of them; they come sorted by class.
std::span<const LatticeVote> winners_of(std::span<const LatticeVote> votes) {
  std::span<const LatticeVote> winners;
  while (!votes.empty()) {
    const auto of_class = run_of(
        votes, [](const LatticeVote& a, const LatticeVote& b) { return a.class_id == b.class_id; });
    if (of_class.size() > winners.size()) winners = of_class;
    votes = votes.subspan(of_class.size());
  }
  return winners;
}

std::uint32_t common_instance_of(std::span<const LatticeVote> winners) {
  std::vector<std::uint32_t> instances;
  for (const LatticeVote& vote : winners) instances.push_back(vote.instance);
  std::ranges::sort(instances);
  std::uint32_t best = 0;
  std::ptrdiff_t most = 0;
  for (auto from = instances.begin(); from != instances.end();) {
    const auto to = std::upper_bound(from, instances.end(), *from);
    if (to - from > most) {
      most = to - from;
      best = *from;
    }
    from = to;
  }
  return best;
}

MapVoxel voxel_of_winners(std::span<const LatticeVote> winners) {
  double sum = 0.0;
  for (const LatticeVote& vote : winners) sum += vote.probability;
  return {unpack(winners[0].packed_key), winners[0].class_id,
          sum / static_cast<double>(winners.size()), winners[0].occupied};
}

/// Counts the votes by voxel, by the rules of `on_lattice`.
LatticeMap count_votes(std::vector<LatticeVote> votes, bool has_instances) {
  std::ranges::sort(votes, {}, [](const LatticeVote& vote) {
    return std::tuple(vote.packed_key, !vote.occupied, vote.class_id, vote.number);
  });
  LatticeMap map;
  for (std::span<const LatticeVote> rest(votes); !rest.empty();) {
    const auto of_voxel = run_of(rest, [](const LatticeVote& a, const LatticeVote& b) {
      return a.packed_key == b.packed_key;
    });
    const auto counted = run_of(of_voxel, [](const LatticeVote& a, const LatticeVote& b) {
      return a.occupied == b.occupied;
    });
    const auto winners = winners_of(counted);
    map.voxels.push_back(voxel_of_winners(winners));
    if (has_instances) map.instances.push_back(common_instance_of(winners));
    rest = rest.subspan(of_voxel.size());
  }
  return map;
}

/// Each element votes for the voxel that holds p_map_of(its number).
template <class PositionOf>
LatticeMap by_votes(const MapFile& map, const std::vector<ClassId>& classes, double edge_m,
                    PositionOf p_map_of) {
  std::vector<LatticeVote> votes;
  votes.reserve(map.size());
  for (std::size_t n = 0; n < map.size(); ++n)
    votes.push_back({pack(key_within_range(p_map_of(n), edge_m)), n, probability_of(map, n),
                     instance_of(map, n), classes[n], map.is_occupied(n)});
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
    on_lattice.voxels.push_back({key, classes[n], probability_of(map, n), map.is_occupied(n)});
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
  const auto point = [&](std::size_t n) -> Eigen::Vector3d { return T_map_file * map.points[n]; };
  if (map.voxels.empty()) return placed(by_votes(map, classes, edge_m, point), Placing::binned);

  const double source_edge_m = map.edge_m > 0.0 ? map.edge_m : edge_m;
  const bool same_edge = std::abs(source_edge_m - edge_m) <= kSameEdge_m;
  if (!same_edge && resample == Resample::refuse)
    throw Error(
        fmt::format("a map of {} m voxels, the truth has {}: give --voxel_m {}, or "
                    "--resample",
                    source_edge_m, edge_m, source_edge_m));
  if (same_edge && T_map_file.matrix() == Eigen::Matrix4d::Identity())
    return as_they_are(map, classes, edge_m);
  const auto centre = [&](std::size_t n) {
    return raised(T_map_file * centre_of(map.voxels[n], source_edge_m));
  };
  if (!same_edge && source_edge_m < edge_m)
    return placed(by_votes(map, classes, edge_m, centre), Placing::pushed);
  refuse_too_many(map, source_edge_m, edge_m);
  return placed(pull_sources(map, classes, T_map_file, same_edge ? edge_m : source_edge_m, edge_m),
                Placing::pulled);
}

}  // namespace mapscore::eval
