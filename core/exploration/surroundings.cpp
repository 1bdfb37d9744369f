// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/surroundings.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace mapscore {
namespace {

constexpr double kSpaceMargin_m = 1.0, kSpaceReach_m = 25.0, kCeiling_m = 3.2;

Eigen::AlignedBox3d space_about(const ExplorationState& state) {
  const PlanarPose& T = state.T_map_base;
  if (!(std::isfinite(T.x_m) && std::isfinite(T.y_m) && std::isfinite(T.yaw_rad) &&
        std::isfinite(state.floor_m)))
    throw Error("T_map_base, floor_m: not finite; give the robot's place in metres and radians");
  const Eigen::Vector2d robot(T.x_m, T.y_m);
  Eigen::AlignedBox2d box(robot);
  const GridFrame& frame = state.floor.frame();
  const double r = frame.resolution_m;
  for (const double x : {0.0, frame.width * r})
    for (const double y : {0.0, frame.height * r})
      box.extend(frame.T_map_grid * Eigen::Vector2d(x, y));
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kSpaceMargin_m);
  const Eigen::Vector2d far = Eigen::Vector2d::Constant(kSpaceReach_m);
  const Eigen::Vector2d low = (box.min() - margin).cwiseMax(robot - far);
  const Eigen::Vector2d high = (box.max() + margin).cwiseMin(robot + far);
  return {Eigen::Vector3d(low.x(), low.y(), state.floor_m),
          Eigen::Vector3d(high.x(), high.y(), state.floor_m + kCeiling_m)};
}

/// The clearest cell of each square of the cells that `wanted` takes.
std::vector<Lookout> one_a_square(const DrivableFloor& floor, double step_m, auto&& wanted) {
  const OccupancyGrid& grid = floor.grid();
  const auto per_square =
      std::max(1, static_cast<std::int32_t>(std::lround(step_m / grid.frame().resolution_m)));
  std::vector<Lookout> places;
  for (std::int32_t row = 0; row < grid.frame().height; row += per_square)
    for (std::int32_t column = 0; column < grid.frame().width; column += per_square) {
      std::optional<GridCell> best;
      for (std::int32_t n = 0; n < per_square * per_square; ++n) {
        const GridCell cell{column + n % per_square, row + n / per_square};
        if (!wanted(cell)) continue;
        if (!best || floor.squared_clearance(cell) > floor.squared_clearance(*best)) best = cell;
      }
      if (best) places.push_back({*best, grid.centre_of(*best), 0.0});
    }
  return places;
}

/// Whether ways lead no farther than the robot's radius.
bool leads_nowhere(const FloorPaths& paths, const DrivableFloor& floor, double radius_m) {
  const PlanarPose& T = floor.T_map_base();
  return std::ranges::none_of(paths.reached(), [&](const GridCell& cell) {
    return (floor.grid().centre_of(cell) - Eigen::Vector2d(T.x_m, T.y_m)).norm() > radius_m;
  });
}

/// Where camera and lidar leave no way, the lidar alone is trusted.
DrivableFloor floor_for(const ExplorationState& state, const ExploringRobot& robot,
                        const KnownSpace& space) {
  DrivableFloor floor(state, robot, space);
  if (!leads_nowhere(FloorPaths(floor), floor, robot.radius_m)) return floor;
  return {state, robot, space, DrivableFloor::Trust::lidar};
}

}  // namespace

void check(const ExploringRobot& robot) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  if (!positive(robot.radius_m) || !positive(robot.height_m))
    throw Error("robot: radius_m and height_m must be positive lengths in metres");
  check(robot.cameras);
}

Surroundings::Surroundings(const ExplorationState& state, const ExploringRobot& robot,
                           double unsure_below)
    : space(state.map, space_about(state), unsure_below),
      floor(floor_for(state, robot, space)),
      paths(floor),
      radius_m_(robot.radius_m) {}

NextView Surroundings::turn_on_the_spot() const {
  const PlanarPose& here = floor.T_map_base();
  NextView view;
  for (int third = 0; third <= 3; ++third)
    view.way.push_back(
        {here.x_m, here.y_m, wrapped_angle(here.yaw_rad + third * 2.0 / 3.0 * std::numbers::pi)});
  return view;
}

bool Surroundings::stuck() const {
  return leads_nowhere(paths, floor, radius_m_);
}

std::vector<Lookout> Surroundings::places(double step_m) const {
  const PlanarPose& T = floor.T_map_base();
  std::vector<Lookout> places{{floor.robot_cell(), {T.x_m, T.y_m}, 0.0}};
  for (Lookout& place : one_a_square(floor, step_m, [&](const GridCell& cell) {
         return paths.reaches(cell) && !floor.narrow(cell) && !(cell == floor.robot_cell());
       })) {
    place.way_m = paths.cost_m(place.cell);
    places.push_back(place);
  }
  return places;
}

std::vector<Lookout> Surroundings::places_out_of_reach(double step_m) const {
  return one_a_square(floor, step_m, [&](const GridCell& cell) {
    return floor.clear(cell) && !paths.reaches(cell);
  });
}

NextView Surroundings::view(const GridCell& cell, double yaw_rad) const {
  NextView view;
  view.way = paths.way_to(cell, wrapped_angle(yaw_rad));
  view.way_m = length_m(view.way);
  return view;
}

}  // namespace mapscore
