// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/occupancy_grid.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace mapscore {
namespace {

OccupancyGrid random_grid(std::uint64_t seed, double share) {
  RandomStream stream(seed, "random grid");
  const auto width = 1 + static_cast<std::int32_t>(stream.bits() % 40);
  const auto height = 1 + static_cast<std::int32_t>(stream.bits() % 40);
  OccupancyGrid grid({0.07, {-1.3, 0.4, 5.0 * stream.uniform()}, width, height}, kFreeCell);
  for (GridCell cell; cell.row < height; ++cell.row)
    for (cell.column = 0; cell.column < width; ++cell.column)
      if (stream.uniform() < share) grid.set(cell, kOccupiedCell);
  return grid;
}

/// The distance transform, by its definition.
std::int64_t plain_distance(const OccupancyGrid& grid, const GridCell& from) {
  std::int64_t least = kNoObstacle;
  for (GridCell cell; cell.row < grid.frame().height; ++cell.row)
    for (cell.column = 0; cell.column < grid.frame().width; ++cell.column) {
      const std::int64_t dx = cell.column - from.column, dy = cell.row - from.row;
      if (grid.at(cell) == kOccupiedCell) least = std::min(least, dx * dx + dy * dy);
    }
  return least;
}

/// The ray cast, by clipping the ray at the four sides of every occupied cell.
std::optional<double> plain_cast(const OccupancyGrid& grid, const Eigen::Vector2d& from_map,
                                 double angle_rad, double range_m) {
  const Eigen::Vector2d from = grid.lattice_point(from_map);
  const double angle = angle_rad - grid.frame().T_map_grid.yaw_rad;
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  double least = std::numeric_limits<double>::infinity();
  for (GridCell cell; cell.row < grid.frame().height; ++cell.row)
    for (cell.column = 0; cell.column < grid.frame().width; ++cell.column) {
      if (grid.at(cell) != kOccupiedCell) continue;
      const double x0 = (cell.column - from.x()) / along.x(), x1 = x0 + 1.0 / along.x();
      const double y0 = (cell.row - from.y()) / along.y(), y1 = y0 + 1.0 / along.y();
      const double first = std::max({0.0, std::min(x0, x1), std::min(y0, y1)});
      if (first <= std::min(std::max(x0, x1), std::max(y0, y1))) least = std::min(least, first);
    }
  const double range = least * grid.frame().resolution_m;
  return range <= range_m ? std::optional(range) : std::nullopt;
}

TEST(OccupancyGrid, CellsAndPointsByHand) {
  const double right = 0.5 * std::numbers::pi;
  const OccupancyGrid grid({0.5, {10.0, 20.0, right}, 4, 3});  // grid x is map y, grid y is map -x
  const Eigen::Vector2d centre = grid.centre_of({2, 1});
  EXPECT_NEAR(centre.x(), 10.0 - 0.75, 1e-12);
  EXPECT_NEAR(centre.y(), 20.0 + 1.25, 1e-12);
  EXPECT_EQ(grid.cell_of(centre), (GridCell{2, 1}));
  EXPECT_EQ(grid.cell_of({10.1, 19.9}), (GridCell{-1, -1}));
  EXPECT_FALSE(grid.contains({4, 0}));
  EXPECT_EQ(grid.at_or_unknown({4, 0}), kUnknownCell);
  EXPECT_FALSE(grid.contains(grid.cell_of({1e30, -1e30})));
}

TEST(OccupancyGrid, RefusesWhatIsNoLattice) {
  EXPECT_THROW(OccupancyGrid({0.0, {}, 1, 1}), Error);
  EXPECT_THROW(OccupancyGrid({0.1, {NAN, 0, 0}, 1, 1}), Error);
  EXPECT_THROW(OccupancyGrid({0.1, {}, 0, 1}), Error);
  EXPECT_THROW(OccupancyGrid({0.1, {}, 1 << 20, 1 << 20}), Error);
}

TEST(OccupancyGrid, FloodStopsAtWallsAndCorners) {
  OccupancyGrid grid({1.0, {}, 4, 4});
  for (const GridCell wall : {GridCell{0, 2}, {1, 1}, {2, 0}}) grid.set(wall, kOccupiedCell);
  flood_free(grid, {0, 0});  // a diagonal wall is tight
  EXPECT_EQ(std::count(grid.cells().begin(), grid.cells().end(), kFreeCell), 3);
  flood_free(grid, {1, 1});
  flood_free(grid, {-1, 9});
  EXPECT_EQ(std::count(grid.cells().begin(), grid.cells().end(), kFreeCell), 3);
}

TEST(DistanceTransform, EqualsItsDefinition) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const OccupancyGrid grid = random_grid(seed, seed % 3 == 0 ? 0.003 : 0.1);
    const std::vector<std::int64_t> squared = squared_distances(grid);
    for (GridCell cell; cell.row < grid.frame().height; ++cell.row)
      for (cell.column = 0; cell.column < grid.frame().width; ++cell.column)
        ASSERT_EQ(squared[grid.index(cell)], plain_distance(grid, cell)) << "grid " << seed;
  }
}

TEST(DistanceTransform, NothingIsFarFromNothing) {
  const OccupancyGrid grid({1.0, {}, 3, 2}, kFreeCell);
  for (const std::int64_t squared : squared_distances(grid)) EXPECT_EQ(squared, kNoObstacle);
}

TEST(RayCast, EqualsClippingEveryCell) {
  RandomStream stream(7, "rays");
  int hits = 0, misses = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const OccupancyGrid grid = random_grid(seed, seed % 2 == 0 ? 0.01 : 0.1);
    for (int ray = 0; ray < 300; ++ray) {
      const Eigen::Vector2d from(5.0 * stream.uniform() - 3.5, 5.0 * stream.uniform() - 2.5);
      const double angle = 7.0 * stream.uniform() - 3.5, range = 4.0 * stream.uniform();
      const auto cast = cast_ray(grid, from, angle, range);
      const auto plain = plain_cast(grid, from, angle, range);
      ASSERT_EQ(cast.has_value(), plain.has_value()) << "grid " << seed << " ray " << ray;
      if (cast) {
        ASSERT_NEAR(*cast, *plain, 1e-9);
      }
      ++(cast ? hits : misses);
    }
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(misses, 500);
}

TEST(RayCast, AlongTheAxesByHand) {
  OccupancyGrid grid({0.5, {0, 0, 0}, 10, 10}, kFreeCell);
  grid.set({7, 2}, kOccupiedCell);
  EXPECT_DOUBLE_EQ(cast_ray(grid, {1.25, 1.25}, 0.0, 9.0).value(), 2.25);
  EXPECT_FALSE(cast_ray(grid, {1.25, 1.25}, 0.0, 2.2));
  EXPECT_FALSE(cast_ray(grid, {1.25, 1.25}, std::numbers::pi, 9.0));
  EXPECT_DOUBLE_EQ(cast_ray(grid, {-2.0, 1.25}, 0.0, 9.0).value(), 5.5);  // from outside
  EXPECT_DOUBLE_EQ(cast_ray(grid, {3.6, 1.25}, 1.0, 9.0).value(), 0.0);   // from inside
  EXPECT_NEAR(cast_ray(grid, {3.75, 4.75}, -0.5 * std::numbers::pi, 9.0).value(), 3.25, 1e-12);
}

}  // namespace
}  // namespace mapscore
