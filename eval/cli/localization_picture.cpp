// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/localization_picture.hpp"

#include "eval/localization/odometry_run.hpp"
#include "eval/report/trajectory_picture.hpp"

#include <cmath>

namespace mapscore::eval {
namespace {

constexpr double kEllipseEveryM = 2.5;  ///< of the way

DrawnTrajectory truth_of(const std::vector<TrajectoryPose>& frames) {
  DrawnTrajectory drawn{"truth", {}, {}};
  for (const TrajectoryPose& frame : frames)
    drawn.points_map.emplace_back(frame.T_world_base.translation().head<2>());
  return drawn;
}

/// A belief at the frames, with an ellipse at the first and every few metres of its way.
DrawnTrajectory belief_of(const std::string& name, const BelievedTrajectory& believed,
                          const std::vector<TrajectoryPose>& frames, bool with_ellipses) {
  DrawnTrajectory drawn{name, {}, {}};
  double way_m = kEllipseEveryM;
  for (const TrajectoryPose& frame : frames) {
    const PoseEstimate estimate = planar_estimate(believed.at(frame.stamp_s));
    const Eigen::Vector2d at(estimate.mean.x_m, estimate.mean.y_m);
    if (!drawn.points_map.empty()) way_m += (at - drawn.points_map.back()).norm();
    drawn.points_map.push_back(at);
    if (!with_ellipses || way_m < kEllipseEveryM) continue;
    drawn.beliefs.push_back(estimate);
    way_m = 0.0;
  }
  return drawn;
}

}  // namespace

void draw_localization(const OccupancyGrid& grid, const BelievedTrajectory& believed,
                       const std::vector<TrajectoryPose>& frames, const std::string& source,
                       const std::filesystem::path& folder) {
  std::vector<DrawnTrajectory> drawn = {truth_of(frames)};
  if (source != "odometry") {
    drawn.push_back(belief_of("particle filter", believed, frames, true));
    const PlanarPose start =
        planar(frames.front().T_world_base) *
        inverse(planar(odometry_at(believed.odometry, frames.front().stamp_s))) *
        planar(believed.odometry.front().T_odom_base);
    drawn.push_back(
        belief_of("odometry", odometry_only(believed.odometry, start, {}), frames, false));
  } else {
    drawn.push_back(belief_of("odometry", believed, frames, true));
  }
  (void)draw_trajectories(grid, drawn, {}, folder);
}

}  // namespace mapscore::eval
