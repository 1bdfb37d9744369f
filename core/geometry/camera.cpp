// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/camera.hpp"

#include "core/error.hpp"

#include <cmath>
#include <string>

namespace mapscore {
namespace {

constexpr double kMostApart_m = 10.0;  // of two cameras of one robot

void check(const CameraModel& camera, const std::string& name) {
  if (camera.width_px < 1 || camera.height_px < 1)
    throw Error(name + " camera: has " + std::to_string(camera.width_px) + " x " +
                std::to_string(camera.height_px) + " pixels; give at least one");
  const auto length = [](double focal) { return focal > 0.0 && std::isfinite(focal); };
  if (!length(camera.fx_px) || !length(camera.fy_px))
    throw Error(name + " camera: focal lengths " + std::to_string(camera.fx_px) + " and " +
                std::to_string(camera.fy_px) + " pixels; both must be positive");
  if (!std::isfinite(camera.cx_px) || !std::isfinite(camera.cy_px))
    throw Error(name + " camera: its principal point is not finite; give it in pixels");
}

}  // namespace

void check(const Calibration& calibration) {
  check(calibration.color, "colour");
  check(calibration.depth, "depth");
  if (!calibration.T_color_depth.matrix().allFinite())
    throw Error("T_color_depth: not finite; give the depth camera's pose in the colour camera");
  if (calibration.T_color_depth.translation().norm() > kMostApart_m)
    throw Error(
        "T_color_depth: the two cameras are more than 10 m apart; give the depth camera's pose "
        "in the colour camera, in metres");
}

CameraModel CameraModel::from_hfov(int width_px, int height_px, double hfov_rad) {
  const double focal = 0.5 * width_px / std::tan(0.5 * hfov_rad);
  return {width_px, height_px, focal, focal, 0.5 * (width_px - 1), 0.5 * (height_px - 1)};
}

}  // namespace mapscore
