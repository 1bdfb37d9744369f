// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/floor_paths.hpp"

#include "core/random_stream.hpp"
#include "tests/core/exploration/drawn_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mapscore::testing {
namespace {

/// Lengths by relaxing every edge until nothing changes (Bellman and Ford).
std::vector<double> plain_lengths(const DrivableFloor& floor) {
  const OccupancyGrid& grid = floor.grid();
  std::vector<double> lengths(grid.cells().size(), FloorPaths::kNoWay);
  lengths[grid.index(floor.robot_cell())] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (GridCell cell; cell.row < grid.frame().height; ++cell.row)
      for (cell.column = 0; cell.column < grid.frame().width; ++cell.column)
        for (int n = 0; n < 9; ++n) {
          const GridCell from{cell.column + n % 3 - 1, cell.row + n / 3 - 1};
          if (from == cell || !floor.clear(cell) || !grid.contains(from)) continue;
          const bool diagonal = from.column != cell.column && from.row != cell.row;
          if (diagonal && !floor.clear({cell.column, from.row})) continue;
          if (diagonal && !floor.clear({from.column, cell.row})) continue;
          const double length = lengths[grid.index(from)] + (diagonal ? std::numbers::sqrt2 : 1.0) *
                                                                (floor.narrow(cell) ? 4.0 : 1.0) *
                                                                grid.frame().resolution_m;
          if (length < lengths[grid.index(cell)] - 1e-12)
            lengths[grid.index(cell)] = length, changed = true;
        }
  }
  return lengths;
}

OccupancyGrid random_floor(RandomStream& stream) {
  OccupancyGrid grid({0.1, {-1.0, -0.5, 0.0}, 30, 25}, kFreeCell);
  for (int n = 0; n < 12; ++n) {
    const auto pick = [&](int below) {
      return static_cast<std::int32_t>(stream.uniform() * below);
    };
    const GridCell low{pick(28), pick(23)};
    for (GridCell cell = low; cell.row < std::min(25, low.row + 1 + pick(4)); ++cell.row)
      for (cell.column = low.column; cell.column < std::min(30, low.column + 3); ++cell.column)
        grid.set(cell, n % 3 == 0 ? kUnknownCell : kOccupiedCell);
  }
  return grid;
}

/// A robot's place in a free cell of the grid.
PlanarPose some_place(const OccupancyGrid& grid, RandomStream& stream) {
  for (;;) {
    const GridCell cell{static_cast<std::int32_t>(stream.uniform() * grid.frame().width),
                        static_cast<std::int32_t>(stream.uniform() * grid.frame().height)};
    if (grid.at(cell) != kFreeCell) continue;
    const Eigen::Vector2d p = grid.centre_of(cell);
    return {p.x() + 0.04 * (stream.uniform() - 0.5), p.y(), 1.0};
  }
}

TEST(FloorPaths, LengthsAreThoseOfAPlainSearch) {
  RandomStream stream(3, "floor paths");
  for (int n = 0; n < 20; ++n) {
    const OccupancyGrid grid = random_floor(stream);
    const DrivableFloor floor(grid, some_place(grid, stream), 0.05);
    const FloorPaths paths(floor);
    const std::vector<double> plain = plain_lengths(floor);
    for (GridCell cell; cell.row < grid.frame().height; ++cell.row)
      for (cell.column = 0; cell.column < grid.frame().width; ++cell.column) {
        if (std::isinf(plain[grid.index(cell)])) {
          EXPECT_FALSE(paths.reaches(cell));
        } else {
          EXPECT_NEAR(paths.cost_m(cell), plain[grid.index(cell)], 1e-9);
        }
      }
  }
}

// Every point of every leg keeps the radius from the centres of all cells that are not free.
TEST(FloorPaths, WaysKeepTheRadiusAndAreNoLongerThanTheCells) {
  constexpr double kRadius = 0.12;
  RandomStream stream(4, "floor paths");
  int ways = 0;
  for (int n = 0; n < 20; ++n) {
    const OccupancyGrid grid = random_floor(stream);
    const PlanarPose here = some_place(grid, stream);
    const DrivableFloor floor(grid, here, kRadius);
    if (floor.squared_clearance(floor.robot_cell()) < 6) continue;  // (1.2 + 0.71 + 0.5)^2 cells
    const FloorPaths paths(floor);
    for (const GridCell& cell : paths.reached()) {
      const std::vector<PlanarPose> way = paths.way_to(cell, 0.5);
      ASSERT_GE(way.size(), 2u);
      EXPECT_EQ(way.front(), here);
      EXPECT_EQ(way.back().yaw_rad, 0.5);
      EXPECT_LE(length_m(way), paths.cost_m(cell) + 0.1);
      for (std::size_t leg = 1; leg < way.size(); ++leg)
        for (double share = 0.0; share <= 1.0; share += 0.02) {
          const Eigen::Vector2d p(std::lerp(way[leg - 1].x_m, way[leg].x_m, share),
                                  std::lerp(way[leg - 1].y_m, way[leg].y_m, share));
          for (GridCell at; at.row < grid.frame().height; ++at.row)
            for (at.column = 0; at.column < grid.frame().width; ++at.column)
              if (grid.at(at) != kFreeCell) {
                ASSERT_GE((grid.centre_of(at) - p).norm(), kRadius - 1e-9);
              }
        }
      ++ways;
    }
    if (n > 6) break;
  }
  EXPECT_GT(ways, 100);
}

TEST(FloorPaths, AStraightWayIsOneLegAndFacesWhereItGoes) {
  const DrivableFloor floor(OccupancyGrid({0.1, {}, 30, 30}, kFreeCell), {1.05, 1.05, 2.0}, 0.1);
  const FloorPaths paths(floor);
  const auto way = paths.way_to({20, 15}, -1.0);
  ASSERT_EQ(way.size(), 2u);
  EXPECT_EQ(way[0], (PlanarPose{1.05, 1.05, 2.0}));
  EXPECT_NEAR(way[1].x_m, 2.05, 1e-12);
  EXPECT_NEAR(way[1].y_m, 1.55, 1e-12);
  EXPECT_NEAR(length_m(way), std::hypot(1.0, 0.5), 1e-12);
}

// Behind the wall lies the robot's own place: it only turns.
TEST(FloorPaths, AWayToWhereItStandsOnlyTurns) {
  const DrivableFloor floor(drawn_grid({"###", "#.#", "###"}), {0.15, 0.15, 0.3}, 0.2);
  const FloorPaths paths(floor);
  EXPECT_EQ(paths.reached(), (std::vector<GridCell>{{1, 1}}));
  const std::vector<PlanarPose> turn{{0.15, 0.15, 0.3}, {0.15, 0.15, 2.0}};
  EXPECT_EQ(paths.way_to({1, 1}, 2.0), turn);
}

TEST(FloorPaths, FromBeyondTheGridNothingIsReached) {
  const DrivableFloor floor(OccupancyGrid({0.1, {}, 30, 30}, kFreeCell), {-1.0, 1.0, 0.0}, 0.1);
  EXPECT_TRUE(FloorPaths(floor).reached().empty());
}

}  // namespace
}  // namespace mapscore::testing
