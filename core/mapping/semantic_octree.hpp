// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/fusion/class_beliefs.hpp"
#include "core/fusion/fusion_rule.hpp"
#include "core/geometry/voxel.hpp"
#include "core/space/occupancy.hpp"
#include "core/space/space_grid.hpp"

#include <octomap/OcTreeNode.h>
#include <octomap/OccupancyOcTreeBase.h>

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mapscore {

/// Most finest voxels that the leaves of a map file may cover; damaged leaves can ask for 2^48.
inline constexpr std::size_t kMostMapVoxels = 50'000'000;

/// In a file, the bit of a voxel's number of classes that says that its colour follows them.
inline constexpr std::uint16_t kHasColour = 0x8000;

/// Sum of the colours seen in a voxel, whose mean is exact in any order; 2^24 of them at most.
struct ColourSum {
  std::uint32_t r = 0, g = 0, b = 0, count = 0;

  bool operator==(const ColourSum&) const = default;

  void add(const Colour& colour) { *this += {colour.r, colour.g, colour.b, 1}; }
  ColourSum& operator+=(const ColourSum& other) {
    r += other.r, g += other.g, b += other.b, count += other.count;
    return *this;
  }
  /// Rounded to the nearest; black where there is none.
  [[nodiscard]] Colour mean() const {
    const auto channel = [&](std::uint32_t sum) {
      return static_cast<std::uint8_t>(count == 0 ? 0 : (sum + count / 2) / count);
    };
    return {channel(r), channel(g), channel(b)};
  }
};

/// Voxel of a semantic map: occupancy log-odds (OctoMap's), and where a surface was seen its mean
/// colour and what is believed of its class. Free voxels, which are most of a carved map, hold
/// neither and take 24 bytes.
class SemanticOcTreeNode : public octomap::OcTreeNode {
 public:
  static void* operator new(std::size_t bytes);
  static void* operator new(std::size_t, void* place) { return place; }
  static void operator delete(void* node) noexcept;

  [[nodiscard]] const ClassBeliefs& beliefs() const;
  [[nodiscard]] const ColourSum& colour() const;
  /// For changing them.
  [[nodiscard]] ClassBeliefs& mutable_beliefs() { return surface().beliefs; }
  [[nodiscard]] ColourSum& mutable_colour() { return surface().colour; }
  void clear_surface() { surface_.reset(); }

  bool operator==(const SemanticOcTreeNode& other) const;
  void copyData(const SemanticOcTreeNode& from);
  /// Most probable class, ties to the lower id; background with probability 0 when there is none.
  [[nodiscard]] ClassProbability best() const { return beliefs().best(); }

  /// OctoMap's streaming of one node's own data; native byte order, as OctoMap writes its floats.
  std::istream& readData(std::istream& stream);
  std::ostream& writeData(std::ostream& stream) const { return write_as(value, stream); }
  /// The same with other log-odds.
  std::ostream& write_as(float log_odds, std::ostream& stream) const;

 private:
  struct Surface {
    ClassBeliefs beliefs;
    ColourSum colour;
  };
  Surface& surface();

  std::unique_ptr<Surface> surface_;
};

/// OctoMap octree of semantic voxels; type id "SemanticOcTree" in .ot files. Const members are safe
/// from several threads while nothing changes it; writes are not.
class SemanticOcTree : public octomap::OccupancyOcTreeBase<SemanticOcTreeNode> {
 public:
  explicit SemanticOcTree(double edge_m);
  SemanticOcTree(const SemanticOcTree&) = delete;
  SemanticOcTree& operator=(const SemanticOcTree&) = delete;
  SemanticOcTree* create() const override { return new SemanticOcTree(resolution); }
  std::string getTreeType() const override { return "SemanticOcTree"; }

  /// Reads a whole .ot stream of this type, as octomap::AbstractOcTree::read does, but says nothing
  /// on standard error, takes nothing half-read for whole and goes no deeper than an octree does.
  /// Throws Error with the reason, also where the leaves cover more than kMostMapVoxels.
  [[nodiscard]] static std::unique_ptr<SemanticOcTree> read_whole(std::istream& stream);

  /// As octomap's, after updateInnerOccupancy; but the tree stays as it is.
  std::ostream& writeData(std::ostream& stream) const override;

  /// Takes the numbers of an occupancy model, which must have been checked.
  void set_model(const OccupancyModel& model);
  /// The finest voxel of a key, made (log-odds 0) or cut out of a pruned leaf where there is none.
  [[nodiscard]] SemanticOcTreeNode& finest(const octomap::OcTreeKey& key);
  class Descent;
  /// One update of every voxel of the blocks, which lie within the span: as octomap's updateNode of
  /// each, pruned and inner occupancy brought up to date above them, in one pass.
  void observe(const SpaceBlocks& blocks);
  /// Adds what another tree of the same edge holds: log-odds, clamped, sums of colours, and beliefs
  /// by merged(rule).
  void merge(const SemanticOcTree& other, const FusionRule& rule);

 protected:
  class SpaceUpdate;
  class Merge;
  /// The root, made where there is none, and whether it was.
  std::pair<SemanticOcTreeNode*, bool> root_or_new();
  /// The same of a child.
  std::pair<SemanticOcTreeNode*, bool> child_or_new(SemanticOcTreeNode* node, unsigned index) {
    if (nodeChildExists(node, index)) return {getNodeChild(node, index), false};
    return {createNodeChild(node, index), true};
  }
  /// Makes children of a pruned leaf.
  void expand_leaf(SemanticOcTreeNode* node);

  /// Reads the node of `level`, 0 for the finest, and all below it, as long as the tree has at most
  /// `most_nodes`. Returns how many finest voxels its leaves cover.
  std::size_t read_node(std::istream& stream, SemanticOcTreeNode* node, unsigned level,
                        std::size_t most_nodes);

  /// Appends the log-odds that the node and all below it have, in the order of a file: inner nodes
  /// the greatest of their children. Returns the node's.
  float gather_log_odds(const SemanticOcTreeNode* node, std::vector<float>& log_odds) const;
  /// Writes the node and all below it with these log-odds, from `next` on.
  void write_node(const SemanticOcTreeNode* node, const float*& next, std::ostream& stream) const;

  /// Makes the type known to octomap::AbstractOcTree::read.
  static const bool kKnown;
};

/// Goes to one voxel after the other and keeps the way to the last, so that a near one takes few
/// steps. Between two steps nothing else may change the tree.
class SemanticOcTree::Descent {
 public:
  explicit Descent(SemanticOcTree& tree) : tree_(tree) {}

  /// As SemanticOcTree::finest.
  [[nodiscard]] SemanticOcTreeNode& finest(const octomap::OcTreeKey& key);
  /// As octomap's updateNode(key, true, lazy), with one descent, and never into a pruned leaf.
  [[nodiscard]] SemanticOcTreeNode& hit(const octomap::OcTreeKey& key);

 private:
  static constexpr unsigned kLevels = 16;

  SemanticOcTree& tree_;
  octomap::OcTreeKey last_;
  std::array<SemanticOcTreeNode*, kLevels + 1>
      way_{};  ///< by level, 0 for the finest voxel `last_`
};

/// An octree spans this many voxels on either side of the origin.
inline constexpr std::int32_t kOctreeReach = 1 << 15;

/// Whether the voxel lies within the octree's span.
[[nodiscard]] inline bool fits_octree(const VoxelKey& key) {
  const auto fits = [](std::int32_t index) {
    return index >= -kOctreeReach && index < kOctreeReach;
  };
  return fits(key.i) && fits(key.j) && fits(key.k);
}

/// OctoMap's key of a voxel: its index plus 2^15.
[[nodiscard]] inline octomap::OcTreeKey octree_key(const VoxelKey& key) {
  return {static_cast<octomap::key_type>(key.i + kOctreeReach),
          static_cast<octomap::key_type>(key.j + kOctreeReach),
          static_cast<octomap::key_type>(key.k + kOctreeReach)};
}
[[nodiscard]] inline VoxelKey voxel_key(const octomap::OcTreeKey& key) {
  return {key[0] - kOctreeReach, key[1] - kOctreeReach, key[2] - kOctreeReach};
}

/// Calls `use(leaf)` with an iterator at every leaf with voxels in a box (metres; what lies beyond
/// the span counts as the last voxel there).
void for_each_leaf_in(const SemanticOcTree& tree, const Eigen::AlignedBox3d& box, const auto& use) {
  const auto key_within = [&](const Eigen::Vector3d& p) {
    const Eigen::Array3d index = (p / tree.getResolution()).array().floor();
    const Eigen::Array3i fitting =
        index.max(-kOctreeReach).min(kOctreeReach - 1).cast<std::int32_t>();
    return octree_key({fitting.x(), fitting.y(), fitting.z()});
  };
  const auto end = tree.end_leafs_bbx();
  for (auto leaf = tree.begin_leafs_bbx(key_within(box.min()), key_within(box.max())); leaf != end;
       ++leaf)
    use(leaf);
}

/// Calls `use(key)` for every finest voxel that the leaf stands for at which an iterator is.
void for_each_finest(const SemanticOcTree& tree, const auto& leaf, const auto& use) {
  const int span = 1 << (tree.getTreeDepth() - leaf.getDepth());
  const VoxelKey low = voxel_key(leaf.getIndexKey());
  for (int i = 0; i < span; ++i)
    for (int j = 0; j < span; ++j)
      for (int k = 0; k < span; ++k) use(VoxelKey{low.i + i, low.j + j, low.k + k});
}

}  // namespace mapscore
