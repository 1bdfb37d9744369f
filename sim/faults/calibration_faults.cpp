// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/calibration_faults.hpp"

#include "core/random_stream.hpp"

#include <cmath>
#include <numbers>

namespace mapscore::sim {
namespace {

/// A direction uniform on the circle in the image plane (x right, y down).
Eigen::Vector3d image_direction(RandomStream& stream) {
  const double angle = 2.0 * std::numbers::pi * stream.uniform();
  return {std::cos(angle), std::sin(angle), 0.0};
}

bool is_zero(const RigidDose& dose) {
  return dose.translation_m.isZero(0.0) && dose.rotation_rad.isZero(0.0) &&
         dose.magnitude_m == 0.0 && dose.angle_rad == 0.0;
}

}  // namespace

Pose rigid_error(const RigidDose& dose, std::uint64_t seed, std::string_view purpose) {
  if (is_zero(dose)) return Pose::Identity();
  RandomStream stream(seed, purpose);
  const Eigen::Vector3d shift = image_direction(stream);
  const Eigen::Vector3d axis = image_direction(stream);
  Pose error = Pose::Identity();
  error.linear() = exp_rotation(dose.rotation_rad + dose.angle_rad * axis);
  error.translation() = dose.translation_m + dose.magnitude_m * shift;
  return error;
}

Calibration misregister(const Calibration& truth, const MisregistrationDose& dose,
                        std::uint64_t seed) {
  Calibration believed = truth;
  if (!is_zero(dose.rigid))
    believed.T_color_depth = rigid_error(dose.rigid, seed, "misregistration") * truth.T_color_depth;
  believed.color.fx_px *= 1.0 + dose.focal_error;
  believed.color.fy_px *= 1.0 + dose.focal_error;
  believed.color.cx_px += dose.principal_point_px.x();
  believed.color.cy_px += dose.principal_point_px.y();
  return believed;
}

Calibration misplace_mount(const Calibration& truth, const RigidDose& dose, std::uint64_t seed) {
  Calibration believed = truth;
  if (!is_zero(dose)) believed.T_base_depth = truth.T_base_depth * rigid_error(dose, seed, "mount");
  return believed;
}

}  // namespace mapscore::sim
