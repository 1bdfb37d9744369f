// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/floor_grid.hpp"

#include "core/error.hpp"
#include "tests/eval/truth/truth_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace mapscore::eval {
namespace {

using test::box_shape;

constexpr double kCell_m = 0.1;

/// Four walls 0.1 m thick around 2 m x 1 m of floor, faces off the lattice, and a table whose top
/// is above the cut and whose leg is not.
std::vector<Shape> room() {
  return {box_shape({-0.07, -0.07, 0}, {2.17, 0.03, 2}, 1),
          box_shape({-0.07, 1.03, 0}, {2.17, 1.13, 2}, 1),
          box_shape({-0.07, 0.03, 0}, {0.03, 1.03, 2}, 1),
          box_shape({2.07, 0.03, 0}, {2.17, 1.03, 2}, 1),
          box_shape({0.61, 0.41, 0.7}, {1.49, 0.89, 0.75}, 2),
          box_shape({1.03, 0.63, 0}, {1.08, 0.68, 0.7}, 2)};
}

FloorGridOptions options() {
  return {.height_m = 0.2, .resolution_m = kCell_m, .start_m = {0.5, 0.5}, .way_m = {}, .jobs = 1};
}

std::ptrdiff_t count(const OccupancyGrid& grid, Occupancy value) {
  return std::ranges::count(grid.cells(), value);
}

TEST(FloorGrid, OfARoomCountedByHand) {
  const OccupancyGrid grid = floor_grid(room(), Pose::Identity(), options());
  // Walls touch cells -1 to 21 by -1 to 11, and a cell more lies around them.
  EXPECT_EQ(grid.frame().width, 25);
  EXPECT_EQ(grid.frame().height, 15);
  EXPECT_NEAR(grid.frame().T_map_grid.x_m, -0.2, 1e-12);
  EXPECT_NEAR(grid.frame().T_map_grid.y_m, -0.2, 1e-12);
  // Each wall is two cells thick; inside are columns 1 to 19 and rows 1 to 9, one of them the leg.
  EXPECT_EQ(count(grid, kFreeCell), 19 * 9 - 1);
  EXPECT_EQ(count(grid, kOccupiedCell), 23 * 13 - 19 * 9 + 1);
  EXPECT_EQ(grid.at(grid.cell_of({1.05, 0.65})), kOccupiedCell);
  EXPECT_EQ(grid.at(grid.cell_of({0.85, 0.65})), kFreeCell);  // under the table
  EXPECT_EQ(grid.at({0, 0}), kUnknownCell);
}

TEST(FloorGrid, SeesTheTablesTopAtItsHeight) {
  FloorGridOptions high = options();
  high.height_m = 0.72;
  const OccupancyGrid grid = floor_grid(room(), Pose::Identity(), high);
  EXPECT_EQ(grid.at(grid.cell_of({0.85, 0.65})), kOccupiedCell);
}

TEST(FloorGrid, LiesInTheMapsFrame) {
  // The map's origin is a whole number of cells away, so the cells are the same.
  const Pose T_map_world = map_from_world({0.7, -0.3, 0.0}, 0.0);
  FloorGridOptions moved = options();
  moved.start_m = {0.5 - 0.7, 0.5 + 0.3};
  const OccupancyGrid grid = floor_grid(room(), T_map_world, moved);
  EXPECT_EQ(grid.cells(), floor_grid(room(), Pose::Identity(), options()).cells());
  EXPECT_NEAR(grid.frame().T_map_grid.x_m, -0.9, 1e-9);
  EXPECT_NEAR(grid.frame().T_map_grid.y_m, 0.1, 1e-9);
}

TEST(FloorGrid, DoesNotDependOnThreads) {
  FloorGridOptions many = options();
  many.jobs = 4;
  EXPECT_EQ(floor_grid(room(), Pose::Identity(), many),
            floor_grid(room(), Pose::Identity(), options()));
}

TEST(FloorGrid, RefusesWhatHasNoFloor) {
  const auto refused = [](FloorGridOptions wrong, const char* why) {
    try {
      (void)floor_grid(room(), Pose::Identity(), wrong);
      ADD_FAILURE() << why;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  FloorGridOptions wrong = options();
  wrong.height_m = 5.0;
  refused(wrong, "no surface at height 5");
  wrong = options();
  wrong.start_m = {1.05, 0.65};
  refused(wrong, "lies in something");
}

TEST(FloorGrid, ReachesToAStartAndAWayBesideAllSurfaces) {
  FloorGridOptions beside = options();
  beside.start_m = {2.95, 0.55};
  beside.way_m = {{2.95, 1.75}, {-0.55, 0.55}};
  const OccupancyGrid grid = floor_grid(room(), Pose::Identity(), beside);
  EXPECT_EQ(grid.frame().width, 36 + 2);   // columns -6 to 29, and one more on either side
  EXPECT_EQ(grid.frame().height, 19 + 2);  // rows -1 to 17, and one more
  EXPECT_EQ(grid.at(grid.cell_of({2.95, 1.75})), kFreeCell);
  EXPECT_EQ(grid.at(grid.cell_of({-0.55, 0.55})), kFreeCell);  // around the room
  EXPECT_EQ(grid.at(grid.cell_of({0.5, 0.5})), kUnknownCell);  // the walls are closed
}

}  // namespace
}  // namespace mapscore::eval
