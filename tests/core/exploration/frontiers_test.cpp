// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/frontiers.hpp"

#include "tests/core/exploration/drawn_grid.hpp"

#include <gtest/gtest.h>

namespace mapscore::testing {
namespace {

TEST(Frontiers, AClosedRoomHasNone) {
  EXPECT_TRUE(find_frontiers(drawn_grid({"####", "#..#", "#..#", "####"}), 0.0).empty());
}

// The room is open to the right over three cells, and below over one.
TEST(Frontiers, AreTheFreeCellsBesideUnknownOnes) {
  const OccupancyGrid grid = drawn_grid({"####  ",  //
                                         "#...  ",  //
                                         "#...  ",  //
                                         "#...  ",  //
                                         "#.##  ",  //
                                         "      "});
  const auto frontiers = find_frontiers(grid, 0.0);
  ASSERT_EQ(frontiers.size(), 2u);
  EXPECT_EQ(frontiers[0].cells, (std::vector<GridCell>{{1, 1}}));
  EXPECT_EQ(frontiers[1].cells, (std::vector<GridCell>{{3, 2}, {3, 3}, {3, 4}}));
  EXPECT_NEAR(frontiers[1].centre_m.x(), 0.35, 1e-12);
  EXPECT_NEAR(frontiers[1].centre_m.y(), 0.35, 1e-12);
}

TEST(Frontiers, ShortOnesAndThoseLeftOutAreNone) {
  const OccupancyGrid grid =
      drawn_grid({"####  ", "#...  ", "#...  ", "#...  ", "#.##  ", "      "});
  EXPECT_EQ(find_frontiers(grid, 0.2).size(), 1u);
  EXPECT_EQ(find_frontiers(grid, 0.4).size(), 0u);
  const auto left = find_frontiers(grid, 0.0, [](const GridCell& cell) { return cell.row == 3; });
  ASSERT_EQ(left.size(), 3u);  // the one to the right falls apart
  EXPECT_EQ(left[1].cells, (std::vector<GridCell>{{3, 2}}));
}

TEST(Frontiers, AreConnectedThroughCorners) {
  const OccupancyGrid grid = drawn_grid({"#.  ",  //
                                         "#.. ",  //
                                         "####"});
  ASSERT_EQ(find_frontiers(grid, 0.0).size(), 1u);
  EXPECT_EQ(find_frontiers(grid, 0.0)[0].cells.size(), 2u);
}

// A unknown cell beyond the grid's border counts.
TEST(Frontiers, ReachTheBorderOfTheGrid) {
  EXPECT_EQ(find_frontiers(drawn_grid({"..", ".."}), 0.0)[0].cells.size(), 4u);
}

TEST(Frontiers, AreApproachedByTheShortestWay) {
  const OccupancyGrid grid = drawn_grid({"########  ",  //
                                         "#.......  ",  //
                                         "#.......  ",  //
                                         "#.......  ",  //
                                         "########  "});
  const DrivableFloor floor(grid, {0.25, 0.25, 0.0}, 0.05);
  const FloorPaths paths(floor);
  const auto frontiers = find_frontiers(grid, 0.0);
  ASSERT_EQ(frontiers.size(), 1u);
  // Column 5 is two cells and a half at most from the frontier, and its row 2 nearest to the robot.
  const auto way = approach(frontiers[0], grid, paths, 0.25);
  ASSERT_TRUE(way.has_value());
  EXPECT_EQ(way->place, (GridCell{5, 2}));
  EXPECT_NEAR(way->way_m, 0.3, 1e-12);
  EXPECT_FALSE(approach(frontiers[0], grid, paths, 0.05).has_value());
}

}  // namespace
}  // namespace mapscore::testing
