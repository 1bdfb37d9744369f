// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// What the labels of a map file are.
enum class LabelKind {
  none,    ///< geometry alone
  colour,  ///< 0xRRGGBB
  id,      ///< a number that the legend, or the truth's class table, gives a meaning
  name,    ///< index into `names`
};

/// A map as its file holds it: either voxels or points, in the file's own frame, before a legend
/// gives its labels a meaning and before it lies on the lattice of the truth. Every list but the
/// geometry is empty (the file does not say) or as long as the geometry.
struct MapFile {
  double edge_m = 0.0;           ///< of the voxels; 0 where the file does not say, and for points
  std::vector<VoxelKey> voxels;  ///< finest voxels: pruned leaves are spread out; each once
  std::vector<Eigen::Vector3d> points;  ///< metres, all finite

  LabelKind label_kind = LabelKind::none;
  std::vector<std::uint32_t> labels;
  std::vector<std::string> names;        ///< for LabelKind::name
  std::vector<double> probabilities;     ///< in [0, 1]; of the label, or of occupancy; empty: all 1
  std::vector<std::uint8_t> occupied;    ///< 0: known to be free; empty: all occupied
  std::vector<std::uint32_t> instances;  ///< of an object each, 0: none

  [[nodiscard]] std::size_t size() const { return voxels.empty() ? points.size() : voxels.size(); }
};

/// What to do with points that have a coordinate that is not finite.
enum class NotFinite { refuse, skip };

/// The endings that read_map_file knows: ".ot, .bt, ...".
[[nodiscard]] std::string map_endings();

/// Whether read_map_file would try the file; it need not be there. Capitals do not matter.
[[nodiscard]] bool has_ending_of_a_map(const std::filesystem::path& file);

/// Reads a map by its ending (docs/formats.md). Throws Error naming the file, with where and why,
/// for what is missing, truncated, damaged or empty.
[[nodiscard]] MapFile read_map_file(const std::filesystem::path& file,
                                    NotFinite not_finite = NotFinite::refuse);

}  // namespace mapscore::eval
