// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/error.hpp"
#include "core/geometry/voxel.hpp"

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Largest index of a voxel, either sign, that maps are read with.
inline constexpr std::int32_t kFarthestIndex = 1'000'000;

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
  [[nodiscard]] bool is_occupied(std::size_t n) const {
    return occupied.empty() || occupied[n] != 0;
  }
};

/// What a map file is refused with that is whole and says that it holds no voxels or points.
class EmptyMap : public Error {
 public:
  using Error::Error;
};

/// What to do with points that have a coordinate that is not finite.
enum class NotFinite { refuse, skip };

/// The endings that read_map_file knows: ".ot, .bt, ...".
[[nodiscard]] std::string map_endings();

/// Whether read_map_file would try the file; it need not be there. Capitals do not matter.
[[nodiscard]] bool has_ending_of_a_map(const std::filesystem::path& file);

/// Reads a map by its ending (docs/formats.md). Throws Error naming the file, with where and why,
/// for what is missing, truncated, damaged or empty (EmptyMap, unless it lacks a header too).
[[nodiscard]] MapFile read_map_file(const std::filesystem::path& file,
                                    NotFinite not_finite = NotFinite::refuse);

// The readers behind it, whatever the ending says.

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

/// Points of a PCD file of the Point Cloud Library (ascii, binary or binary_compressed), with label
/// or colour, probability and instance by the names of docs/formats.md. Other fields are passed
/// over. Throws Error with the file and, for ascii, the line.
[[nodiscard]] MapFile read_pcd(const std::filesystem::path& file,
                               NotFinite not_finite = NotFinite::refuse);

/// The same of a PLY file (ascii or binary, either byte order): its element `vertex`. Other
/// elements and properties are passed over.
[[nodiscard]] MapFile read_ply(const std::filesystem::path& file,
                               NotFinite not_finite = NotFinite::refuse);

/// Voxels of a .csv of `i,j,k[,class[,probability[,instance]]]`, or, by its header, of columns in
/// any order, points `x,y,z` in place of voxels among them. Classes are ids when every one of them
/// is a whole number, else names. Throws Error with file and line, of both rows where a voxel
/// stands twice. In the truth's own table (header with `samples`) a voxel's row is its owner's, the
/// one with samples, else its first.
[[nodiscard]] MapFile read_voxel_csv(const std::filesystem::path& file,
                                     NotFinite not_finite = NotFinite::refuse);

}  // namespace mapscore::eval
