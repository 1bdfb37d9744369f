// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace mapscore::eval {

/// What the nodes of an octree file hold.
enum class OctreeKind {
  binary,   ///< two bits a child: free, occupied or inner; OctoMap's .bt
  plain,    ///< log-odds
  colour,   ///< log-odds and three bytes of colour
  semantic  ///< log-odds and class probabilities
};

/// What the text at the head of an octree file says.
struct OctreeHeader {
  OctreeKind kind = OctreeKind::plain;
  std::size_t nodes = 0;  ///< inner ones and leaves; above 0
  double edge_m = 0.0;    ///< positive and finite
  std::size_t bytes = 0;  ///< of the header, after which the nodes stand
};

/// Reads the head of an .ot or .bt file as OctoMap does: lines of comment, id, size and res, in any
/// order, up to the line `data`. Throws Error naming the file.
[[nodiscard]] OctreeHeader parse_octree_header(std::string_view bytes,
                                               const std::filesystem::path& file);

}  // namespace mapscore::eval
