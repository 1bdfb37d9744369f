// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/scan_grid.hpp"

#include "core/error.hpp"
#include "core/exploration/floor_cells.hpp"
#include "core/space/occupancy.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore {
namespace {

constexpr double kFarthestScan_m = 1000.0;
constexpr double kGridBlock = 64.0;  ///< cells that the grid grows by
constexpr std::uint8_t kMissed = 1, kHit = 2;

float log_odds_of(double p) {
  return static_cast<float>(std::log(p / (1.0 - p)));
}

void check(const PlanarPose& T) {
  if (!(std::abs(T.x_m) < kFarthestScan_m && std::abs(T.y_m) < kFarthestScan_m &&
        std::isfinite(T.yaw_rad)))
    throw Error(
        "T_map_base: is not finite, or farther than 1 km from the map's origin; give x, y "
        "in metres and yaw in radians");
}

}  // namespace

ScanGrid::ScanGrid(double resolution_m)
    : grid_({resolution_m, {}, 1, 1}), log_odds_(1, 0.0f), marks_(1, 0) {}

void ScanGrid::add(const LaserScan& scan, const PlanarPose& T_map_base) {
  check(T_map_base);
  const PlanarPose T_map_lidar = T_map_base * scan.T_base_lidar;
  const Eigen::Vector2d from(T_map_lidar.x_m, T_map_lidar.y_m);
  std::vector<Eigen::Vector2d> ends;
  Eigen::Vector2d low = from, high = from;
  for (const Beam& beam : beams_of(scan, scan.ranges_m.size())) {
    if (!beam.hit) continue;
    const double angle = T_map_lidar.yaw_rad + beam.angle_rad;
    ends.push_back(from + beam.range_m * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    low = low.cwiseMin(ends.back()), high = high.cwiseMax(ends.back());
  }
  grow_to(low, high);

  std::fill(marks_.begin(), marks_.end(), std::uint8_t{0});
  const Eigen::Vector2d start = grid_.lattice_point(from);
  for (const Eigen::Vector2d& end : ends) {
    walk_cells(start, grid_.lattice_point(end), [&](const GridCell& cell) {
      std::uint8_t& mark = marks_[grid_.index(cell)];
      mark = std::max(mark, kMissed);
      return true;
    });
    marks_[grid_.index(grid_.cell_of(end))] = kHit;
  }
  count_turn();
}

void ScanGrid::count_turn() {
  const OccupancyModel model;
  const float hit = log_odds_of(model.hit), miss = log_odds_of(model.miss);
  const float least = log_odds_of(model.clamp_min), most = log_odds_of(model.clamp_max);
  const std::int32_t width = grid_.frame().width;
  for (std::size_t n = 0; n < marks_.size(); ++n) {
    if (marks_[n] == 0) continue;
    log_odds_[n] = std::clamp(log_odds_[n] + (marks_[n] == kHit ? hit : miss), least, most);
    const auto at = static_cast<std::int32_t>(n);
    grid_.set({at % width, at / width}, log_odds_[n] >= 0.0f ? kOccupiedCell : kFreeCell);
  }
}

void ScanGrid::grow_to(const Eigen::Vector2d& low_m, const Eigen::Vector2d& high_m) {
  const GridFrame& old = grid_.frame();
  const double r = old.resolution_m;
  const Eigen::Vector2d origin(old.T_map_grid.x_m, old.T_map_grid.y_m);
  // In blocks from the map's origin; the first turn places the grid.
  const auto down = [&](double x) { return std::floor(x / (kGridBlock * r)); };
  Eigen::Array2d first(down(low_m.x()), down(low_m.y()));
  Eigen::Array2d last(down(high_m.x()), down(high_m.y()));
  if (old.width > 1) {
    const Eigen::Array2d old_first = (origin / (kGridBlock * r)).array().round();
    first = first.min(old_first);
    last = last.max(old_first + Eigen::Array2d(old.width, old.height) / kGridBlock - 1.0);
  }
  const Eigen::Array2d size = (last - first + 1.0) * kGridBlock;
  if (size.x() == old.width && size.y() == old.height) return;

  OccupancyGrid grid({r,
                      {first.x() * kGridBlock * r, first.y() * kGridBlock * r, 0.0},
                      static_cast<std::int32_t>(size.x()),
                      static_cast<std::int32_t>(size.y())});
  std::vector<float> log_odds(grid.cells().size(), 0.0f);
  const Eigen::Array2d moved = (origin / r).array().round() - first * kGridBlock;
  if (old.width > 1)
    for (GridCell cell; cell.row < old.height; ++cell.row)
      for (cell.column = 0; cell.column < old.width; ++cell.column) {
        const GridCell to{cell.column + static_cast<std::int32_t>(moved.x()),
                          cell.row + static_cast<std::int32_t>(moved.y())};
        grid.set(to, grid_.at(cell));
        log_odds[grid.index(to)] = log_odds_[grid_.index(cell)];
      }
  grid_ = std::move(grid);
  log_odds_ = std::move(log_odds);
  marks_.assign(log_odds_.size(), 0);
}

}  // namespace mapscore
