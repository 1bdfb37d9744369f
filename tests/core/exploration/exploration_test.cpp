// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/exploration.hpp"

#include "core/error.hpp"
#include "tests/core/exploration/flat_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace mapscore::testing {
namespace {

constexpr PlanarPose kStart{2.6, 1.6, 0.5};

std::vector<Exploration> planners() {
  DrawnWaypoints drawn;
  drawn.T_map_waypoints = {{2.6, 1.6, 2.5}, {2.6, 1.6, 0.0}, {4.2, 1.65, 0.0}, {4.2, 1.65, 1.2}};
  return {NextBestView{}, NearestFrontier{}, RandomView{}, LawnMower{}, drawn};
}

FlatRun::Result run(const Exploration& exploration, const BoxFlat& flat, std::uint64_t seed,
                    int most_views = 300, double noise = 0.0) {
  FlatRun robot(flat, kStart, noise);
  return robot.explore(*make_explorer(exploration, flat_robot(), seed), most_views);
}

class EachPlanner : public ::testing::TestWithParam<std::size_t> {
 protected:
  Exploration planner = planners()[GetParam()];
};

TEST_P(EachPlanner, ExploresTwoRoomsWithoutABump) {
  const FlatRun::Result result = run(planner, two_rooms(), 3);
  ASSERT_TRUE(result.end.has_value());
  EXPECT_EQ(*result.end, ExplorationEnd::explored);
  EXPECT_GT(result.views, 2);
  EXPECT_GE(result.least_clearance_m, flat_robot().radius_m);
  EXPECT_GT(result.way_m, 1.5);  // through the door
}

TEST_P(EachPlanner, DecidesTheSameFromTheSameStates) {
  const BoxFlat flat = two_rooms();
  const FlatRun::Result once = run(planner, flat, 5, 6, 1.0), again = run(planner, flat, 5, 6, 1.0);
  EXPECT_EQ(once.poses, again.poses);
  EXPECT_EQ(once.way_m, again.way_m);
}

INSTANTIATE_TEST_SUITE_P(Exploration, EachPlanner, ::testing::Range<std::size_t>(0, 5),
                         [](const auto& one) {
                           return std::string(kind_of(planners()[one.param]));
                         });

// The robot is 0.5 m wide: a door of 0.4 m shows a room that it cannot get to.
TEST(Exploration, ADoorThatIsTooNarrowIsSaidAndNotDrivenThrough) {
  for (const Exploration& planner : {Exploration(NextBestView{}), Exploration(NearestFrontier{})}) {
    const FlatRun::Result result = run(planner, two_rooms(0.4), 2);
    ASSERT_TRUE(result.end.has_value()) << kind_of(planner);
    EXPECT_EQ(*result.end, ExplorationEnd::nothing_reachable) << kind_of(planner);
    EXPECT_GE(result.least_clearance_m, flat_robot().radius_m);
    for (const PlanarPose& view : result.poses) EXPECT_LT(view.x_m, 3.5);
  }
}

// Walls all around at 0.3 m: it turns, and says that it cannot get anywhere.
TEST(Exploration, WhoStandsBoxedInEndsSoon) {
  for (const Exploration& planner : planners()) {
    if (std::holds_alternative<DrawnWaypoints>(planner)) continue;
    BoxFlat flat(6.0, 4.0);
    flat.add(2.1, 1.3, 0, 2.3, 1.9, 0.5), flat.add(2.9, 1.3, 0, 3.1, 1.9, 0.5);
    flat.add(2.1, 1.1, 0, 3.1, 1.3, 0.5), flat.add(2.1, 1.9, 0, 3.1, 2.1, 0.5);
    const FlatRun::Result result = run(planner, flat, 2);
    ASSERT_TRUE(result.end.has_value()) << kind_of(planner);
    EXPECT_EQ(*result.end, ExplorationEnd::nothing_reachable) << kind_of(planner);
    EXPECT_LT(result.way_m, 0.5);
    EXPECT_LT(result.views, 60);
  }
}

// A lidar and a camera within a cupboard see nothing.
TEST(Exploration, WhoStartsWithinFurnitureEndsSoon) {
  for (const Exploration& planner : planners()) {
    if (std::holds_alternative<DrawnWaypoints>(planner)) continue;
    const SemanticMap map(0.05, Carving{.carve = true});
    ScanGrid grid;
    LaserScan scan{{}, 0.0, 0.1, 0.15, 12.0, std::vector<float>(60, 0.16f)};
    grid.add(scan, kStart);
    const auto explorer = make_explorer(planner, flat_robot(), 1);
    int views = 0;
    ExplorationStep step = explorer->next({map, grid.grid(), kStart});
    for (; step.view && views < 300; ++views) {
      EXPECT_LT(step.view->way_m, flat_robot().radius_m);
      step = explorer->next({map, grid.grid(), step.view->way.back()});
    }
    EXPECT_LT(views, 300) << kind_of(planner);
    EXPECT_EQ(step.end, ExplorationEnd::nothing_reachable) << kind_of(planner);
  }
}

// A bare floor of 6 m x 6 m, whose end alone is known: no beam and no image shows any of it.
TEST(Exploration, LanesAreDrivenInTheOpenToo) {
  OccupancyGrid grid({0.05, {}, 120, 120});
  for (std::int32_t n = 0; n < 120; ++n)
    for (const GridCell cell : {GridCell{n, 0}, {n, 119}, {0, n}, {119, n}})
      grid.set(cell, kOccupiedCell);
  const SemanticMap map(0.05, Carving{.carve = true});
  const auto explorer = make_explorer(LawnMower{}, flat_robot(), 1);
  ExplorationState state{map, grid, {3.0, 3.0, 0.0}};
  std::map<int, double> least_m, greatest_m;  // x of the places in each row of a metre
  int views = 0;
  ExplorationStep step = explorer->next(state);
  for (; step.view && views < 500; step = explorer->next(state), ++views) {
    state.T_map_base = step.view->way.back();
    const int row = static_cast<int>(std::floor(state.T_map_base.y_m));
    const double x_m = state.T_map_base.x_m;
    least_m[row] = least_m.contains(row) ? std::min(least_m[row], x_m) : x_m;
    greatest_m[row] = std::max(greatest_m[row], x_m);
  }
  EXPECT_EQ(step.end, ExplorationEnd::explored);
  EXPECT_EQ(step.reason, "all lanes that are known are driven");
  EXPECT_LT(views, 500);
  EXPECT_EQ(least_m.size(), 6u);  // a lane in each
  int long_lanes = 0;
  for (const auto& [row, x_m] : least_m) long_lanes += greatest_m[row] - x_m > 4.5 ? 1 : 0;
  EXPECT_GE(long_lanes, 5);  // of the first lane it drives what is before it
}

// Where something bars the way and nothing else is known, lanes go on from where it came from,
// once.
TEST(Exploration, TheLawnMowerGoesBackFromWhereItIsBarred) {
  OccupancyGrid grid({0.05, {}, 120, 120});
  const SemanticMap map(0.05, Carving{.carve = true});
  const auto explorer = make_explorer(LawnMower{}, flat_robot(), 1);
  ExplorationState state{map, grid, {3.0, 3.0, 0.0}};
  ASSERT_TRUE(explorer->next(state).view);  // the turn
  ASSERT_TRUE(explorer->next(state).view);
  state.T_map_base.x_m = 4.0;
  grid.set(grid.cell_of({4.2, 3.0}), kOccupiedCell);
  const ExplorationStep step = explorer->next(state);
  ASSERT_TRUE(step.view);
  EXPECT_EQ(step.view->way.front(), state.T_map_base);
  EXPECT_EQ(step.view->way.back(), (PlanarPose{3.0, 3.0, std::numbers::pi}));
  const ExplorationStep last = explorer->next(state);
  EXPECT_FALSE(last.view);
  EXPECT_EQ(last.end, ExplorationEnd::nothing_reachable);
  EXPECT_EQ(last.reason, "the robot can get no farther than its own radius");
}

// A robot that something stopped before a waypoint goes on to the next; the end says it.
TEST(Exploration, DrawnWaypointsThatWereNotReachedAreCounted) {
  const OccupancyGrid grid({0.05, {}, 120, 120});
  const SemanticMap map(0.05, Carving{.carve = true});
  DrawnWaypoints drawn;
  drawn.T_map_waypoints = {{4.0, 3.0, 0.0}, {3.0, 3.0, 0.0}};
  for (const double stopped_x_m : {4.0, 3.5}) {
    const auto explorer = make_explorer(drawn, flat_robot(), 1);
    ExplorationState state{map, grid, {3.0, 3.0, 0.0}};
    ASSERT_TRUE(explorer->next(state).view);
    state.T_map_base.x_m = stopped_x_m;
    ASSERT_TRUE(explorer->next(state).view);
    state.T_map_base.x_m = 3.0;
    const ExplorationStep last = explorer->next(state);
    EXPECT_FALSE(last.view);
    EXPECT_EQ(last.reason, stopped_x_m == 4.0
                               ? "all waypoints were driven to"
                               : "all waypoints were driven to, but 1 of 2 not reached");
  }
}

// Noise has closed the door to a room that is seen through it: before it gives up, it goes near and
// looks at what bars it; and when that stays, it ends.
TEST(Exploration, ABarIsLookedAtOnceMore) {
  const BoxFlat flat = two_rooms();
  FlatRun robot(flat, {2.9, 1.5, 0.0});
  robot.drive({{2.9, 1.5, 0.4}, {2.9, 1.5, -0.4}, kStart});
  const auto explorer = make_explorer(NextBestView{}, flat_robot(), 1);
  const ExplorationState seen = robot.state();
  OccupancyGrid closed = seen.floor;
  for (GridCell cell; cell.row < closed.frame().height; ++cell.row)
    for (cell.column = 0; cell.column < closed.frame().width; ++cell.column)
      if (std::abs(closed.centre_of(cell).x() - 3.5) < 0.06) closed.set(cell, kOccupiedCell);
  ExplorationState state{seen.map, closed, kStart};
  std::vector<PlanarPose> views;
  ExplorationStep step = explorer->next(state);
  for (; step.view && views.size() < 200; step = explorer->next(state))
    views.push_back(state.T_map_base = step.view->way.back());
  EXPECT_LT(views.size(), 200u);
  EXPECT_EQ(step.end, ExplorationEnd::nothing_reachable);
  ASSERT_FALSE(views.empty());
  EXPECT_GT(views.back().x_m, 2.4);  // from near the door, towards it
  EXPECT_LT(std::abs(wrapped_angle(views.back().yaw_rad)), 1.0);
}

// It would be explored, but something in the second room is to be looked at again; and then it is.
TEST(Exploration, WhatWasMissedIsLookedAtAgain) {
  const BoxFlat flat = two_rooms();
  FlatRun robot(flat, kStart);
  const auto explorer = make_explorer(NextBestView{}, flat_robot(), 1);
  ASSERT_EQ(robot.explore(*explorer, 300).end, ExplorationEnd::explored);
  ExplorationState state = robot.state();
  const Eigen::Vector3d p_map(5.5, 2.4, 0.6);
  state.again = {{p_map, 500.0}};
  ExplorationStep step = explorer->next(state);
  ASSERT_TRUE(step.view.has_value());
  const PlanarPose& to = step.view->way.back();
  const double bearing = std::atan2(p_map.y() - to.y_m, p_map.x() - to.x_m);
  EXPECT_LT(std::abs(wrapped_angle(bearing - to.yaw_rad)), 0.5);
  int looks = 0;
  for (; step.view && looks < 30; ++looks) {
    robot.drive(step.view->way);
    state.T_map_base = step.view->way.back();
    step = explorer->next(state);
  }
  EXPECT_LT(looks, 30);  // each look in vain halves what the next is worth
}

TEST(Exploration, RefusesRobotsMapsAndParametersThatAreNone) {
  ExploringRobot flat_one = flat_robot();
  flat_one.radius_m = 0.0;
  EXPECT_THROW(static_cast<void>(make_explorer(NextBestView{}, flat_one, 1)), Error);
  NextBestView coarse;
  coarse.place_step_m = 0.0;
  EXPECT_THROW(static_cast<void>(make_explorer(coarse, flat_robot(), 1)), Error);
  const SemanticMap solid(0.05);
  const OccupancyGrid grid({0.05, {}, 4, 4});
  for (const Exploration& planner : planners()) {
    if (std::holds_alternative<DrawnWaypoints>(planner)) continue;
    EXPECT_THROW(
        static_cast<void>(make_explorer(planner, flat_robot(), 1)->next({solid, grid, {}})), Error);
  }
}

}  // namespace
}  // namespace mapscore::testing
