// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

// The exact surfaces of a recording: truth/shapes.csv and truth/triangles.ply.

/// truth/shapes.csv: every shape but meshes, one a line, world frame, metres. Throws Error when a
/// shape is not finite, has no extent, or its name breaks lines.
[[nodiscard]] std::string shape_table_text(const std::vector<Shape>& shapes);

/// Throws Error with file and line when the file is missing or a line is not of the format; an
/// instance must be below `instance_count`.
[[nodiscard]] std::vector<Shape> read_shape_table(const std::filesystem::path& file,
                                                  std::size_t instance_count);

/// truth/triangles.ply: the meshes among `shapes`, in their order, as triangles in the world frame;
/// empty text without any. Throws Error when a mesh has no triangles or a corner is not finite.
[[nodiscard]] std::string triangle_ply_bytes(const std::vector<Shape>& shapes);

/// Meshes with T_world_shape the identity. Throws Error naming the file and the reason; an instance
/// must be below `instance_count`.
[[nodiscard]] std::vector<Shape> read_triangle_ply(const std::filesystem::path& file,
                                                   std::size_t instance_count);

}  // namespace mapscore::eval
