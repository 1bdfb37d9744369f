// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// How frames change the occupancy of a semantic octree, and how it takes in another.

#include "core/mapping/semantic_octree.hpp"

#include <algorithm>
#include <bit>
#include <span>
#include <tuple>

namespace mapscore {
namespace {

constexpr unsigned kBlockLevel = 3;
constexpr std::int32_t kOctreeBlocks =
    kOctreeReach >> kBlockLevel;  ///< on either side of the origin

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
  return Descent(*this).finest(key);
}

SemanticOcTreeNode& SemanticOcTree::Descent::finest(const octomap::OcTreeKey& key) {
  unsigned level = kLevels;
  bool created = false;
  if (way_[kLevels] == nullptr) {
    std::tie(way_[kLevels], created) = tree_.root_or_new();
  } else {
    const auto differ =
        static_cast<unsigned>((key[0] ^ last_[0]) | (key[1] ^ last_[1]) | (key[2] ^ last_[2]));
    level = static_cast<unsigned>(std::bit_width(differ));
  }
  SemanticOcTreeNode* node = way_[level];
  for (; level > 0; --level) {
    const unsigned index = octomap::computeChildIdx(key, static_cast<int>(level) - 1);
    if (tree_.nodeChildExists(node, index)) {
      node = tree_.getNodeChild(node, index);
    } else if (!created && !tree_.nodeHasChildren(node)) {
      tree_.expand_leaf(node);
      node = tree_.getNodeChild(node, index);
    } else {
      node = tree_.createNodeChild(node, index);
      created = true;
    }
    way_[level - 1] = node;
  }
  last_ = key;
  return *node;
}

SemanticOcTreeNode& SemanticOcTree::Descent::hit(const octomap::OcTreeKey& key) {
  SemanticOcTreeNode& node = finest(key);
  if (node.getLogOdds() < tree_.getClampingThresMaxLog()) tree_.integrateHit(&node);
  return node;
}

/// Carries the bits of blocks down the tree and the occupancy up again.
class SemanticOcTree::SpaceUpdate {
 public:
  explicit SpaceUpdate(SemanticOcTree& tree)
      : tree_(tree), least_(tree.getClampingThresMinLog()), most_(tree.getClampingThresMaxLog()) {}

  void descend(SemanticOcTreeNode* node, bool created, unsigned level,
               std::span<const SpaceBlock> blocks) {
    if (level == kBlockLevel) return update(node, created, blocks.front().free, blocks.front().hit);
    if (is_leaf(node, created)) {
      const auto changes_it = [&](const SpaceBlock& block) {
        return changes(*node, any(block.free), any(block.hit));
      };
      if (std::ranges::none_of(blocks, changes_it)) return;
      tree_.expand_leaf(node);
    }
    for (std::size_t begin = 0, end = 0; begin < blocks.size(); begin = end) {
      const unsigned index = child_of(blocks[begin].key, level);
      while (end < blocks.size() && child_of(blocks[end].key, level) == index) ++end;
      const auto [child, fresh] = tree_.child_or_new(node, index);
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
  void finish(SemanticOcTreeNode* node) {
    if (!tree_.pruneNode(node)) node->updateOccupancyChildren();
  }

  /// The bits of a node below one that has these: of a block an octant's word, of that a byte, of
  /// that a voxel's bit.
  static std::uint64_t below(const SpaceBlock::Bits& block, unsigned child) { return block[child]; }
  static std::uint8_t below(std::uint64_t octant, unsigned child) {
    return static_cast<std::uint8_t>(octant >> (8 * child));
  }
  static bool below(std::uint8_t voxels, unsigned child) { return voxels >> child & 1; }
  static bool any(const SpaceBlock::Bits& block) {
    return std::ranges::any_of(block, [](std::uint64_t octant) { return octant != 0; });
  }
  static bool any(std::uint64_t bits) { return bits != 0; }

  /// `node` is a block's, or below; `free` and `hit` are its bits.
  template <class Bits>
  void update(SemanticOcTreeNode* node, bool created, const Bits& free, const Bits& hit) {
    if (is_leaf(node, created)) {
      if (!changes(*node, any(free), any(hit))) return;
      tree_.expand_leaf(node);
    }
    for (unsigned index = 0; index < 8; ++index) {
      const auto free_below = below(free, index), hit_below = below(hit, index);
      if (!free_below && !hit_below) continue;
      const auto [child, fresh] = tree_.child_or_new(node, index);
      update(child, fresh, free_below, hit_below);
    }
    finish(node);
  }

  void update(SemanticOcTreeNode* voxel, bool, bool free, bool hit) {
    if (!changes(*voxel, free, hit)) return;
    if (hit)
      tree_.integrateHit(voxel);
    else
      tree_.integrateMiss(voxel);
  }

  SemanticOcTree& tree_;
  float least_, most_;
};

void SemanticOcTree::observe(const SpaceBlocks& blocks) {
  if (blocks.empty()) return;
  const auto [node, created] = root_or_new();
  SpaceUpdate(*this).descend(node, created, getTreeDepth(), blocks);
}

/// Walks two trees together; a leaf stands for all that lies below it.
class SemanticOcTree::Merge {
 public:
  Merge(SemanticOcTree& mine, const SemanticOcTree& theirs, const FusionRule& rule)
      : mine_(mine), theirs_(theirs), rule_(rule) {}

  /// `created`: mine was just made and says nothing.
  void nodes(SemanticOcTreeNode* mine, bool created, const SemanticOcTreeNode* theirs) {
    const bool mine_is_leaf = !created && !mine_.nodeHasChildren(mine);
    const bool theirs_is_leaf = !theirs_.nodeHasChildren(theirs);
    if (theirs_is_leaf && created) return mine->copyData(*theirs);
    if (theirs_is_leaf && mine_is_leaf) return add(*theirs, *mine);
    if (mine_is_leaf) mine_.expand_leaf(mine);
    for (unsigned index = 0; index < 8; ++index) {
      if (!theirs_is_leaf && !theirs_.nodeChildExists(theirs, index)) continue;
      const auto [child, fresh] = mine_.child_or_new(mine, index);
      nodes(child, fresh, theirs_is_leaf ? theirs : theirs_.getNodeChild(theirs, index));
    }
    mine->updateOccupancyChildren();
  }

 private:
  void add(const SemanticOcTreeNode& from, SemanticOcTreeNode& to) const {
    to.setLogOdds(std::clamp(to.getLogOdds() + from.getLogOdds(), mine_.getClampingThresMinLog(),
                             mine_.getClampingThresMaxLog()));
    if (from.colour().count > 0) to.mutable_colour() += from.colour();
    if (from.beliefs().empty()) return;
    ClassBeliefs& beliefs = to.mutable_beliefs();
    beliefs = beliefs.empty() ? from.beliefs() : merged(rule_, beliefs, from.beliefs());
  }

  SemanticOcTree& mine_;
  const SemanticOcTree& theirs_;
  const FusionRule& rule_;
};

void SemanticOcTree::merge(const SemanticOcTree& other, const FusionRule& rule) {
  if (other.root == nullptr) return;
  const auto [node, created] = root_or_new();
  Merge(*this, other, rule).nodes(node, created, other.root);
}

}  // namespace mapscore
