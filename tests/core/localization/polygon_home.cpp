// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "polygon_home.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace mapscore::testing {
namespace {

using Side = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

std::array<Side, 4> sides_of(const Block& block) {
  const auto corner = [&](double x, double y) {
    return block.pose * Eigen::Vector2d(x * block.half_x_m, y * block.half_y_m);
  };
  const std::array<Eigen::Vector2d, 4> c = {corner(-1, -1), corner(1, -1), corner(1, 1),
                                            corner(-1, 1)};
  return {Side{c[0], c[1]}, Side{c[1], c[2]}, Side{c[2], c[3]}, Side{c[3], c[0]}};
}

/// Does the segment a b (in cells) meet the closed cell? Clips it at the four sides.
bool meets(const GridCell& cell, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  double first = 0.0, last = 1.0;
  const std::array<double, 2> low = {double(cell.column), double(cell.row)};
  for (int axis = 0; axis < 2; ++axis) {
    const double at = a[axis], along = b[axis] - a[axis];
    const double from = low[static_cast<std::size_t>(axis)] - at, to = from + 1.0;
    if (along == 0.0) {
      if (from > 0.0 || to < 0.0) return false;
      continue;
    }
    first = std::max(first, std::min(from / along, to / along));
    last = std::min(last, std::max(from / along, to / along));
  }
  return first <= last;
}

void draw_side(OccupancyGrid& grid, const Side& side) {
  const Eigen::Vector2d a = grid.lattice_point(side.first), b = grid.lattice_point(side.second);
  const auto cell = [](double at) { return static_cast<std::int32_t>(std::floor(at)); };
  for (std::int32_t row = cell(std::min(a.y(), b.y())) - 1; row <= cell(std::max(a.y(), b.y())) + 1;
       ++row)
    for (std::int32_t column = cell(std::min(a.x(), b.x())) - 1;
         column <= cell(std::max(a.x(), b.x())) + 1; ++column) {
      const GridCell at{column, row};
      if (grid.contains(at) && meets(at, a, b)) grid.set(at, kOccupiedCell);
    }
}

Block wall(double x0, double y0, double x1, double y1) {
  const double length = std::hypot(x1 - x0, y1 - y0);
  return {
      {0.5 * (x0 + x1), 0.5 * (y0 + y1), std::atan2(y1 - y0, x1 - x0)}, 0.5 * length + 0.05, 0.05};
}

double next_step(double left, double most) {
  return std::clamp(left, -most, most);
}

}  // namespace

PolygonHome straight_home() {
  PolygonHome home;
  home.blocks = {wall(0.03, 0.02, 10.03, 0.02),
                 wall(10.03, 0.02, 10.03, 7.02),
                 wall(10.03, 7.02, 0.03, 7.02),
                 wall(0.03, 7.02, 0.03, 0.02),
                 wall(4.02, 0.02, 4.02, 2.1),
                 wall(4.02, 3.1, 4.02, 7.02),
                 wall(4.02, 4.0, 5.6, 4.0),
                 wall(6.6, 4.0, 10.03, 4.0),
                 wall(7.01, 4.0, 7.01, 5.2),
                 wall(7.01, 6.2, 7.01, 7.02),
                 // living room: sofa, table, board
                 {{1.0, 6.5, 0}, 0.9, 0.4},
                 {{2.1, 4.6, 0}, 0.5, 0.3},
                 {{0.3, 2.0, 0}, 0.2, 0.7},
                 // kitchen: front, four legs of a table
                 {{8.2, 0.36, 0}, 1.8, 0.3},
                 {{5.4, 1.0, 0}, 0.02, 0.02},
                 {{6.2, 1.0, 0}, 0.02, 0.02},
                 {{5.4, 1.6, 0}, 0.02, 0.02},
                 {{6.2, 1.6, 0}, 0.02, 0.02},
                 // bedroom, bathroom
                 {{4.9, 6.4, 0}, 0.7, 0.5},
                 {{9.3, 6.2, 0}, 0.4, 0.7},
                 {{9.6, 4.4, 0}, 0.3, 0.25}};
  home.waypoints = {{2.5, 1.0}, {2.5, 3.0}, {1.0, 3.5}, {1.2, 5.2}, {3.2, 5.4}, {3.0, 2.6},
                    {5.0, 2.6}, {8.8, 2.4}, {6.1, 2.8}, {6.1, 5.5}, {5.2, 5.0}, {6.2, 5.7},
                    {8.2, 5.7}, {6.3, 5.6}, {6.1, 3.0}, {4.7, 2.6}, {3.0, 2.5}, {2.0, 1.0}};
  home.frame = {0.05, {-0.2, -0.2, 0.0}, 210, 150};
  return home;
}

PolygonHome slanted_home() {
  PolygonHome home;
  home.blocks = {wall(-4.5, -3.0, 4.3, -3.0),
                 wall(4.3, -3.0, 5.2, 2.5),
                 wall(5.2, 2.5, 3.0, 4.2),
                 wall(3.0, 4.2, -4.5, 4.2),
                 wall(-4.5, 4.2, -4.5, -3.0),
                 wall(-1.0, -3.0, -1.0, -0.4),
                 wall(-1.0, 0.6, -1.0, 4.2),
                 wall(-1.0, 0.8, 1.4, 1.3),
                 wall(2.5, 1.5, 5.0, 2.0),
                 {{-3.6, 2.8, 0.4}, 0.5, 0.9},
                 {{-3.9, -2.3, 0}, 0.5, 0.6},
                 {{-2.6, 0.6, 0.7}, 0.4, 0.25},
                 {{1.5, -2.6, 0}, 1.2, 0.3},
                 {{3.4, -0.4, -0.5}, 0.4, 0.4},
                 {{0.6, 3.6, 0.1}, 0.8, 0.4},
                 {{3.1, 3.3, 0.9}, 0.25, 0.5},
                 {{0.6, -0.9, 0.3}, 0.22, 0.22, false}};
  home.waypoints = {{-2.0, -2.0}, {-3.4, -0.8}, {-2.2, 1.8}, {-1.9, 0.1}, {0.2, 0.1}, {1.8, -0.6},
                    {1.9, 1.5},   {1.6, 2.6},   {0.0, 2.2},  {1.8, 2.2},  {2.0, 0.5}, {2.2, -1.6},
                    {0.0, -1.8},  {-0.3, 0.0},  {-2.2, 0.0}, {-2.4, -1.6}};
  home.frame = {0.05, {-2.0, -7.0, 0.6}, 260, 260};
  return home;
}

OccupancyGrid grid_of(const PolygonHome& home) {
  OccupancyGrid grid(home.frame);
  for (const Block& block : home.blocks)
    if (block.mapped)
      for (const Side& side : sides_of(block)) draw_side(grid, side);
  flood_free(grid, grid.cell_of(home.waypoints.front()));
  return grid;
}

std::optional<double> range_in(const PolygonHome& home, const Eigen::Vector2d& from,
                               double angle_rad) {
  const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
  std::optional<double> nearest;
  for (const Block& block : home.blocks)
    for (const auto& [a, b] : sides_of(block)) {
      const Eigen::Vector2d side = b - a, to = a - from;
      const double crossing = along.x() * side.y() - along.y() * side.x();
      if (crossing == 0.0) continue;
      const double range = (to.x() * side.y() - to.y() * side.x()) / crossing;
      const double share = (to.x() * along.y() - to.y() * along.x()) / crossing;
      if (range >= 0.0 && share >= 0.0 && share <= 1.0 && (!nearest || range < *nearest))
        nearest = range;
    }
  return nearest;
}

LaserScan scan_in(const PolygonHome& home, const PlanarPose& T_map_base, RandomStream& stream) {
  LaserScan scan;
  scan.T_base_lidar = {0.1, 0.0, 0.0};
  scan.first_angle_rad = -std::numbers::pi;
  scan.angle_step_rad = std::numbers::pi / 180.0;
  scan.range_min_m = 0.15;
  const PlanarPose T_map_lidar = T_map_base * scan.T_base_lidar;
  for (int beam = 0; beam < 360; ++beam) {
    const double angle = scan.first_angle_rad + beam * scan.angle_step_rad;
    const auto range =
        range_in(home, {T_map_lidar.x_m, T_map_lidar.y_m}, T_map_lidar.yaw_rad + angle);
    double measured = range ? *range + 0.01 * stream.normal() : 13.0;
    const double chance = stream.uniform(), share = stream.uniform();
    if (chance < 0.02) measured = 0.0;
    if (chance > 0.99) measured *= share;
    scan.ranges_m.push_back(measured < scan.range_max_m ? static_cast<float>(measured)
                                                        : std::numeric_limits<float>::infinity());
  }
  return scan;
}

std::vector<DrivenFrame> drive(const PolygonHome& home, const OdometryNoise& noise, double way_m,
                               double turn_rad, std::uint64_t seed) {
  RandomStream scans(seed, "test scans"), wheels(seed, "test wheels");
  std::vector<DrivenFrame> frames;
  PlanarPose T_map_base{home.waypoints[0].x(), home.waypoints[0].y(), 0.3};
  PlanarPose T_odom_base{3.0, -1.0, 2.0};
  frames.push_back({T_map_base, T_odom_base, scan_in(home, T_map_base, scans)});
  const auto go = [&](const PlanarPose& T_before_after) {
    T_map_base = T_map_base * T_before_after;
    const OdometryMotion motion = motion_parts(T_before_after, noise.least_way_m);
    T_odom_base = T_odom_base * sample_motion(motion, motion_sigmas(motion, noise), wheels);
    frames.push_back({T_map_base, T_odom_base, scan_in(home, T_map_base, scans)});
  };
  for (std::size_t n = 1; n < home.waypoints.size(); ++n) {
    const Eigen::Vector2d way = home.waypoints[n] - Eigen::Vector2d(T_map_base.x_m, T_map_base.y_m);
    double turn = wrapped_angle(std::atan2(way.y(), way.x()) - T_map_base.yaw_rad);
    for (; std::abs(turn) > 1e-9; turn -= next_step(turn, turn_rad))
      go({0, 0, next_step(turn, turn_rad)});
    double left = way.norm();
    for (; left > 1e-9; left -= next_step(left, way_m)) go({next_step(left, way_m), 0, 0});
  }
  return frames;
}

}  // namespace mapscore::testing
