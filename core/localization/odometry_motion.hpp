// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/planar_pose.hpp"
#include "core/parameters.hpp"
#include "core/random_stream.hpp"

#include <Eigen/Core>

namespace mapscore {

/// Noise of the odometry motion model: S. Thrun, W. Burgard, D. Fox, Probabilistic Robotics (2005),
/// section 5.4. Each squares to a variance: the model's alphas are those of the book's text, which
/// multiply squares (sigma^2 = alpha u^2).
struct OdometryNoise {
  double alpha1 = 0.003;   ///< rad^2 / rad^2
  double alpha2 = 0.0003;  ///< rad^2 / m^2
  double alpha3 = 0.003;   ///< m^2 / m^2
  double alpha4 = 0.001;   ///< m^2 / rad^2
  /// Below this way the direction of travel says nothing: the motion counts as a turn on the spot.
  double least_way_m = 0.005;

  static void fields(auto& s, auto&& visit) {
    constexpr Range kAlpha{0, 100};
    visit(s.alpha1, Field{"alpha1", "variance of a turn by turn squared", kAlpha});
    visit(s.alpha2, Field{"alpha2", "variance of a turn by way squared", kAlpha});
    visit(s.alpha3, Field{"alpha3", "variance of the way by way squared", kAlpha});
    visit(s.alpha4, Field{"alpha4", "variance of the way by turn squared", kAlpha});
  }
  bool operator==(const OdometryNoise&) const = default;
};

/// A motion in the frame of the robot before it: turn by rot1, drive by trans, turn by rot2.
/// Whoever drives backwards has trans < 0 and turns little.
struct OdometryMotion {
  double rot1_rad = 0.0, trans_m = 0.0, rot2_rad = 0.0;
};

/// The three parts of a motion T_before_after; their composition is that motion again, but for a
/// way below `least_way_m`, which keeps length and heading and loses its direction.
[[nodiscard]] OdometryMotion motion_parts(const PlanarPose& T_before_after, double least_way_m);

/// T_before_after of the three parts.
[[nodiscard]] PlanarPose motion_pose(const OdometryMotion& motion);

/// Standard deviations of the three parts.
struct MotionSigmas {
  double rot1_rad = 0.0, trans_m = 0.0, rot2_rad = 0.0;
};
/// Equation by equation of table 5.6. Throws Error when an alpha is negative or not finite.
[[nodiscard]] MotionSigmas motion_sigmas(const OdometryMotion& motion, const OdometryNoise& noise);

/// A draw of T_before_after of the true motion, given the measured one. Takes three normals.
[[nodiscard]] PlanarPose sample_motion(const OdometryMotion& motion, const MotionSigmas& sigmas,
                                       RandomStream& stream);

/// Covariance of the error of a motion to first order, x y yaw in the axes of the robot after it.
[[nodiscard]] Eigen::Matrix3d motion_covariance(const OdometryMotion& motion,
                                                const MotionSigmas& sigmas);

}  // namespace mapscore
