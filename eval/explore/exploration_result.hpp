// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/explorer.hpp"
#include "eval/explore/exploration_curve.hpp"
#include "eval/recording/stamp_list.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// How the way to a view ended.
enum class WayEnd { arrived, blocked, stuck, budget };
constexpr auto names_of(WayEnd) {
  return std::to_array<std::string_view>({"arrived", "blocked", "stuck", "budget"});
}

/// A view that the planner chose, and what became of it.
struct ChosenView {
  double stamp_s = 0.0, driven_m = 0.0;  ///< when it was chosen
  PlanarPose T_world_base;               ///< where it looks from, as the robot believes
  double way_m = 0.0, unknown_voxels = 0.0, unsure_voxels = 0.0;  ///< as the planner expects
  WayEnd end = WayEnd::arrived;
  std::string obstacle;  ///< body that blocked the way; empty where none did
};

/// What the robot knew of the floor when it chose a view, or at the end; frame map.
struct FloorMoment {
  double stamp_s = 0.0, driven_m = 0.0;
  OccupancyGrid floor;
  std::vector<Eigen::Vector2d> frontier;  ///< centres of its cells
};

/// What a robot that keeps objects met of them.
struct MetObjects {
  std::size_t kept = 0;                     ///< at the end
  std::size_t missed = 0, found_again = 0;  ///< should have been seen and were not; and later were
};

/// What an exploration came to.
struct ExplorationResult {
  ExplorationEnd end = ExplorationEnd::budget;
  std::string reason;  ///< for people
  ExplorationCurve curve;
  std::vector<ChosenView> views;
  std::vector<FloorMoment> moments;    ///< at each view, and at the end
  std::vector<TrajectoryPose> frames;  ///< true poses
  double driven_m = 0.0, duration_s = 0.0;
  std::size_t bump_contacts = 0;
  std::optional<MetObjects> objects;
  double slowest_plan_s = 0.0, plans_s = 0.0;  ///< processor time of the planner, measured
};

}  // namespace mapscore::eval
