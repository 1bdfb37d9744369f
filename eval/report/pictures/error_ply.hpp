// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/pictures/judgement.hpp"

#include <filesystem>
#include <string>

namespace mapscore::eval {

/// The judged voxels as points for CloudCompare and MeshLab: binary little-endian PLY, a vertex a
/// voxel in the order of `map.voxels`: float x y z (the centre, metres, frame map), uchar red green
/// blue (the verdict's colour), ushort class, uchar verdict (0 true, 1 near, 2 leak, 3 floating, 4
/// missed). A voxel that was missed under another class stands twice.
[[nodiscard]] std::string error_ply_bytes(const JudgedMap& map);

/// Writes them aside, then renames. Throws Error unless the file ends in .ply and can be written.
void write_error_ply(const std::filesystem::path& file, const JudgedMap& map);

}  // namespace mapscore::eval
