// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

namespace mapscore::sim {

/// A rigid dose: fixed parts, and a magnitude whose direction the seed draws. Metres, radians.
struct RigidDose {
  Eigen::Vector3d translation_m =
      Eigen::Vector3d::Zero();  ///< in the optical axes that the error stands in
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  ///< rotation vector
  double magnitude_m = 0.0;  ///< along a direction uniform on the circle in the image plane
  double angle_rad = 0.0;    ///< about an axis uniform on the circle in the image plane
};

/// Error of the believed depth-to-colour registration. Moves labels, never points.
struct MisregistrationDose {
  RigidDose rigid;
  double focal_error = 0.0;  ///< fraction; the believed colour focal length is f * (1 + error)
  Eigen::Vector2d principal_point_px = Eigen::Vector2d::Zero();  ///< added to the colour centre
};

/// The rigid error E of a dose; the identity, bit for bit, when every dose is zero. The direction
/// drawn from (seed, purpose) does not depend on the dose.
[[nodiscard]] Pose rigid_error(const RigidDose& dose, std::uint64_t seed, std::string_view purpose);

/// Believed calibration under misregistration: T_believed_color_depth = E * T_color_depth, and the
/// colour intrinsics. A zero dose returns the true calibration bit for bit.
[[nodiscard]] Calibration misregister(const Calibration& truth, const MisregistrationDose& dose,
                                      std::uint64_t seed);

/// Believed calibration under a mount error: T_believed_base_depth = T_base_depth * M, with M in
/// depth optical axes. Moves points, never labels.
[[nodiscard]] Calibration misplace_mount(const Calibration& truth, const RigidDose& dose,
                                         std::uint64_t seed);

}  // namespace mapscore::sim
