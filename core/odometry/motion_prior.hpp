// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/odometry_motion.hpp"
#include "core/odometry/local_map.hpp"

namespace mapscore {

/// What is expected of a motion of the base before the scan is looked at: T_true = T_before_after
/// Exp(xi), xi ~ N(0, noise). All functions here are pure.
struct MotionPrior {
  Pose T_before_after = Pose::Identity();
  Covariance6 noise = Covariance6::Zero();
};

/// The motion before; none was measured where `duration_s` is 0.
struct LastStep {
  Pose T_before_after = Pose::Identity();
  double duration_s = 0.0;
};

/// Diagonal covariance of these standard deviations, the same for x and y, and for roll and pitch.
[[nodiscard]] Covariance6 sigmas6(double xy_m, double z_m, double tilt_rad, double yaw_rad);

/// By the encoders' increment; they do not say the base's spring and tilt.
[[nodiscard]] MotionPrior wheel_motion(const Pose& T_before_after, const OdometryNoise& noise);

/// Of a robot whose wheels are not read: it goes on as it went, for two seconds at most,
/// within 0.5 m/s^2 and 85 degrees/s^2.
[[nodiscard]] MotionPrior robot_motion(const LastStep& last, double dt_s);

/// Of a camera that may be in a hand: it forgets its speed within a tenth of a second, so that what
/// the images do not show of its motion comes to rest. It may have sped up by 3 m/s^2 and 300
/// degrees/s^2, within a second at most, and may as well have kept the speed it was not expected
/// to.
[[nodiscard]] MotionPrior hand_motion(const LastStep& last, double dt_s);

/// The prior given that the base stands level on the floor z = 0, but for rugs and springs: z
/// within 1 cm, roll and pitch within a degree (a Kalman update), and on_floor for the rest.
[[nodiscard]] PosePrior on_floor(const PosePrior& prior);

/// A covariance in the base's axes after a motion.
[[nodiscard]] Covariance6 moved(const Covariance6& covariance, const Pose& T_before_after);

}  // namespace mapscore
