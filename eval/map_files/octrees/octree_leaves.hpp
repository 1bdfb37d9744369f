// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"
#include "eval/map_files/octrees/octree_header.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>

namespace mapscore::eval {

/// A leaf of an octree file: the cube of span^3 finest voxels that begins at `low`.
struct OctreeLeaf {
  VoxelKey low;
  std::int32_t span = 1;
  bool occupied = false;
  double probability = 0.0;  ///< of the label's class where the file has classes, else of occupancy
  std::uint32_t label = 0;   ///< class, 0xRRGGBB, or 0 where the file has neither
};

/// Calls `on_leaf` for each leaf in the order of the file. Checks as it goes, so what was handed
/// out before an Error is of no use. Takes no memory that grows with the file. Throws Error naming
/// the file for nodes deeper than OctoMap's 16 levels, missing or spare nodes and bytes, log-odds
/// that are not finite, and probabilities outside [0, 1].
void for_each_leaf(std::string_view bytes, const OctreeHeader& header,
                   const std::filesystem::path& file,
                   const std::function<void(const OctreeLeaf&)>& on_leaf);

}  // namespace mapscore::eval
