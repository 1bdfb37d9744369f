// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <cstdint>

namespace mapscore::sim {

/// Two wheels on one axis, as the odometry believes them.
struct WheelGeometry {
  double radius_m = 0.0;
  double track_m = 0.0;  ///< distance between the wheels' middles
};

/// Encoder counts since the start of a drive, forwards positive.
struct WheelTicks {
  std::int64_t left = 0, right = 0;
};

/// Whole ticks in an angle, rounded down: an encoder that counts edges. `ticks_per_turn` > 0.
[[nodiscard]] std::int64_t ticks_of(double angle_rad, int ticks_per_turn);

/// Dead reckoning from encoder ticks, along exact arcs of constant curvature:
///
///   d = r (a_right + a_left) / 2,   t = r (a_right - a_left) / track
///   x += c cos(yaw + t/2),   y += c sin(yaw + t/2),   yaw += t,   c = d sin(t/2) / (t/2)
///
/// with a the turn of a wheel since the last update (radians). The odom frame is base_footprint at
/// the start.
class Odometry {
 public:
  /// Throws Error when a length or `ticks_per_turn` is not above 0.
  Odometry(const WheelGeometry& believed, int ticks_per_turn);

  void update(const WheelTicks& ticks);

  [[nodiscard]] Pose T_odom_base() const { return planar_pose(x_m_, y_m_, yaw_rad_); }

 private:
  WheelGeometry believed_;
  double rad_per_tick_;
  WheelTicks last_;
  double x_m_ = 0.0, y_m_ = 0.0, yaw_rad_ = 0.0;
};

}  // namespace mapscore::sim
