// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/drivable_floor.hpp"

#include "core/error.hpp"
#include "core/exploration/scan_grid.hpp"
#include "core/exploration/surroundings.hpp"
#include "tests/core/exploration/drawn_grid.hpp"
#include "tests/core/exploration/flat_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mapscore::testing {
namespace {

/// A robot that looked around in the first of two rooms.
struct LookedAround {
  BoxFlat flat = two_rooms();
  FlatRun run;

  explicit LookedAround(double noise = 0.0) : run(flat, {2.6, 1.6, 0.0}, noise) {
    run.drive({{2.6, 1.6, 2.1}, {2.6, 1.6, -2.1}, {2.6, 1.6, 0.0}});
  }
};

Occupancy at(const DrivableFloor& floor, double x, double y) {
  return floor.grid().at_or_unknown(floor.grid().cell_of({x, y}));
}

// The lidar, at 0.2 m, sees the floor below the table free.
TEST(DrivableFloor, TableTopsAreObstaclesAndFloorThatNobodySawIsNone) {
  for (const double noise : {0.0, 1.0}) {
    LookedAround here(noise);
    const ExplorationState state = here.run.state();
    const Surroundings now(state, flat_robot(), 0.0);
    EXPECT_EQ(state.floor.at_or_unknown(state.floor.cell_of({1.4, 2.8})), kFreeCell);
    EXPECT_EQ(at(now.floor, 1.4, 2.8), kOccupiedCell) << noise;
    EXPECT_EQ(at(now.floor, 1.5, 1.6), kFreeCell) << noise;
    EXPECT_EQ(at(now.floor, 2.6, 1.6), kFreeCell) << noise;
    EXPECT_EQ(at(now.floor, 4.5, 0.3), kUnknownCell)
        << noise;  // beside the door, in the other room
    EXPECT_TRUE(now.floor.clear(now.floor.robot_cell())) << noise;
  }
}

// In the open no ray of the camera ends in anything, and the map stays unknown; beams of the lidar
// end in a sector of 60 degrees alone, at 2 m. Rather than nowhere the robot drives there.
TEST(DrivableFloor, WhereTheCameraLeavesNoWayTheLidarAloneSaysWhatIsFree) {
  const SemanticMap map(0.05, Carving{.carve = true});
  ScanGrid grid;
  LaserScan scan{{}, -0.5, 0.01, 0.15, 12.0, std::vector<float>(101, 2.0f)};
  grid.add(scan, {0.0, 0.0, 0.0});
  const OccupancyGrid seen = grid.grid();
  const ExplorationState state{map, seen, {0.0, 0.0, 0.0}};
  const Surroundings now(state, flat_robot(), 0.0);
  EXPECT_EQ(at(DrivableFloor(state, flat_robot(), now.space), 1.0, 0.1), kUnknownCell);
  EXPECT_EQ(at(now.floor, 1.0, 0.1), kFreeCell);
  EXPECT_FALSE(now.stuck());
  EXPECT_TRUE(now.paths.reaches(now.floor.grid().cell_of({1.2, 0.0})));
  EXPECT_EQ(at(now.floor, -1.0, 0.0), kUnknownCell);
}

TEST(DrivableFloor, ClearCellsKeepTheRadiusFromEverything) {
  for (const double noise : {0.0, 1.0}) {
    LookedAround here(noise);
    const ExplorationState state = here.run.state();
    const ExploringRobot robot = flat_robot();
    const Surroundings now(state, robot, 0.0);
    int clear = 0;
    const OccupancyGrid& grid = now.floor.grid();
    for (GridCell cell; cell.row < grid.frame().height; ++cell.row)
      for (cell.column = 0; cell.column < grid.frame().width; ++cell.column) {
        if (!now.floor.clear(cell)) continue;
        ++clear;
        // A surface may lie half a cell before the centre of its cell.
        const double least = robot.radius_m - (now.floor.narrow(cell) ? 0.025 : 0.0);
        EXPECT_GE(here.flat.clearance(grid.centre_of(cell), robot.height_m), least);
      }
    EXPECT_GT(clear, 500) << noise;
  }
}

TEST(DrivableFloor, OnTheHandWorkedGridCellsAreClearByDistance) {
  const OccupancyGrid grid = drawn_grid({"#######",  //
                                         "#.....#",  //
                                         "#.....#",  //
                                         "#.....#",  //
                                         "#.....#",  //
                                         "#.....#",  //
                                         "#######"});
  // The radius of 1.5 cells, half a diagonal and half an edge make 2.71 cells: the middle is roomy,
  // and no other cell clear.
  const DrivableFloor floor(grid, {0.35, 0.35, 0.0}, 0.15);
  for (GridCell cell; cell.row < 7; ++cell.row)
    for (cell.column = 0; cell.column < 7; ++cell.column)
      EXPECT_EQ(floor.clear(cell), cell == (GridCell{3, 3})) << cell.column << ' ' << cell.row;
  EXPECT_FALSE(floor.narrow({3, 3}));
  EXPECT_TRUE(DrivableFloor(grid, {0.35, 0.35, 0.0}, 0.19).narrow({3, 3}));
  EXPECT_EQ(floor.squared_clearance({3, 3}), 9);
  EXPECT_EQ(floor.squared_clearance({1, 3}), 1);
}

// Near the wall it may turn away, not go nearer.
TEST(DrivableFloor, ARobotNearSomethingMayLeave) {
  OccupancyGrid grid({0.05, {}, 60, 60}, kFreeCell);
  for (std::int32_t row = 0; row < 60; ++row) grid.set({0, row}, kOccupiedCell);
  const DrivableFloor floor(grid, {0.25, 1.0, 0.0}, 0.3);
  EXPECT_TRUE(floor.clear(floor.robot_cell()));
  EXPECT_TRUE(floor.clear({6, 20}));
  EXPECT_FALSE(floor.clear({4, 20}));
  EXPECT_FALSE(floor.clear({5, 40}));
}

TEST(DrivableFloor, RefusesAPlaceThatIsNone) {
  const SemanticMap map(0.05, Carving{.carve = true});
  const OccupancyGrid grid({0.05, {}, 10, 10});
  const PlanarPose nowhere{std::numeric_limits<double>::quiet_NaN(), 0, 0};
  EXPECT_THROW(Surroundings({map, grid, nowhere}, flat_robot(), 0.0), Error);
}

}  // namespace
}  // namespace mapscore::testing
