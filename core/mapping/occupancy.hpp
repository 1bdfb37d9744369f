// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

namespace mapscore {

/// How one frame changes the occupancy of a voxel, as probabilities, with OctoMap's defaults: the
/// log-odds l = log(p / (1 - p)) of a hit or a miss is added and the sum clamped [R, eq. 9, 10].
/// Single precision, as OctoMap has it. Log-odds of 0 and more are occupied.
struct OccupancyModel {
  double hit = 0.7;           ///< above 0.5
  double miss = 0.4;          ///< below 0.5
  double clamp_min = 0.1192;  ///< below 0.5
  double clamp_max = 0.971;   ///< above 0.5

  bool operator==(const OccupancyModel&) const = default;
};

/// Throws Error naming the number that is out of range: hit and clamp_max must lie in (0.5, 1),
/// miss and clamp_min in (0, 0.5).
void check(const OccupancyModel& model);

}  // namespace mapscore
