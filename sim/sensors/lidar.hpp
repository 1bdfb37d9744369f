// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "sim/world/world.hpp"

#include <cmath>
#include <memory>
#include <vector>

namespace mapscore::sim {

/// A planar lidar that turns once around. Beam n points along first_angle_rad + n 2 pi / beams in
/// the lidar's frame, x forward, counter-clockwise.
struct LidarSettings {
  int beams = 360;
  double first_angle_rad = -3.14159265358979323846;
  double range_min_m = 0.15, range_max_m = 12.0;
};

/// One turn: a range a beam, metres. Infinity: nothing within range_max_m. 0: no measurement, as of
/// anything nearer than range_min_m.
using LidarRanges = std::vector<float>;

/// Casts rays against the exact surfaces that the renderer draws, at the pose of loading or at an
/// instant of the world's motion: solid geoms of groups 0 to 2, glass where its class is opaque,
/// planes from their front alone; never the robot. Round shapes are exact, not faceted. Immutable
/// and safe to share between threads.
class Lidar {
 public:
  /// Stands at the robot's site `lidar`. Throws Error when there is none, or a setting is out of
  /// range.
  explicit Lidar(const World& world, const LidarSettings& settings = {});

  [[nodiscard]] const Pose& T_base_lidar() const { return T_base_lidar_; }
  [[nodiscard]] double angle_step_rad() const { return 2.0 * M_PI / settings_.beams; }

  /// One turn at each pose of the base, without noise, all its beams from one place, the scene as
  /// its motion has it at that stamp (without a motion, as for a world made by World::at, as it was
  /// loaded). A tilted base tilts the lidar's plane. The same bytes for any number of `jobs`.
  /// Throws Error when jobs < 1.
  [[nodiscard]] std::vector<LidarRanges> scans(const std::vector<StampedPose>& poses,
                                               int jobs) const;

 private:
  class Caster;

  World world_;  // shares its state
  LidarSettings settings_;
  Pose T_base_lidar_ = Pose::Identity();
  std::vector<double> directions_;         ///< beams x 3, in the lidar's frame
  std::shared_ptr<const mjModel_> model_;  ///< what the renderer draws in group 0, all else in 5
};

}  // namespace mapscore::sim
