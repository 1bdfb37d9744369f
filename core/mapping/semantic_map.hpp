// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/fusion/fusion_rule.hpp"
#include "core/geometry/posed_depth.hpp"
#include "core/geometry/voxel.hpp"
#include "core/mapping/semantic_octree.hpp"
#include "core/placement/placement.hpp"
#include "core/space/occupancy.hpp"

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
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

/// What a map holds of one voxel whose class it believes something of.
struct BelievedVoxel {
  VoxelKey key;
  ClassBeliefs beliefs;
  std::optional<Colour> colour;  ///< mean; none where no colour was seen
};

/// A point with its colour, in frame `map` (metres).
struct ColouredPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Colour colour;
};

/// A semantic voxel map in frame `map`: an octree of class probabilities and occupancy. Const
/// members, save() too, are safe from several threads while nothing changes the map; changes are
/// not.
class SemanticMap {
 public:
  /// Where `carving` says so, occupancy comes from see() alone, by its model, and fuse() leaves
  /// it as it is; else each voxel that a frame hits gets one hit of OctoMap's defaults [M]. Throws
  /// Error unless the voxel edge is positive and the numbers of the model lie within their ranges.
  explicit SemanticMap(double edge_m, const Carving& carving = {});

  [[nodiscard]] double edge_m() const { return edge_m_; }

  /// Changes the voxels that some draw of one frame hit by the rule; the others keep their value.
  /// `hits` as place() gives them, `draws` is N. Hits beyond the octree's span are left out and
  /// counted in `hits_beyond_span`. Throws Error, the map unchanged, when the rule is out of range,
  /// N < 1, or a hit is not of N draws or names a class beyond `class_count`, the table's size.
  void fuse(std::span<const VoxelHit> hits, int draws, const FusionRule& rule,
            std::size_t class_count = kOtherClasses);

  [[nodiscard]] bool carves() const { return carving_.carve; }
  /// One miss for every voxel that a frame at `origin` saw through to `points`, one hit for every
  /// voxel with a point in it or with one of `hits` (seen_space). Call it before the frame's
  /// fuse(). Points that are not finite or beyond the octree's span are left out and counted in
  /// `hits_beyond_span`. Throws Error, the map unchanged, where it does not carve or as seen_space.
  void see(const Eigen::Vector3d& origin, std::span<const Eigen::Vector3d> points,
           std::span<const VoxelHit> hits = {});
  /// Adds each point's colour to its voxel's mean, in voxels that are in the map.
  void add_colours(std::span<const ColouredPoint> points);

  /// Makes one leaf of eight that agree in all they hold, as often as it goes. No reading of the
  /// map changes.
  void prune() { tree_->prune(); }
  /// Adds the map of other frames: log-odds, clamped; colours; beliefs by merged(rule). Throws
  /// Error, the map unchanged, when the edges differ or the rule does not allow it.
  void merge(const SemanticMap& other, const FusionRule& rule);
  /// The blend's decay of all voxels in view (Decay::view), but for those with `hits`, which fuse()
  /// lets decay itself. Call it once a frame, before or after fuse(). Throws Error.
  void decay_in_view(const DepthView& view, const BlendRule& rule, std::span<const VoxelHit> hits);

  [[nodiscard]] std::size_t hits_beyond_span() const { return hits_beyond_span_; }

  /// All voxels, pruned leaves spread out, ascending by key.
  [[nodiscard]] std::vector<MapVoxel> voxels() const;
  /// What one voxel believes (ClassBeliefs::entries); empty when it is not in the map.
  [[nodiscard]] std::span<const ClassProbability> classes_at(const VoxelKey& key) const;
  /// The voxels with beliefs, pruned leaves spread out, ascending by key.
  [[nodiscard]] std::vector<BelievedVoxel> believed_voxels() const;
  /// Gives a voxel of the map other beliefs. Throws Error, the map unchanged, when it is not in the
  /// map or they are not well formed.
  void set_beliefs(const VoxelKey& key, ClassBeliefs beliefs);
  [[nodiscard]] const SemanticOcTree& tree() const { return *tree_; }

  /// Writes the map as .ot (type SemanticOcTree), aside and then renamed. Throws Error.
  void save(const std::filesystem::path& file) const;
  /// Reads what save() wrote. Throws Error naming the file when it is damaged or something else.
  [[nodiscard]] static SemanticMap load(const std::filesystem::path& file);
  /// Writes the voxels whose best class has at least `threshold` as a ColorOcTree .ot in the class
  /// colours, which octovis and ROS open. Throws Error, also for a class beyond the table.
  void export_color(const std::filesystem::path& file, const ClassTable& table,
                    double threshold) const;

 private:
  explicit SemanticMap(std::unique_ptr<SemanticOcTree> tree);

  double edge_m_;
  std::unique_ptr<SemanticOcTree> tree_;
  Carving carving_;
  std::size_t hits_beyond_span_ = 0;
};

}  // namespace mapscore
