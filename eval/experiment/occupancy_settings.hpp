// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>

namespace mapscore::eval {

/// Free space, where the map carves it; the numbers are OccupancyModel's.
struct OccupancySettings {
  bool carve = false;
  double hit = 0.7, miss = 0.4, clamp_min = 0.1192, clamp_max = 0.971;
  std::optional<double> max_range_m;
  bool operator==(const OccupancySettings&) const = default;
};

}  // namespace mapscore::eval
