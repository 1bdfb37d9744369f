// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/floor_paths.hpp"

#include "core/exploration/floor_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <queue>
#include <utility>

namespace mapscore {
namespace {

struct Step {
  std::int32_t column, row;
};
constexpr std::array<Step, 8> kSteps{
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

Eigen::Vector2d place_of(const PlanarPose& pose) {
  return {pose.x_m, pose.y_m};
}

constexpr double kNarrowCost = 4.0;

}  // namespace

FloorPaths::FloorPaths(const DrivableFloor& floor, const GridCell& start)
    : floor_(floor), cost_m_(floor.grid().cells().size(), kNoWay), before_(cost_m_.size(), -1) {
  if (floor.grid().contains(start)) search(start);
}

void FloorPaths::search(const GridCell& from) {
  const OccupancyGrid& grid = floor_.grid();
  const double r = grid.frame().resolution_m;
  using Open = std::pair<double, std::size_t>;  // length, then index
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  const std::size_t start = grid.index(from);
  cost_m_[start] = 0.0;
  before_[start] = static_cast<std::int32_t>(start);
  open.emplace(0.0, start);
  while (!open.empty()) {
    const auto [length, index] = open.top();
    open.pop();
    if (length > cost_m_[index]) continue;
    const auto at = static_cast<std::int32_t>(index);
    const GridCell cell{at % grid.frame().width, at / grid.frame().width};
    for (const Step& step : kSteps) {
      const GridCell next{cell.column + step.column, cell.row + step.row};
      const bool diagonal = step.column != 0 && step.row != 0;
      if (!floor_.clear(next)) continue;
      if (diagonal &&
          !(floor_.clear({next.column, cell.row}) && floor_.clear({cell.column, next.row})))
        continue;
      const double step_m = diagonal ? std::numbers::sqrt2 * r : r;
      const double longer = length + (floor_.narrow(next) ? kNarrowCost * step_m : step_m);
      const std::size_t to = grid.index(next);
      if (!(longer < cost_m_[to])) continue;
      cost_m_[to] = longer;
      before_[to] = at;
      open.emplace(longer, to);
    }
  }
  for (GridCell cell; cell.row < grid.frame().height; ++cell.row)
    for (cell.column = 0; cell.column < grid.frame().width; ++cell.column)
      if (reaches(cell)) reached_.push_back(cell);
}

std::optional<int> FloorPaths::narrow_cells(const Eigen::Vector2d& from,
                                            const Eigen::Vector2d& to) const {
  bool clear = true;
  int narrow = 0;
  walk_cells(floor_.grid().lattice_point(from), floor_.grid().lattice_point(to),
             [&](const GridCell& cell) {
               if (cell == floor_.robot_cell()) return true;
               clear = floor_.clear(cell);
               if (clear && floor_.narrow(cell)) ++narrow;
               return clear;
             });
  return clear ? std::optional(narrow) : std::nullopt;
}

std::vector<PlanarPose> FloorPaths::way_to(const GridCell& cell, double yaw_rad) const {
  const OccupancyGrid& grid = floor_.grid();
  const PlanarPose& start = floor_.T_map_base();
  if (cell == floor_.robot_cell()) return {start, {start.x_m, start.y_m, yaw_rad}};
  std::vector<Eigen::Vector2d> places;  // backwards
  std::vector<int> narrow;              // of each, 1 where its cell is
  for (std::size_t at = grid.index(cell);;) {
    const auto index = static_cast<std::int32_t>(at);
    const auto before = static_cast<std::size_t>(before_[at]);
    if (before == at) break;
    const GridCell passed{index % grid.frame().width, index / grid.frame().width};
    places.push_back(grid.centre_of(passed));
    narrow.push_back(floor_.narrow(passed) ? 1 : 0);
    at = before;
  }
  std::ranges::reverse(places);
  std::ranges::reverse(narrow);
  std::vector<PlanarPose> way{start};
  for (std::size_t n = 0; n < places.size();) {
    const Eigen::Vector2d from = place_of(way.back());
    std::size_t last = places.size() - 1;
    int allowed = std::accumulate(narrow.begin() + static_cast<std::ptrdiff_t>(n), narrow.end(), 0);
    for (; last > n; allowed -= narrow[last--])
      if (const auto passed = narrow_cells(from, places[last]); passed && *passed <= allowed) break;
    const Eigen::Vector2d leg = places[last] - from;
    way.back().yaw_rad = std::atan2(leg.y(), leg.x());
    way.push_back({places[last].x(), places[last].y(), yaw_rad});
    n = last + 1;
  }
  way.front().yaw_rad = start.yaw_rad;
  return way;
}

double length_m(const std::vector<PlanarPose>& way) {
  double length = 0.0;
  for (std::size_t n = 1; n < way.size(); ++n)
    length += (place_of(way[n]) - place_of(way[n - 1])).norm();
  return length;
}

}  // namespace mapscore
