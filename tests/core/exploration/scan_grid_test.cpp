// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/scan_grid.hpp"

#include "core/error.hpp"
#include "tests/core/exploration/box_flat.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace mapscore::testing {
namespace {

LaserScan beams(std::vector<float> ranges_m, double first_rad = 0.0,
                double step_rad = 0.5 * std::numbers::pi) {
  return {{}, first_rad, step_rad, 0.1, 12.0, std::move(ranges_m)};
}

Occupancy at(const ScanGrid& grid, double x, double y) {
  return grid.grid().at_or_unknown(grid.grid().cell_of({x, y}));
}

TEST(ScanGrid, NothingIsKnownBeforeTheFirstTurn) {
  EXPECT_EQ(ScanGrid().grid().cells(), std::vector<Occupancy>{kUnknownCell});
}

// One beam from (0.05, 0.05) along x that ends at x = 0.45 in cells of 0.1 m.
TEST(ScanGrid, ABeamFreesWhatItPassesAndHitsWhereItEnds) {
  ScanGrid grid(0.1);
  grid.add(beams({0.4f}), {0.05, 0.05, 0.0});
  for (const double x : {0.05, 0.15, 0.25, 0.35}) EXPECT_EQ(at(grid, x, 0.05), kFreeCell) << x;
  EXPECT_EQ(at(grid, 0.45, 0.05), kOccupiedCell);
  EXPECT_EQ(at(grid, 0.55, 0.05), kUnknownCell);
  EXPECT_EQ(at(grid, 0.15, 0.15), kUnknownCell);
}

TEST(ScanGrid, BeamsThatMeasuredNothingSayNothing) {
  ScanGrid grid(0.1);
  grid.add(beams({std::numeric_limits<float>::infinity(), 12.0f, 0.05f,
                  std::numeric_limits<float>::quiet_NaN()}),
           {0.05, 0.05, 0.0});
  for (const Occupancy cell : grid.grid().cells()) EXPECT_EQ(cell, kUnknownCell);
}

// In one turn a hit wins: the second beam passes the cell that the first one ends in.
TEST(ScanGrid, AHitWinsOverAMissOfTheSameTurn) {
  ScanGrid grid(0.1);
  grid.add(beams({0.4f, 0.8f}, 0.0, 0.01), {0.05, 0.05, 0.0});
  EXPECT_EQ(at(grid, 0.45, 0.05), kOccupiedCell);
  EXPECT_EQ(at(grid, 0.65, 0.05), kFreeCell);
}

// Log-odds of a hit are 0.847, of a miss -0.405: two misses leave it occupied, three do not.
TEST(ScanGrid, ACellIsFreeAgainAfterThreeMissesForAHit) {
  ScanGrid grid(0.1);
  grid.add(beams({0.4f}), {0.05, 0.05, 0.0});
  for (const Occupancy expected : {kOccupiedCell, kOccupiedCell, kFreeCell}) {
    grid.add(beams({0.8f}), {0.05, 0.05, 0.0});
    EXPECT_EQ(at(grid, 0.45, 0.05), expected);
  }
}

TEST(ScanGrid, GrowingKeepsWhatWasKnown) {
  const BoxFlat flat = two_rooms();
  FlatSensors sensors(flat, flat_robot());
  const PlanarPose places[] = {{1.5, 1.5, 0.3}, {5.0, 1.5, 1.0}, {-3.0, -2.0, 0.0}};
  ScanGrid grid;
  grid.add(sensors.scan(places[0]), places[0]);
  const OccupancyGrid before = grid.grid();
  grid.add(beams({9.0f, 9.0f, 9.0f, 9.0f}), places[2]);
  for (GridCell cell; cell.row < before.frame().height; ++cell.row)
    for (cell.column = 0; cell.column < before.frame().width; ++cell.column)
      if (before.at(cell) == kOccupiedCell) {
        const Eigen::Vector2d p = before.centre_of(cell);
        EXPECT_EQ(at(grid, p.x(), p.y()), kOccupiedCell);
      }
}

// Exact: every free cell can be seen from the lidar's place, and walls stand where they are.
TEST(ScanGrid, ARoomIsFreeWithinItsWalls) {
  const BoxFlat flat(3.0, 2.0);
  FlatSensors sensors(flat, flat_robot());
  ScanGrid grid;
  for (const double yaw : {0.0, 0.007, 0.013}) {
    const PlanarPose here{1.0, 1.0, yaw};
    grid.add(sensors.scan(here), here);
  }
  for (double x = 0.175; x < 2.85; x += 0.05)
    for (double y = 0.175; y < 1.85; y += 0.05)
      EXPECT_EQ(at(grid, x, y), kFreeCell) << x << ' ' << y;
  EXPECT_EQ(at(grid, -0.1, 1.0), kUnknownCell);
  EXPECT_EQ(at(grid, 2.92, 1.0), kOccupiedCell);
}

TEST(ScanGrid, RefusesWhatIsNoPose) {
  ScanGrid grid;
  EXPECT_THROW(grid.add(beams({1.0f}), {std::numeric_limits<double>::quiet_NaN(), 0, 0}), Error);
  EXPECT_THROW(grid.add(beams({1.0f}), {1e6, 0, 0}), Error);
  EXPECT_THROW(ScanGrid(0.0), Error);
}

}  // namespace
}  // namespace mapscore::testing
