// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/occupancy_score.hpp"

#include <algorithm>
#include <span>

namespace mapscore::eval {
namespace {

using Row = OccupancyCounts::Row;

/// Walks through two ascending lists together.
Row answers(const MapSnapshot& map, std::span<const VoxelKey> truth) {
  Row row;
  auto voxel = map.voxels().begin();
  const auto end = map.voxels().end();
  for (const VoxelKey& key : truth) {
    while (voxel != end && voxel->key < key) ++voxel;
    if (voxel == end || voxel->key != key) {
      ++row.unmapped;
    } else {
      ++(voxel->occupied ? row.occupied : row.free);
    }
  }
  return row;
}

}  // namespace

bool carves(const MapSnapshot& map) {
  return !std::ranges::all_of(map.voxels(), &MapVoxel::occupied);
}

OccupancyCounts score_occupancy(const MapSnapshot& map, const OccupancyTruth& truth,
                                const SurfaceTruth& surface) {
  OccupancyCounts counts;
  counts.occupied = answers(map, truth.occupied);
  counts.free = answers(map, truth.free);
  const auto is_known = [&truth](const VoxelKey& key) {
    return std::binary_search(truth.occupied.begin(), truth.occupied.end(), key) ||
           std::binary_search(truth.free.begin(), truth.free.end(), key);
  };
  for (const MapVoxel& voxel : map.voxels()) {
    if (voxel.occupied || !surface.touches_any(voxel.key)) continue;
    counts.free_on_surface += !is_known(voxel.key);
  }
  return counts;
}

std::vector<Metric> occupancy_metrics(const OccupancyCounts& counts) {
  const Row &occupied = counts.occupied, &free = counts.free;
  const std::int64_t said_free = free.free + occupied.free + counts.free_on_surface;
  return {{"occupied_recall", ratio(occupied.occupied, occupied.all())},
          {"free_recall", ratio(free.free, free.all())},
          {"free_precision", ratio(free.free, said_free)},
          {"unknown_share", ratio(occupied.unmapped + free.unmapped, occupied.all() + free.all())}};
}

}  // namespace mapscore::eval
