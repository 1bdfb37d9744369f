// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/drivable_floor.hpp"
#include "core/exploration/explorer.hpp"
#include "core/exploration/floor_paths.hpp"
#include "core/exploration/known_space.hpp"

#include <vector>

namespace mapscore {

/// Where the robot could look from.
struct Lookout {
  GridCell cell;
  Eigen::Vector2d p_map = Eigen::Vector2d::Zero();
  double way_m = 0.0;
};

/// What an explorer makes of what the robot knows, for one decision: space, floor and ways on it.
struct Surroundings {
  /// Throws Error when the robot's place or floor height are not finite, or the map does not carve.
  /// Space reaches a metre beyond the lidar's grid, but at most 25 m from the robot, and from the
  /// floor 3.2 m up. Where camera and lidar leave no way beyond the robot's radius, the floor is
  /// that of DrivableFloor::Trust::lidar.
  Surroundings(const ExplorationState& state, const ExploringRobot& robot, double unsure_below);
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;

  KnownSpace space;
  DrivableFloor floor;
  FloorPaths paths;

  /// The robot's place, and of the roomy cells that it reaches one in each square of edge `step_m`:
  /// the one with most clearance, ties to the earlier; by square.
  [[nodiscard]] std::vector<Lookout> places(double step_m) const;
  /// The same of clear cells that it does not reach.
  [[nodiscard]] std::vector<Lookout> places_out_of_reach(double step_m) const;
  /// The view from a place that is reached.
  [[nodiscard]] NextView view(const GridCell& cell, double yaw_rad) const;
  /// A whole turn: how planners begin that choose places by what is known of the floor.
  [[nodiscard]] NextView turn_on_the_spot() const;
  /// Whether the robot can get no farther than its own radius.
  [[nodiscard]] bool stuck() const;

 private:
  double radius_m_;
};

/// Throws Error when radius or height are not positive, or as check(Calibration).
void check(const ExploringRobot& robot);

}  // namespace mapscore
