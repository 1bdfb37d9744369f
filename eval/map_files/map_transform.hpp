// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace mapscore::eval {

/// A pose in numbers: `tx ty tz qx qy qz qw` (metres, unit quaternion), the same with a stamp ahead
/// as in TUM trajectories, or the 16 of a 4x4 matrix row by row, its rotation orthonormal to 1e-6.
/// Blanks, line ends and commas stand between them; `#` opens a comment. Throws Error, "WHERE:
/// ...".
[[nodiscard]] Pose parse_transform(std::string_view text, const std::string& where);

/// T_map_file: the same from a file.
[[nodiscard]] Pose read_transform(const std::filesystem::path& file);

}  // namespace mapscore::eval
