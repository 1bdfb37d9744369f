// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/occupancy_grid.hpp"
#include "core/localization/odometry_motion.hpp"
#include "core/localization/scan_likelihood.hpp"
#include "core/random_stream.hpp"

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace mapscore::testing {

/// A wall or a piece of furniture: a rectangle about `pose`, half extents in metres. What is not
/// `mapped` stands in the home but not in its grid.
struct Block {
  PlanarPose pose;
  double half_x_m, half_y_m;
  bool mapped = true;
};

/// A home as exact polygons, and a drive through it.
struct PolygonHome {
  std::vector<Block> blocks;
  std::vector<Eigen::Vector2d> waypoints;
  GridFrame frame;
};

/// Four rooms, all walls along the axes.
[[nodiscard]] PolygonHome straight_home();
/// Three rooms with a slanted wall and turned furniture, on a turned grid; a chair is not mapped.
[[nodiscard]] PolygonHome slanted_home();

/// Occupied where a mapped block's outline meets the closed cell, free where flood fill reaches
/// from the first waypoint, else unknown. Exact.
[[nodiscard]] OccupancyGrid grid_of(const PolygonHome& home);

/// Distance to the first outline along a ray, exact.
[[nodiscard]] std::optional<double> range_in(const PolygonHome& home, const Eigen::Vector2d& from,
                                             double angle_rad);

/// 360 beams, 12 m; noise of 1 cm, one beam in fifty returns nothing, one in a hundred is short.
[[nodiscard]] LaserScan scan_in(const PolygonHome& home, const PlanarPose& T_map_base,
                                RandomStream& stream);

/// One frame of a drive.
struct DrivenFrame {
  PlanarPose T_map_base, T_odom_base;
  LaserScan scan;
};

/// Drives along the waypoints by straight lines and turns on the spot, at most `way_m` and
/// `turn_rad` a frame; odometry errs as the motion model says.
[[nodiscard]] std::vector<DrivenFrame> drive(const PolygonHome& home, const OdometryNoise& noise,
                                             double way_m, double turn_rad, std::uint64_t seed);

}  // namespace mapscore::testing
