// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/camera.hpp"

#include "core/error.hpp"

#include <cmath>
#include <string>

namespace mapscore {
namespace {

constexpr double kMostApart_m = 10.0;  // of what one robot carries
constexpr double kLongest_px = 1e6;    // of a focal length: a pixel is .2 seconds of arc wide

void check(const CameraModel& camera, const std::string& name) {
  if (camera.width_px < 1 || camera.height_px < 1)
    throw Error(name + " camera: has " + std::to_string(camera.width_px) + " x " +
                std::to_string(camera.height_px) + " pixels; give at least one");
  const auto length = [](double focal) { return focal > 0.0 && focal <= kLongest_px; };
  if (!length(camera.fx_px) || !length(camera.fy_px))
    throw Error(name + " camera: focal lengths " + std::to_string(camera.fx_px) + " and " +
                std::to_string(camera.fy_px) + " pixels; both must be positive, at most a million");
  if (!std::isfinite(camera.cx_px) || !std::isfinite(camera.cy_px))
    throw Error(name + " camera: its principal point is not finite; give it in pixels");
}

/// A pose of the depth camera in something that the same robot carries.
void check(const Pose& T_other_depth, const std::string& name, const std::string& other) {
  if (!T_other_depth.matrix().allFinite() || T_other_depth.translation().norm() > kMostApart_m)
    throw Error(name + ": " + std::to_string(T_other_depth.translation().norm()) +
                " m away, where 10 is the most; give the depth camera's pose in " + other +
                ", in metres");
}

}  // namespace

void check(const Calibration& calibration) {
  check(calibration.color, "colour");
  check(calibration.depth, "depth");
  check(calibration.T_color_depth, "T_color_depth", "the colour camera");
  check(calibration.T_base_depth, "T_base_depth", "the robot's base");
}

CameraModel CameraModel::from_hfov(int width_px, int height_px, double hfov_rad) {
  const double focal = 0.5 * width_px / std::tan(0.5 * hfov_rad);
  return {width_px, height_px, focal, focal, 0.5 * (width_px - 1), 0.5 * (height_px - 1)};
}

}  // namespace mapscore
