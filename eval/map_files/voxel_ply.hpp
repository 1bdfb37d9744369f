// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/mapping/semantic_map.hpp"

#include <filesystem>
#include <string>

namespace mapscore::eval {

/// The occupied voxels of a map whose best class has at least `threshold`, as binary little-endian
/// .ply points at their centres: float x y z (metres, frame map), uchar red green blue (of the
/// class), uint label (class id), float probability; ascending by key, as read_ply takes them.
/// Throws Error where a class is not in the table.
[[nodiscard]] std::string voxel_ply_bytes(const SemanticMap& map, const ClassTable& table,
                                          double threshold);

/// Writes them whole or not at all. Throws Error unless the file ends in .ply and can be written.
void write_voxel_ply(const std::filesystem::path& file, const SemanticMap& map,
                     const ClassTable& table, double threshold);

}  // namespace mapscore::eval
