// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// truth/shapes.csv: every shape but meshes, one a line, world frame, metres. Throws Error when a
/// shape is not finite, has no extent, or its name breaks lines.
[[nodiscard]] std::string shape_table_text(const std::vector<Shape>& shapes);

/// Throws Error with file and line when the file is missing or a line is not of the format; an
/// instance must be below `instance_count`.
[[nodiscard]] std::vector<Shape> read_shape_table(const std::filesystem::path& file,
                                                  std::size_t instance_count);

}  // namespace mapscore::eval
