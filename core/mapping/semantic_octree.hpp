// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/voxel.hpp"
#include "core/mapping/class_beliefs.hpp"

#include <octomap/OcTreeNode.h>
#include <octomap/OccupancyOcTreeBase.h>

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <string>

namespace mapscore {

/// Most finest voxels that the leaves of a map file may cover; damaged leaves can ask for 2^48.
inline constexpr std::size_t kMostMapVoxels = 50'000'000;

/// Voxel of a semantic map: occupancy log-odds (OctoMap's) and what is believed of its class.
class SemanticOcTreeNode : public octomap::OcTreeNode {
 public:
  ClassBeliefs beliefs;

  bool operator==(const SemanticOcTreeNode& other) const {
    return value == other.value && beliefs == other.beliefs;
  }
  void copyData(const SemanticOcTreeNode& from) {
    OcTreeNode::copyData(from);
    beliefs = from.beliefs;
  }
  /// Most probable class, ties to the lower id; background with probability 0 when there is none.
  [[nodiscard]] ClassProbability best() const { return beliefs.best(); }

  /// OctoMap's streaming of one node's own data; native byte order, as OctoMap writes its floats.
  std::istream& readData(std::istream& stream);
  std::ostream& writeData(std::ostream& stream) const;
};

/// OctoMap octree of semantic voxels; type id "SemanticOcTree" in .ot files. Not safe for
/// concurrent writes.
class SemanticOcTree : public octomap::OccupancyOcTreeBase<SemanticOcTreeNode> {
 public:
  explicit SemanticOcTree(double edge_m);
  SemanticOcTree* create() const override { return new SemanticOcTree(resolution); }
  std::string getTreeType() const override { return "SemanticOcTree"; }

  /// Reads a whole .ot stream of this type, as octomap::AbstractOcTree::read does, but says nothing
  /// on standard error, takes nothing half-read for whole and goes no deeper than an octree does.
  /// Throws Error with the reason, also where the leaves cover more than kMostMapVoxels.
  [[nodiscard]] static std::unique_ptr<SemanticOcTree> read_whole(std::istream& stream);

 protected:
  /// Reads the node of `level`, 0 for the finest, and all below it, as long as the tree has at most
  /// `most_nodes`. Returns how many finest voxels its leaves cover.
  std::size_t read_node(std::istream& stream, SemanticOcTreeNode* node, unsigned level,
                        std::size_t most_nodes);

  /// Makes the type known to octomap::AbstractOcTree::read.
  class StaticMemberInitializer {
   public:
    StaticMemberInitializer();
    void ensureLinking() {}
  };
  static StaticMemberInitializer initializer_;
};

/// OctoMap's key of a voxel: its index plus 2^15.
[[nodiscard]] octomap::OcTreeKey octree_key(const VoxelKey& key);
[[nodiscard]] VoxelKey voxel_key(const octomap::OcTreeKey& key);
/// Whether the voxel lies within the +-2^15 voxels that an octree spans on each axis.
[[nodiscard]] bool fits_octree(const VoxelKey& key);

}  // namespace mapscore
