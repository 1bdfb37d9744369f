// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/robot/odometry.hpp"

#include "core/error.hpp"

#include <cmath>

namespace mapscore::sim {

std::int64_t ticks_of(double angle_rad, int ticks_per_turn) {
  return static_cast<std::int64_t>(std::floor(angle_rad / (2.0 * M_PI) * ticks_per_turn));
}

Odometry::Odometry(const WheelGeometry& believed, int ticks_per_turn)
    : believed_(believed), rad_per_tick_(2.0 * M_PI / ticks_per_turn) {
  const auto usable = [](double value) { return value > 0 && std::isfinite(value); };
  if (!usable(believed.radius_m) || !usable(believed.track_m))
    throw Error("odometry: wheel radius and track must be above 0 m");
  if (ticks_per_turn < 1) throw Error("odometry: ticks_per_turn must be at least 1");
}

void Odometry::update(const WheelTicks& ticks) {
  const double left = static_cast<double>(ticks.left - last_.left) * rad_per_tick_;
  const double right = static_cast<double>(ticks.right - last_.right) * rad_per_tick_;
  last_ = ticks;
  const double along_m = believed_.radius_m * (right + left) / 2.0;
  const double turn = believed_.radius_m * (right - left) / believed_.track_m;
  const double half = turn / 2.0;
  const double chord_m = half == 0.0 ? along_m : along_m * std::sin(half) / half;
  x_m_ += chord_m * std::cos(yaw_rad_ + half);
  y_m_ += chord_m * std::sin(yaw_rad_ + half);
  yaw_rad_ += turn;
}

}  // namespace mapscore::sim
