// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/map_files/map_file.hpp"

#include <filesystem>

namespace mapscore::eval {

/// Points of a PCD file of the Point Cloud Library (ascii, binary or binary_compressed), with label
/// or colour, probability and instance by the names of docs/formats.md. Other fields are passed
/// over. Throws Error with the file and, for ascii, the line.
[[nodiscard]] MapFile read_pcd(const std::filesystem::path& file,
                               NotFinite not_finite = NotFinite::refuse);

}  // namespace mapscore::eval
