// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/voxel.hpp"
#include "core/mapping/depth_view.hpp"
#include "core/mapping/fusion_rule.hpp"
#include "core/mapping/semantic_octree.hpp"
#include "core/mapping/voxel_hit.hpp"

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace mapscore {

/// One voxel of a map as the score reads it.
struct MapVoxel {
  VoxelKey key;
  ClassId best_class = kBackground;
  double probability = 0.0;
  bool occupied = true;
};

/// A semantic voxel map in frame `map`: an octree of class probabilities and occupancy. Not safe
/// for concurrent writes.
class SemanticMap {
 public:
  /// Throws Error unless the voxel edge is positive.
  explicit SemanticMap(double edge_m);

  [[nodiscard]] double edge_m() const { return edge_m_; }

  /// Changes the voxels that some draw of one frame hit by the rule; the others keep their value.
  /// `hits` as place() gives them, `draws` is N. Hits beyond the octree's span are left out and
  /// counted in `hits_beyond_span`. Throws Error, the map unchanged, when the rule is out of range,
  /// N < 1, or a hit is not of N draws or names a class beyond `class_count`, the table's size.
  void fuse(std::span<const VoxelHit> hits, int draws, const FusionRule& rule,
            std::size_t class_count = kOtherClasses);

  /// The blend's decay of all voxels in view (Decay::view), but for those with `hits`, which fuse()
  /// lets decay itself. Call it once a frame, before or after fuse(). Throws Error.
  void decay_in_view(const DepthView& view, const BlendRule& rule, std::span<const VoxelHit> hits);

  [[nodiscard]] std::size_t hits_beyond_span() const { return hits_beyond_span_; }

  /// All voxels, pruned leaves spread out, ascending by key.
  [[nodiscard]] std::vector<MapVoxel> voxels() const;
  /// What one voxel believes (ClassBeliefs::entries); empty when it is not in the map.
  [[nodiscard]] std::span<const ClassProbability> classes_at(const VoxelKey& key) const;

  /// Writes the map as .ot (type SemanticOcTree), aside and then renamed. Throws Error.
  void save(const std::filesystem::path& file) const;
  [[nodiscard]] static SemanticMap load(const std::filesystem::path& file);
  /// Writes the voxels whose best class has at least `threshold` as a ColorOcTree .ot in the class
  /// colours, which octovis and ROS open.
  void export_color(const std::filesystem::path& file, const ClassTable& table,
                    double threshold) const;

 private:
  explicit SemanticMap(std::unique_ptr<SemanticOcTree> tree);

  double edge_m_;
  std::unique_ptr<SemanticOcTree> tree_;
  std::size_t hits_beyond_span_ = 0;
};

}  // namespace mapscore
