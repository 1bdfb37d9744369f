// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/floor_cells.hpp"
#include "core/exploration/frontiers.hpp"
#include "core/exploration/planners.hpp"
#include "core/exploration/surroundings.hpp"
#include "core/exploration/view_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace mapscore {
namespace {

constexpr int kMostLooks = 2;  ///< at a cell that stays a frontier
constexpr double kLookedAt_m =
    1.5;  ///< cells of the frontier nearer to the target count as looked at

class NearestFrontierExplorer : public Explorer {
 public:
  NearestFrontierExplorer(const NearestFrontier& params, const ExploringRobot& robot)
      : params_(params), robot_(robot), search_({}, robot) {}

  ExplorationStep next(const ExplorationState& state) override {
    const Surroundings now(state, robot_, 0.0);
    search_.look(state, now);
    const OccupancyGrid& grid = now.floor.grid();
    ExplorationStep step;
    step.frontiers = find_frontiers(grid, params_.least_m, [&](const GridCell& cell) {
      const auto looks = looks_.find(lattice_cell(grid, cell));
      return looks != looks_.end() && looks->second >= kMostLooks;
    });
    if (std::exchange(first_, false)) {
      step.view = now.turn_on_the_spot();
      return step;
    }
    const double near_m = robot_.radius_m + 3.0 * grid.frame().resolution_m;
    const Frontier* nearest = nullptr;
    std::optional<Approach> way;
    for (const Frontier& frontier : step.frontiers)
      if (const auto found = approach(frontier, grid, now.paths, near_m))
        if (!way || found->way_m < way->way_m) way = found, nearest = &frontier;
    if (way)
      step.view = look_at(*nearest, *way, now);
    else
      look_at_the_rest(state, now, step);
    return step;
  }

 private:
  /// The floor is done: the nearest place from which a view shows enough that is new.
  void look_at_the_rest(const ExplorationState& state, const Surroundings& now,
                        ExplorationStep& step) {
    const std::vector<Prospect> prospects = search_.prospects(state, now);
    const auto nearest = std::ranges::min_element(
        prospects, {}, [](const Prospect& prospect) { return prospect.place.way_m; });
    if (nearest == prospects.end())
      search_.look_once_more(state, now, step);
    else
      step.view = now.view(nearest->place.cell, nearest->yaw_rad);
  }

  /// Towards the unknown beside the part of the frontier that is nearest.
  NextView look_at(const Frontier& frontier, const Approach& way, const Surroundings& now) {
    const OccupancyGrid& grid = now.floor.grid();
    const Eigen::Vector2d target = grid.centre_of(way.target);
    Eigen::Vector2d unknown = Eigen::Vector2d::Zero();
    int count = 0;
    for (const GridCell& cell : frontier.cells) {
      if ((grid.centre_of(cell) - target).norm() > kLookedAt_m) continue;
      ++looks_[lattice_cell(grid, cell)];
      for (int n = 0; n < 9; ++n) {
        const GridCell beside{cell.column + n % 3 - 1, cell.row + n / 3 - 1};
        if (grid.at_or_unknown(beside) != kUnknownCell) continue;
        unknown += grid.centre_of(beside);
        ++count;
      }
    }
    const Eigen::Vector2d from =
        way.place == now.floor.robot_cell()
            ? Eigen::Vector2d(now.floor.T_map_base().x_m, now.floor.T_map_base().y_m)
            : grid.centre_of(way.place);
    const Eigen::Vector2d towards = unknown / std::max(count, 1) - from;
    return now.view(way.place, std::atan2(towards.y(), towards.x()));
  }

  NearestFrontier params_;
  ExploringRobot robot_;
  ViewSearch search_;  ///< for what is left when the floor is known
  std::map<LatticeCell, int> looks_;
  bool first_ = true;
};

}  // namespace

std::unique_ptr<Explorer> make(const NearestFrontier& params, const ExploringRobot& robot,
                               std::uint64_t) {
  return std::make_unique<NearestFrontierExplorer>(params, robot);
}

}  // namespace mapscore
