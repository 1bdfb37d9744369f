// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/floor_cells.hpp"
#include "core/exploration/frontiers.hpp"
#include "core/exploration/planners.hpp"
#include "core/exploration/surroundings.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace mapscore {
namespace {

constexpr double kLeastRun_m = 0.2, kArrived_m = 0.3;
constexpr int kMostFailures = 2;

/// A stretch of a lane that is clear and was not driven yet; from the lower column.
struct Run {
  GridCell first, last;
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
    // The nearest end of a run; ties to the lower lane, then to the lower column.
    std::optional<Run> nearest;
    double least_m = FloorPaths::kNoWay;
    for (const Run& run : runs(now))
      for (const Run& way : {run, Run{run.last, run.first}})
        if (now.paths.cost_m(way.first) < least_m)
          least_m = now.paths.cost_m(way.first), nearest = way;
    if (nearest)
      step.view = drive(*nearest, now);
    else if (now.stuck())
      step.end = ExplorationEnd::nothing_reachable;
    return step;
  }

 private:
  /// Lanes lie along x of the lidar's grid, in rows of cells that are lane_m apart.
  [[nodiscard]] bool in_lane(const OccupancyGrid& grid, const GridCell& cell) const {
    const auto apart =
        std::max<std::int64_t>(1, std::llround(params_.lane_m / grid.frame().resolution_m));
    const std::int64_t row = lattice_cell(grid, cell).second % apart;
    return (row + apart) % apart == apart / 2;
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
  std::vector<LatticeCell> under_way_;  ///< cells of the run that was decided last
  Eigen::Vector2d end_m_ = Eigen::Vector2d::Zero();
  bool first_ = true;
};

}  // namespace

std::unique_ptr<Explorer> make(const LawnMower& params, const ExploringRobot& robot,
                               std::uint64_t) {
  return std::make_unique<LawnMowerExplorer>(params, robot);
}

}  // namespace mapscore
