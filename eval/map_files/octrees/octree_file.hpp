// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/map_files/map_file.hpp"

#include <filesystem>

namespace mapscore::eval {

/// Reads an octree as OctoMap writes it: .ot files of OcTree, OcTreeStamped (without its stamps),
/// ColorOcTree and SemanticOcTree, and .bt files of any tree, whichever its ending says. Voxels
/// stand in the order of the file. Occupied: log-odds of at least 0, OctoMap's own threshold.
/// Labels: of ColorOcTree the colour, free voxels and OctoMap's "no colour", white, included; of
/// SemanticOcTree the most probable class (SemanticOcTreeNode::best), 0 for background and none.
/// Probabilities: of that class, else of occupancy; in a .bt file, which says only occupied or
/// free, the limits at which OctoMap clamps, 0.971 and 0.1192. Throws Error naming the file for
/// anything else, for damage, an empty map, and one of more than kMostMapVoxels voxels. Safe for
/// concurrent use.
[[nodiscard]] MapFile read_octree(const std::filesystem::path& file);

}  // namespace mapscore::eval
