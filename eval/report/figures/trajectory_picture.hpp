// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/occupancy_grid.hpp"
#include "core/localization/planar_pose.hpp"
#include "eval/report/figures/script.hpp"

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Where a robot went, or is believed to have gone.
struct DrawnTrajectory {
  std::string name;                         ///< in the legend: "truth", "particle filter"
  std::vector<Eigen::Vector2d> points_map;  ///< metres, in order
  std::vector<PoseEstimate> beliefs;        ///< those whose 2-sigma ellipse is drawn; may be empty
};

/// What is said and marked beside the trajectories.
struct TrajectoryNotes {
  std::string name = "trajectory";             ///< of the files, without a suffix
  std::string title;                           ///< above; may be empty
  std::string caption;                         ///< below, before what the picture says of itself
  std::vector<Eigen::Vector2d> waypoints_map;  ///< metres; may be empty
};

/// An ellipse in the plane: full axes in metres, the first turned by `angle_rad` from x.
struct PlanarEllipse {
  Eigen::Vector2d centre;
  double first_axis_m = 0.0, second_axis_m = 0.0, angle_rad = 0.0;
};

/// {p : (p - mean)^T S^-1 (p - mean) <= 4} with S = R(yaw) C R(yaw)^T, C the part of x and y of a
/// covariance in the axes of the base: 86.5 % of a normal distribution lie in it. The first axis is
/// the longer one.
[[nodiscard]] PlanarEllipse two_sigma_ellipse(const PoseEstimate& belief);

/// Trajectories on a grid: free white, occupied dark, unknown light grey; metres of the map on both
/// axes at one scale; the first trajectory, as a rule the truth, is a broad line below the others
/// and has its start and end marked; each of the others is thinner than those before, from the
/// second on dashed, so that lines that run as one all show. Cropped to the known cells and what is
/// drawn. The grid is shown on a lattice along the map's axes: its own, or, where it is turned, one
/// of half its cells. A block of the data file is the grid (a matrix), then trajectories (`x y`),
/// ellipses (`x y first_axis_m second_axis_m angle_deg`), waypoints, start and end. Throws Error
/// where there is nothing to draw, or a point or covariance is not finite.
[[nodiscard]] FigureSheet trajectory_figure(const OccupancyGrid& grid,
                                            std::span<const DrawnTrajectory> trajectories,
                                            const TrajectoryNotes& notes,
                                            const FigureStyle& style = {});

}  // namespace mapscore::eval
