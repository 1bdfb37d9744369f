// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

#include <Eigen/Core>
#include <filesystem>
#include <span>

namespace mapscore::eval {

/// Writes points of one class and instance as a .ply or .pcd file, by its ending; binary, float32
/// x, y, z and uint32 `label` and `instance` a point, as read_ply and read_pcd take them. Metres,
/// in the points' frame. Whole or not at all. Throws Error naming the file.
void write_cloud(const std::filesystem::path& file, std::span<const Eigen::Vector3d> points,
                 ClassId class_id, InstanceId instance);

}  // namespace mapscore::eval
