// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/calibration_faults.hpp"

#include "core/error.hpp"
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

Eigen::Vector3d radians(const std::array<Degrees, 3>& rotation) {
  return {rotation[0].rad(), rotation[1].rad(), rotation[2].rad()};
}

}  // namespace

void check(const RigidDose& dose) {
  const RigidDose none;
  if (dose.magnitude_m != 0 && dose.translation_m != none.translation_m)
    throw Error("translation_m: stands beside a magnitude_m; keep one of the two");
  if (dose.angle_deg.deg != 0 && dose.rotation_deg != none.rotation_deg)
    throw Error("rotation_deg: stands beside an angle_deg; keep one of the two");
}

Pose rigid_error(const RigidDose& dose, std::uint64_t seed, std::string_view purpose) {
  if (dose == RigidDose{}) return Pose::Identity();
  RandomStream stream(seed, purpose);
  const Eigen::Vector3d shift = image_direction(stream);
  const Eigen::Vector3d axis = image_direction(stream);
  Pose error = Pose::Identity();
  error.linear() = exp_rotation(radians(dose.rotation_deg) + dose.angle_deg.rad() * axis);
  error.translation() =
      Eigen::Map<const Eigen::Vector3d>(dose.translation_m.data()) + dose.magnitude_m * shift;
  return error;
}

Calibration misregister(const Calibration& truth, const Misregistration& dose, std::uint64_t seed) {
  Calibration believed = truth;
  if (dose.rigid != RigidDose{})
    believed.T_color_depth = rigid_error(dose.rigid, seed, "misregistration") * truth.T_color_depth;
  const double focal_error = dose.focal_error_percent / 100.0;
  believed.color.fx_px *= 1.0 + focal_error;
  believed.color.fy_px *= 1.0 + focal_error;
  believed.color.cx_px += dose.principal_point_px[0];
  believed.color.cy_px += dose.principal_point_px[1];
  return believed;
}

Calibration misplace_mount(const Calibration& truth, const MountError& dose, std::uint64_t seed) {
  Calibration believed = truth;
  if (dose.rigid != RigidDose{})
    believed.T_base_depth = truth.T_base_depth * rigid_error(dose.rigid, seed, "mount");
  return believed;
}

}  // namespace mapscore::sim
