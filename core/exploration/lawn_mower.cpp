// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/floor_cells.hpp"
#include "core/exploration/frontiers.hpp"
#include "core/exploration/planners.hpp"
#include "core/exploration/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace mapscore {
namespace {

constexpr double kLeastRun_m = 0.2, kArrived_m = 0.3;
constexpr int kMostFailures = 2;
constexpr std::size_t kTrail = 4;  ///< places to go back to

/// A stretch of a lane that is clear and was not driven yet; from the lower column.
struct Run {
  GridCell first, last;
};

/// The place nearest to a lane that the robot tried to get to.
struct Attempt {
  std::int64_t rows_off = std::numeric_limits<std::int64_t>::max();
  int tries = 0;
};

class LawnMowerExplorer : public Explorer {
 public:
  LawnMowerExplorer(const LawnMower& params, const ExploringRobot& robot)
      : params_(params), robot_(robot) {}

  ExplorationStep next(const ExplorationState& state) override {
    const Surroundings now(state, robot_, 0.0);
    ExplorationStep step;
    step.frontiers = find_frontiers(now.floor.grid(), 0.3);
    if (std::exchange(first_, false)) {
      step.view = now.turn_on_the_spot();
      return step;
    }
    note_driven(now);
    if (!now.stuck()) trail_.push_back(now.floor.T_map_base());
    if (trail_.size() > kTrail) trail_.erase(trail_.begin());
    // The nearest end of a run; ties to the lower lane, then to the lower column.
    std::optional<Run> nearest;
    double least_m = FloorPaths::kNoWay;
    for (const Run& run : runs(now))
      for (const Run& way : {run, Run{run.last, run.first}})
        if (now.paths.cost_m(way.first) < least_m)
          least_m = now.paths.cost_m(way.first), nearest = way;
    if (nearest) {
      step.view = drive(*nearest, now);
    } else if (now.stuck()) {
      step.view = back(now);
      step.end = ExplorationEnd::nothing_reachable;
      step.reason = "the robot can get no farther than its own radius";
    } else {
      const bool open = now.floor.trust() == DrivableFloor::Trust::lidar;
      if (open || lanes_.empty()) step.view = towards_next_lane(now);
      step.reason = "all lanes that are known are driven";
    }
    return step;
  }

 private:
  /// Rows of cells between lanes.
  [[nodiscard]] std::int64_t rows_apart(const OccupancyGrid& grid) const {
    return std::max<std::int64_t>(1, std::llround(params_.lane_m / grid.frame().resolution_m));
  }
  /// Lanes lie along x of the lidar's grid, in rows of cells that are lane_m apart.
  [[nodiscard]] bool in_lane(const OccupancyGrid& grid, const GridCell& cell) const {
    const std::int64_t apart = rows_apart(grid), row = lattice_cell(grid, cell).second % apart;
    return (row + apart) % apart == apart / 2;
  }

  /// In the open the robot knows floor about itself alone, maybe none of the lanes beside it. It
  /// goes as near to the next one as it can, as long as that brings it nearer, and not twice in
  /// vain.
  [[nodiscard]] std::optional<NextView> towards_next_lane(const Surroundings& now) {
    const OccupancyGrid& grid = now.floor.grid();
    const std::int64_t here = lattice_cell(grid, now.floor.robot_cell()).second;
    for (const std::int64_t lane : next_lanes(here, rows_apart(grid))) {
      const auto off = [&](const GridCell& cell) {
        return std::abs(lattice_cell(grid, cell).second - lane);
      };
      const auto nearest = std::ranges::min_element(
          now.paths.reached(), {},
          [&](const GridCell& cell) { return std::pair(off(cell), now.paths.cost_m(cell)); });
      if (nearest != now.paths.reached().end() && off(*nearest) < std::abs(here - lane)) {
        Attempt& attempt = attempts_[lane];
        if (off(*nearest) < attempt.rows_off) attempt = {off(*nearest), 0};
        if (attempt.tries++ < kMostFailures)
          return now.view(*nearest, std::copysign(0.5 * std::numbers::pi, lane - here));
      }
      out_of_reach_.insert(lane);
    }
    return std::nullopt;
  }

  /// Straight to the last place that it left and that lies farther than its radius, each once: at
  /// the end of a floor nothing may be known but what bars the way on.
  [[nodiscard]] std::optional<NextView> back(const Surroundings& now) {
    const PlanarPose& here = now.floor.T_map_base();
    while (!trail_.empty()) {
      const PlanarPose to = trail_.back();
      trail_.pop_back();
      const Eigen::Vector2d along(to.x_m - here.x_m, to.y_m - here.y_m);
      if (along.norm() <= robot_.radius_m) continue;
      NextView view;
      view.way = {here, {to.x_m, to.y_m, std::atan2(along.y(), along.x())}};
      view.way_m = along.norm();
      return view;
    }
    return std::nullopt;
  }

  /// Rows of the next lanes on both sides of a row that were not taken up yet, the nearer one
  /// first; none behind one that it cannot get to.
  [[nodiscard]] std::vector<std::int64_t> next_lanes(std::int64_t row, std::int64_t apart) const {
    const std::int64_t below = row - ((row - apart / 2) % apart + apart) % apart;
    std::vector<std::int64_t> lanes;
    for (const auto& [first, step] : {std::pair(below, -apart), std::pair(below + apart, apart)}) {
      std::int64_t lane = first;
      while (lanes_.contains(lane)) lane += step;
      if (!out_of_reach_.contains(lane)) lanes.push_back(lane);
    }
    std::ranges::sort(lanes, {}, [row](std::int64_t lane) { return std::abs(lane - row); });
    return lanes;
  }

  /// What is left of every stretch of clear cells between its first and its last cell that was not
  /// driven.
  [[nodiscard]] std::vector<Run> runs(const Surroundings& now) const {
    const OccupancyGrid& grid = now.floor.grid();
    std::vector<Run> runs;
    for (GridCell cell; cell.row < grid.frame().height; ++cell.row) {
      cell.column = 0;
      if (!in_lane(grid, cell)) continue;
      std::optional<Run> run;
      const auto close = [&] {
        if (run &&
            (run->last.column - run->first.column) * grid.frame().resolution_m >= kLeastRun_m)
          runs.push_back(*run);
        run.reset();
      };
      for (; cell.column < grid.frame().width; ++cell.column) {
        if (!now.paths.reaches(cell)) {
          close();
        } else if (!driven_.contains(lattice_cell(grid, cell))) {
          if (!run) run = Run{cell, cell};
          run->last = cell;
        }
      }
      close();
    }
    return runs;
  }

  /// A run counts as driven when the robot got to its end, or was blocked on it twice.
  void note_driven(const Surroundings& now) {
    const PlanarPose& here = now.floor.T_map_base();
    const bool arrived = (Eigen::Vector2d(here.x_m, here.y_m) - end_m_).norm() < kArrived_m;
    for (const LatticeCell& cell : under_way_)
      if (arrived || ++failures_[cell] >= kMostFailures) driven_.insert(cell);
    under_way_.clear();
  }

  NextView drive(const Run& run, const Surroundings& now) {
    const OccupancyGrid& grid = now.floor.grid();
    lanes_.insert(lattice_cell(grid, run.first).second);
    const std::int32_t step = run.last.column > run.first.column ? 1 : -1;
    for (GridCell cell = run.first;; cell.column += step) {
      under_way_.push_back(lattice_cell(grid, cell));
      if (cell == run.last) break;
    }
    const Eigen::Vector2d end = grid.centre_of(run.last);
    end_m_ = end;
    const Eigen::Vector2d along = end - grid.centre_of(run.first);
    const double yaw = std::atan2(along.y(), along.x());
    NextView view = now.view(run.first, yaw);
    view.way.push_back({end.x(), end.y(), yaw});
    view.way_m = length_m(view.way);
    return view;
  }

  LawnMower params_;
  ExploringRobot robot_;
  std::set<LatticeCell> driven_;
  std::map<LatticeCell, int> failures_;
  std::set<std::int64_t> lanes_;              ///< rows of those that were taken up
  std::set<std::int64_t> out_of_reach_;       ///< rows of others
  std::map<std::int64_t, Attempt> attempts_;  ///< to get to a lane, by its row
  std::vector<PlanarPose> trail_;             ///< where it was and could get on
  std::vector<LatticeCell> under_way_;        ///< cells of the run that was decided last
  Eigen::Vector2d end_m_ = Eigen::Vector2d::Zero();
  bool first_ = true;
};

}  // namespace

std::unique_ptr<Explorer> make(const LawnMower& params, const ExploringRobot& robot,
                               std::uint64_t) {
  return std::make_unique<LawnMowerExplorer>(params, robot);
}

}  // namespace mapscore
