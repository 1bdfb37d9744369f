// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/map_snapshot.hpp"
#include "eval/score/metrics.hpp"
#include "eval/truth/occupancy_truth.hpp"
#include "eval/truth/surface_truth.hpp"

#include <cstdint>
#include <vector>

namespace mapscore::eval {

/// What a map says of voxels whose truth is known. Integers.
struct OccupancyCounts {
  /// Voxels of one truth by the map's answer.
  struct Row {
    std::int64_t occupied = 0, free = 0, unmapped = 0;
    [[nodiscard]] std::int64_t all() const { return occupied + free + unmapped; }
    bool operator==(const Row&) const = default;
  };
  Row occupied;                      ///< truly occupied
  Row free;                          ///< truly free
  std::int64_t free_on_surface = 0;  ///< free in the map, neither truly occupied nor truly free, in
                                     ///< some S

  bool operator==(const OccupancyCounts&) const = default;
};

/// True when the map holds voxels known to be free; others are not to be scored for occupancy.
[[nodiscard]] bool carves(const MapSnapshot& map);

/// Counts of a map against the truth on the same lattice. Linear in the voxels. Thread-safe.
[[nodiscard]] OccupancyCounts score_occupancy(const MapSnapshot& map, const OccupancyTruth& truth,
                                              const SurfaceTruth& surface);

/// occupied_recall, free_recall, free_precision, unknown_share, in this order.
[[nodiscard]] std::vector<Metric> occupancy_metrics(const OccupancyCounts& counts);

}  // namespace mapscore::eval
