// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/map_files/map_file.hpp"

#include <filesystem>

namespace mapscore::eval {

/// Points of a PLY file (ascii or binary, either byte order): its element `vertex`, with label or
/// colour, probability and instance by the names of docs/formats.md. Other elements and properties
/// are passed over. Throws Error with the file and, for ascii, the line.
[[nodiscard]] MapFile read_ply(const std::filesystem::path& file,
                               NotFinite not_finite = NotFinite::refuse);

}  // namespace mapscore::eval
