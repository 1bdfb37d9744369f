// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/mapping/semantic_map.hpp"

#include <Eigen/Core>
#include <filesystem>
#include <span>

namespace mapscore::eval {

/// Writes points of one class and instance as a .ply or .pcd file, by its ending; binary, float32
/// x, y, z and uint32 `label` and `instance` a point, as read_ply and read_pcd take them. Metres,
/// in the points' frame. Whole or not at all. Throws Error naming the file.
void write_cloud(const std::filesystem::path& file, std::span<const Eigen::Vector3d> points,
                 ClassId class_id, InstanceId instance);

/// Writes the occupied voxels of a map whose best class has at least `threshold`, as binary
/// little-endian .ply points at their centres: float x y z (metres, frame map), uchar red green
/// blue (of the class), uint label (class id), float probability; ascending by key, as read_ply
/// takes them. Whole or not at all. Throws Error where a class is not in the table, and unless the
/// file ends in .ply and can be written.
void write_voxel_ply(const std::filesystem::path& file, const SemanticMap& map,
                     const ClassTable& table, double threshold);

}  // namespace mapscore::eval
