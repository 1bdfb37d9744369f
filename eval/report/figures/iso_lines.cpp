// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/iso_lines.hpp"

#include <algorithm>

namespace mapscore::eval {
namespace {

struct Corner {
  std::array<double, 2> place;
  double value;
};

/// Position of the cell of a grid line that holds a place.
std::size_t cell_of(const std::vector<double>& line, double place) {
  const auto after = std::ranges::upper_bound(line, place) - line.begin();
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after - 1, 0, std::ssize(line) - 2));
}

std::array<double, 2> crossing(const Corner& a, const Corner& b, double level) {
  const double share = (level - a.value) / (b.value - a.value);
  return {a.place[0] + share * (b.place[0] - a.place[0]),
          a.place[1] + share * (b.place[1] - a.place[1])};
}

void cut_triangle(const std::array<Corner, 3>& corners, double level,
                  std::vector<IsoSegment>& segments) {
  std::vector<std::array<double, 2>> ends;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &a = corners[i], &b = corners[(i + 1) % 3];
    if ((a.value < level) != (b.value < level)) ends.push_back(crossing(a, b, level));
  }
  if (ends.size() == 2 && ends[0] != ends[1]) segments.push_back({ends[0], ends[1]});
}

/// Around the cell whose low corner this is; empty where a corner is undefined.
std::vector<Corner> corners_of(const DoseGrid& grid, std::size_t ix, std::size_t iy) {
  std::vector<Corner> corners;
  for (const auto& [x, y] : {std::pair{ix, iy}, {ix + 1, iy}, {ix + 1, iy + 1}, {ix, iy + 1}}) {
    if (!grid.at(x, y)) return {};
    corners.push_back({{grid.x[x], grid.y[y]}, *grid.at(x, y)});
  }
  return corners;
}

}  // namespace

std::optional<double> DoseGrid::between(double place_x, double place_y) const {
  const std::size_t ix = cell_of(x, place_x), iy = cell_of(y, place_y);
  const std::vector<Corner> corners = corners_of(*this, ix, iy);
  if (corners.empty()) return std::nullopt;
  const double u = (place_x - x[ix]) / (x[ix + 1] - x[ix]);
  const double v = (place_y - y[iy]) / (y[iy + 1] - y[iy]);
  return (1 - v) * ((1 - u) * corners[0].value + u * corners[1].value) +
         v * (u * corners[2].value + (1 - u) * corners[3].value);
}

std::vector<IsoSegment> iso_line(const DoseGrid& grid, double level) {
  std::vector<IsoSegment> segments;
  for (std::size_t ix = 0; ix + 1 < grid.x.size(); ++ix)
    for (std::size_t iy = 0; iy + 1 < grid.y.size(); ++iy) {
      const std::vector<Corner> corners = corners_of(grid, ix, iy);
      if (corners.empty()) continue;
      Corner middle{{}, 0.0};
      for (const Corner& corner : corners) {
        for (const std::size_t axis : {0, 1}) middle.place[axis] += corner.place[axis] / 4;
        middle.value += corner.value / 4;
      }
      for (std::size_t i = 0; i < 4; ++i)
        cut_triangle({corners[i], corners[(i + 1) % 4], middle}, level, segments);
    }
  return segments;
}

}  // namespace mapscore::eval
