// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/mapping/semantic_map.hpp"

#include <filesystem>
#include <vector>

namespace mapscore::eval {

/// Voxels of a map file: .ot (semantic, as `mapscore run` writes them) or .csv of i,j,k,class
/// (class by name or id, probability 1). Throws Error naming the file and line, when the edges
/// differ, and for the formats that are not read yet.
[[nodiscard]] std::vector<MapVoxel> read_map(const std::filesystem::path& file, double voxel_m,
                                             const ClassTable& table);

}  // namespace mapscore::eval
