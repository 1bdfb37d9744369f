// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/robot_cameras.hpp"

#include "core/error.hpp"
#include "sim/world/mujoco_session.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mapscore::sim {
namespace {

constexpr double kLargestDepthM = 65535 / kDepthUnitsPerMetre;

void check(const CameraOverrides& cameras) {
  if (cameras.width_px < 1 || cameras.height_px < 1)
    throw Error(fmt::format("cameras: resolution {} x {}: must be at least 1 x 1 px",
                            cameras.width_px, cameras.height_px));
  const bool ordered = cameras.range_min_m > 0 && cameras.range_max_m > cameras.range_min_m;
  if (!ordered || cameras.range_max_m > kLargestDepthM)
    throw Error(fmt::format("cameras: depth range {} to {} m: give 0 < min < max <= {} m",
                            cameras.range_min_m, cameras.range_max_m, kLargestDepthM));
}

int find_camera(const mjModel& model, const std::string& name, const std::string& robot_file) {
  const int id = mj_name2id(&model, mjOBJ_CAMERA, (kRobotPrefix + name).c_str());
  if (id < 0)
    throw Error(
        fmt::format("{}: no camera `{}` under body base_footprint; add one", robot_file, name));
  if (model.cam_fovy[id] <= 0 || model.cam_fovy[id] >= 180)
    throw Error(
        fmt::format("{}: camera `{}`: fovy must lie between 0 and 180 degrees", robot_file, name));
  return id;
}

CameraModel intrinsics(const mjModel& model, int camera, const CameraOverrides& overrides) {
  const int* resolution = model.cam_resolution + 2 * camera;
  const bool given = resolution[0] > 1 && resolution[1] > 1;
  const double aspect = given ? static_cast<double>(resolution[0]) / resolution[1] : 4.0 / 3.0;
  const double half_fovy = model.cam_fovy[camera] * M_PI / 360.0;
  const double hfov = 2.0 * std::atan(aspect * std::tan(half_fovy));
  return CameraModel::from_hfov(overrides.width_px, overrides.height_px, hfov);
}

/// MuJoCo's cameras look along -z with y up; optical frames look along +z with y down.
Pose optical_pose(const mjData& data, int camera) {
  Pose pose = pose_of(data.cam_xpos + 3 * camera, data.cam_xmat + 9 * camera);
  pose.linear() = pose.linear() * Eigen::Vector3d(1, -1, -1).asDiagonal();
  return pose;
}

Pose rounded(const Pose& pose) {
  constexpr double kSteps = 1e12;
  Pose result = Pose::Identity();
  result.matrix().topRows<3>() = pose.matrix().topRows<3>().unaryExpr(
      [](double x) { return std::round(x * kSteps) / kSteps + 0.0; });
  return result;
}

/// The rig at the height and angles of the overrides: R = Rz(pan) Ry(tilt) Rx(roll).
Pose aimed(const Pose& T_base_rig, const CameraOverrides& overrides) {
  const Eigen::Matrix3d& R = T_base_rig.linear();
  const auto turn = [](double pan_rad, double tilt_rad) {
    return (Eigen::AngleAxisd(pan_rad, Eigen::Vector3d::UnitZ()) *
            Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d::UnitY()))
        .toRotationMatrix();
  };
  const double pan_rad = std::atan2(R(1, 0), R(0, 0));
  const double tilt_rad = std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0)));
  const Eigen::Matrix3d roll = turn(pan_rad, tilt_rad).transpose() * R;
  Pose pose = T_base_rig;
  pose.linear() =
      turn(overrides.pan_rad.value_or(pan_rad), overrides.tilt_rad.value_or(tilt_rad)) * roll;
  pose.translation().z() = overrides.height_m.value_or(pose.translation().z());
  return pose;
}

}  // namespace

Calibration read_calibration(const mjModel& model, const mjData& data, int base_body,
                             const CameraOverrides& overrides, const std::string& robot_file) {
  check(overrides);
  const int color = find_camera(model, "color", robot_file);
  const int depth = find_camera(model, "depth", robot_file);
  const Pose T_base_world = pose_of(data.xpos + 3 * base_body, data.xmat + 9 * base_body).inverse();
  const Pose T_world_depth = optical_pose(data, depth);
  Calibration calibration;
  calibration.color = intrinsics(model, color, overrides);
  calibration.depth = intrinsics(model, depth, overrides);
  calibration.T_color_depth = rounded(optical_pose(data, color).inverse() * T_world_depth);
  calibration.T_base_depth = T_base_world * T_world_depth;
  if (overrides.height_m || overrides.pan_rad || overrides.tilt_rad) {
    const int rig = model.cam_bodyid[color];
    const Pose T_base_rig = T_base_world * pose_of(data.xpos + 3 * rig, data.xmat + 9 * rig);
    calibration.T_base_depth =
        aimed(T_base_rig, overrides) * T_base_rig.inverse() * calibration.T_base_depth;
  }
  calibration.range_min_m = overrides.range_min_m;
  calibration.range_max_m = overrides.range_max_m;
  return calibration;
}

}  // namespace mapscore::sim
