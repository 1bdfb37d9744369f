// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/occupancy_grid.hpp"

#include <string>
#include <vector>

namespace mapscore::testing {

/// A grid as drawn, the first line at the greatest y: `.` free, `#` occupied, ` ` unknown. Its low
/// corner is the map's origin.
inline OccupancyGrid drawn_grid(const std::vector<std::string>& lines, double resolution_m = 0.1) {
  const auto height = static_cast<std::int32_t>(lines.size());
  const auto width = static_cast<std::int32_t>(lines.front().size());
  OccupancyGrid grid({resolution_m, {}, width, height});
  for (GridCell cell; cell.row < height; ++cell.row)
    for (cell.column = 0; cell.column < width; ++cell.column) {
      const char sign = lines[static_cast<std::size_t>(height - 1 - cell.row)]
                             [static_cast<std::size_t>(cell.column)];
      if (sign != ' ') grid.set(cell, sign == '#' ? kOccupiedCell : kFreeCell);
    }
  return grid;
}

}  // namespace mapscore::testing
