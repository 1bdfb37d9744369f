// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace mapscore::eval {

/// A figure at each pair of an ascending x and an ascending y.
struct DoseGrid {
  std::vector<double> x, y;                   ///< at least two each
  std::vector<std::optional<double>> values;  ///< x varies slowest; nothing is undefined

  [[nodiscard]] const std::optional<double>& at(std::size_t ix, std::size_t iy) const {
    return values.at(ix * y.size() + iy);
  }
  /// Bilinear between the four values about a place of the grid; nothing where one is undefined.
  [[nodiscard]] std::optional<double> between(double place_x, double place_y) const;
};

/// From (x, y) to (x, y).
struct IsoSegment {
  std::array<double, 2> from, to;
};

/// Where the grid has that value: linear within the four triangles that each cell is cut into from
/// its middle, which has the mean of its corners. A cell with an undefined corner has none.
[[nodiscard]] std::vector<IsoSegment> iso_line(const DoseGrid& grid, double level);

}  // namespace mapscore::eval
