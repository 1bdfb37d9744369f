// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// How frames change the occupancy of a semantic octree.

#include "core/mapping/semantic_octree.hpp"

#include <span>

namespace mapscore {
namespace {

constexpr unsigned kBlockLevel = 3;
constexpr std::int32_t kOctreeBlocks = 1 << (15 - kBlockLevel);  ///< on either side of the origin

/// Which child of a node of `level`, above the blocks', holds the block.
unsigned child_of(const VoxelKey& block, unsigned level) {
  const auto bit = [&](std::int32_t index) {
    return static_cast<unsigned>(index + kOctreeBlocks) >> (level - 1 - kBlockLevel) & 1;
  };
  return bit(block.i) | bit(block.j) << 1 | bit(block.k) << 2;
}

}  // namespace

void SemanticOcTree::set_model(const OccupancyModel& model) {
  setProbHit(model.hit);
  setProbMiss(model.miss);
  setClampingThresMin(model.clamp_min);
  setClampingThresMax(model.clamp_max);
}

std::pair<SemanticOcTreeNode*, bool> SemanticOcTree::root_or_new() {
  if (root != nullptr) return {root, false};
  root = new SemanticOcTreeNode;
  ++tree_size;
  size_changed = true;
  return {root, true};
}

void SemanticOcTree::expand_leaf(SemanticOcTreeNode* node) {
  expandNode(node);
  node->clear_surface();
}

SemanticOcTreeNode& SemanticOcTree::finest(const octomap::OcTreeKey& key) {
  auto [node, created] = root_or_new();
  for (unsigned level = getTreeDepth(); level > 0; --level) {
    const unsigned index = octomap::computeChildIdx(key, static_cast<int>(level) - 1);
    if (nodeChildExists(node, index)) {
      node = getNodeChild(node, index);
    } else if (!created && !nodeHasChildren(node)) {
      expand_leaf(node);
      node = getNodeChild(node, index);
    } else {
      node = createNodeChild(node, index);
      created = true;
    }
  }
  return *node;
}

SemanticOcTreeNode& SemanticOcTree::hit(const octomap::OcTreeKey& key) {
  SemanticOcTreeNode& node = finest(key);
  if (node.getLogOdds() < getClampingThresMaxLog()) integrateHit(&node);
  return node;
}

/// Carries the bits of blocks down the tree and the occupancy up again.
class SemanticOcTree::SpaceUpdate {
 public:
  explicit SpaceUpdate(SemanticOcTree& tree)
      : tree_(tree), least_(tree.getClampingThresMinLog()), most_(tree.getClampingThresMaxLog()) {}

  void descend(SemanticOcTreeNode* node, bool created, unsigned level,
               std::span<const SpaceBlock> blocks) {
    if (level == kBlockLevel) return update_block(node, created, blocks.front());
    if (is_leaf(node, created)) {
      bool changes = false;
      for (const SpaceBlock& block : blocks) changes = changes || changes_leaf(*node, block);
      if (!changes) return;
      tree_.expand_leaf(node);
    }
    for (std::size_t begin = 0, end = 0; begin < blocks.size(); begin = end) {
      const unsigned index = child_of(blocks[begin].key, level);
      while (end < blocks.size() && child_of(blocks[end].key, level) == index) ++end;
      const auto [child, fresh] = child_or_new(node, index);
      descend(child, fresh, level - 1, blocks.subspan(begin, end - begin));
    }
    finish(node);
  }

 private:
  [[nodiscard]] bool is_leaf(const SemanticOcTreeNode* node, bool created) const {
    return !created && !tree_.nodeHasChildren(node);
  }
  /// Whether a miss or a hit moves the node's log-odds; beyond the limits nothing does.
  [[nodiscard]] bool changes(const SemanticOcTreeNode& leaf, bool free, bool hit) const {
    return (free && leaf.getLogOdds() > least_) || (hit && leaf.getLogOdds() < most_);
  }
  [[nodiscard]] bool changes_leaf(const SemanticOcTreeNode& leaf, const SpaceBlock& block) const {
    std::uint64_t free = 0, hit = 0;
    for (std::size_t octant = 0; octant < 8; ++octant)
      free |= block.free[octant], hit |= block.hit[octant];
    return changes(leaf, free != 0, hit != 0);
  }

  std::pair<SemanticOcTreeNode*, bool> child_or_new(SemanticOcTreeNode* node, unsigned index) {
    if (tree_.nodeChildExists(node, index)) return {tree_.getNodeChild(node, index), false};
    return {tree_.createNodeChild(node, index), true};
  }

  void finish(SemanticOcTreeNode* node) {
    if (!tree_.pruneNode(node)) node->updateOccupancyChildren();
  }

  void update_block(SemanticOcTreeNode* node, bool created, const SpaceBlock& block) {
    if (is_leaf(node, created)) {
      if (!changes_leaf(*node, block)) return;
      tree_.expand_leaf(node);
    }
    for (unsigned octant = 0; octant < 8; ++octant) {
      if ((block.free[octant] | block.hit[octant]) == 0) continue;
      const auto [child, fresh] = child_or_new(node, octant);
      update_octant(child, fresh, block.free[octant], block.hit[octant]);
    }
    finish(node);
  }

  void update_octant(SemanticOcTreeNode* node, bool created, std::uint64_t free,
                     std::uint64_t hit) {
    if (is_leaf(node, created)) {
      if (!changes(*node, free != 0, hit != 0)) return;
      tree_.expand_leaf(node);
    }
    for (unsigned index = 0; index < 8; ++index) {
      const auto misses = static_cast<std::uint8_t>(free >> (8 * index));
      const auto hits = static_cast<std::uint8_t>(hit >> (8 * index));
      if ((misses | hits) == 0) continue;
      const auto [child, fresh] = child_or_new(node, index);
      update_voxels(child, fresh, misses, hits);
    }
    finish(node);
  }

  /// The eight finest voxels below a node.
  void update_voxels(SemanticOcTreeNode* node, bool created, unsigned misses, unsigned hits) {
    if (is_leaf(node, created)) {
      if (!changes(*node, misses != 0, hits != 0)) return;
      tree_.expand_leaf(node);
    }
    for (unsigned index = 0; index < 8; ++index) {
      const bool hit = hits >> index & 1, free = misses >> index & 1;
      if (!hit && !free) continue;
      SemanticOcTreeNode* voxel = child_or_new(node, index).first;
      if (!changes(*voxel, free, hit)) continue;
      if (hit)
        tree_.integrateHit(voxel);
      else
        tree_.integrateMiss(voxel);
    }
    finish(node);
  }

  SemanticOcTree& tree_;
  float least_, most_;
};

void SemanticOcTree::observe(const SpaceBlocks& blocks) {
  if (blocks.empty()) return;
  const auto [node, created] = root_or_new();
  SpaceUpdate(*this).descend(node, created, getTreeDepth(), blocks);
}

}  // namespace mapscore
