// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/exploration.hpp"
#include "core/parameters.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <variant>

namespace mapscore::eval {

/// What a study has that explores nothing.
struct NoExploration : NoFields {
  static constexpr std::string_view kKind = "none";
  static constexpr std::string_view kMeaning = "nobody explores: the robot drives its waypoints";
};

template <class First, class Others>
struct Preceded;
template <class First, class... Others>
struct Preceded<First, std::variant<Others...>> {
  using Choice = std::variant<First, Others...>;
};

/// Who chooses the way: nobody, or a planner of core.
using PlannerChoice = Preceded<NoExploration, Exploration>::Choice;

/// An exploration (docs/exploration.md): the robot chooses its own way, on wheels.
struct ExplorationSettings {
  PlannerChoice planner;
  std::optional<std::array<double, 3>> start_m_deg;  ///< empty: drawn by the seed
  double budget_m = 60, budget_s = 1200;
  int budget_views = 500;
  double floor_cell_m = 0.05;
  double look_again_voxels = 0;
  double score_every_m = 2;

  static void fields(auto& s, auto&& visit) {
    visit(s.planner, later({"planner", "who chooses the way, for `mapscore explore`"}));
    visit(s.start_m_deg,
          Field{"start_m_deg",
                "x, y and heading of the start, in the scene's world; default: drawn by the seed "
                "from the largest floor that is connected"});
    visit(s.budget_m, later({"budget_m", "the exploration ends after this way", above(0, 1e5)}));
    visit(s.budget_s, later({"budget_s", "and after this time of the drive", above(0, 14400)}));
    visit(s.budget_views, later({"budget_views", "and after so many views", {1, 1000000}}));
    visit(s.floor_cell_m,
          later({"floor_cell_m", "edge of a cell of the lidar's grid of the floor", {0.01, 1}}));
    visit(s.look_again_voxels,
          later({"look_again_voxels",
                 "worth of a look at an object that should have been seen and was not, in unknown "
                 "voxels, for next_best_view; 0: the robot keeps no objects",
                 {0, 1e6}}));
    visit(s.score_every_m,
          later({"score_every_m", "the map is scored at each view, and so often along the way",
                 above(0, 1e5)}));
  }
  bool operator==(const ExplorationSettings&) const = default;
};

}  // namespace mapscore::eval
