// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/octrees/octree_file.hpp"

#include "core/mapping/semantic_octree.hpp"
#include "eval/map_files/octrees/octree_leaves.hpp"
#include "eval/map_files/refusal.hpp"
#include "files/file_bytes.hpp"

#include <fmt/format.h>

namespace mapscore::eval {
namespace {

/// A pruned leaf of a few bits covers any number of voxels. A .bt of an empty room, the most that
/// honest maps have, comes to 20 a byte at 5 cm and 60 at 2 cm.
constexpr std::size_t kMostVoxelsAByte = 128;
constexpr std::size_t kAlwaysSpread = 1 << 21;

/// Adds the finest voxels that a leaf covers, and what they share.
void spread(const OctreeLeaf& leaf, MapFile& map) {
  for (std::int32_t i = 0; i < leaf.span; ++i)
    for (std::int32_t j = 0; j < leaf.span; ++j)
      for (std::int32_t k = 0; k < leaf.span; ++k)
        map.voxels.push_back({leaf.low.i + i, leaf.low.j + j, leaf.low.k + k});
  map.occupied.resize(map.voxels.size(), leaf.occupied ? 1 : 0);
  map.probabilities.resize(map.voxels.size(), leaf.probability);
  if (map.label_kind != LabelKind::none) map.labels.resize(map.voxels.size(), leaf.label);
}

LabelKind label_kind_of(OctreeKind kind) {
  if (kind == OctreeKind::colour) return LabelKind::colour;
  return kind == OctreeKind::semantic ? LabelKind::id : LabelKind::none;
}

}  // namespace

MapFile read_octree(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  const OctreeHeader header = parse_octree_header(bytes, file);
  std::size_t voxels = 0;  // the whole file is checked before anything is spread out
  for_each_leaf(bytes, header, file, [&](const OctreeLeaf& leaf) {
    const auto span = static_cast<std::size_t>(leaf.span);
    voxels += span * span * span;
  });
  if (voxels > kMostMapVoxels)
    refuse(file, fmt::format("its leaves cover {} voxels, at most {} are read; cut the map down to "
                             "the part in question or write it with larger voxels",
                             voxels, kMostMapVoxels));
  if (voxels > kAlwaysSpread && voxels / kMostVoxelsAByte >= bytes.size())
    refuse(file,
           fmt::format("{} bytes whose leaves cover {} voxels, more than {} a byte; cut empty "
                       "space off the map, or write it with larger voxels",
                       bytes.size(), voxels, kMostVoxelsAByte));
  MapFile map;
  map.edge_m = header.edge_m;
  map.label_kind = label_kind_of(header.kind);
  map.voxels.reserve(voxels);
  map.occupied.reserve(voxels);
  map.probabilities.reserve(voxels);
  if (map.label_kind != LabelKind::none) map.labels.reserve(voxels);
  for_each_leaf(bytes, header, file, [&](const OctreeLeaf& leaf) { spread(leaf, map); });
  return map;
}

}  // namespace mapscore::eval
