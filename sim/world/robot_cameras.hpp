// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "sim/world/world.hpp"

#include <mujoco/mujoco.h>

#include <string>

namespace mapscore::sim {

/// Names of the robot's elements carry this prefix in the compiled model.
inline constexpr const char* kRobotPrefix = "robot/";

/// Calibration of the robot's cameras `color` and `depth` as the MJCF places them, read at the pose
/// that `data` holds (kinematics done). Focal lengths follow from `fovy` and `resolution` (4:3
/// where the MJCF gives none); another resolution in `overrides` keeps the horizontal field of
/// view. T_color_depth is rounded to 1e-12, so that cameras mounted alike are aligned exactly.
/// Throws Error naming `robot_file` when a camera is missing or not usable.
[[nodiscard]] Calibration read_calibration(const mjModel& model, const mjData& data, int base_body,
                                           const CameraOverrides& overrides,
                                           const std::string& robot_file);

}  // namespace mapscore::sim
