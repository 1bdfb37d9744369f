// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/map_resolution.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"

#include <octomap/ColorOcTree.h>

#include <algorithm>
#include <array>
#include <utility>

namespace mapscore {
namespace {

/// What a node says, whether it was read or put together.
struct Content {
  float log_odds = 0.0f;
  ClassBeliefs beliefs;
  ColourSum colour;
};

/// Reads a tree from the finest voxels up to one level.
class LevelReader {
 public:
  LevelReader(const SemanticOcTree& tree, const FusionRule& rule, unsigned level, bool free_too)
      : tree_(tree),
        rule_(rule),
        level_(level),
        free_too_(free_too),
        occupied_from_(tree.getOccupancyThresLog()) {}

  std::vector<CoarseVoxel> read() {
    if (tree_.getRoot() != nullptr) descend(tree_.getRoot(), tree_.getTreeDepth(), {});
    std::ranges::sort(voxels_, {}, &CoarseVoxel::key);
    return std::move(voxels_);
  }

 private:
  /// `low`: in voxels of the node's own size, from the tree's low corner.
  void descend(const SemanticOcTreeNode* node, unsigned level, const VoxelKey& low) {
    if (level == level_) return add(low, content(node, level));
    if (!tree_.nodeHasChildren(node)) return spread(low, level, content(node, level_));
    for (unsigned index = 0; index < 8; ++index)
      if (tree_.nodeChildExists(node, index)) {
        const auto bit = static_cast<int>(index);
        descend(tree_.getNodeChild(node, index), level - 1,
                {2 * low.i + (bit & 1), 2 * low.j + (bit >> 1 & 1), 2 * low.k + (bit >> 2)});
      }
  }

  /// A pruned leaf above the level that is read.
  void spread(const VoxelKey& low, unsigned level, const Content& content) {
    const std::int32_t span = 1 << (level - level_);
    for (std::int32_t i = 0; i < span; ++i)
      for (std::int32_t j = 0; j < span; ++j)
        for (std::int32_t k = 0; k < span; ++k)
          add({low.i * span + i, low.j * span + j, low.k * span + k}, content);
  }

  void add(const VoxelKey& low, const Content& content) {
    if (!free_too_ && content.log_odds < occupied_from_) return;
    const std::int32_t offset = 1 << (tree_.getTreeDepth() - 1 - level_);
    CoarseVoxel voxel{{low.i - offset, low.j - offset, low.k - offset},
                      content.log_odds >= occupied_from_,
                      content.log_odds,
                      content.beliefs,
                      {}};
    if (content.colour.count > 0) voxel.colour = content.colour.mean();
    voxels_.push_back(std::move(voxel));
  }

  /// Of a node whose cube is that of `level`; a leaf stands for equal voxels down to the finest.
  [[nodiscard]] Content content(const SemanticOcTreeNode* node, unsigned level) const {
    if (!tree_.nodeHasChildren(node)) {
      Content content{node->getLogOdds(), node->beliefs(), node->colour()};
      for (unsigned above = 0; above < level; ++above) {
        std::array<Content, 8> equal;
        equal.fill(content);
        content = together(equal);
      }
      return content;
    }
    std::array<Content, 8> children;
    std::size_t count = 0;
    for (unsigned index = 0; index < 8; ++index)
      if (tree_.nodeChildExists(node, index))
        children[count++] = this->content(tree_.getNodeChild(node, index), level - 1);
    return together({children.data(), count});
  }

  [[nodiscard]] Content together(std::span<const Content> children) const {
    Content whole{children.front().log_odds, {}, {}};
    std::array<const ClassBeliefs*, 8> beliefs{};
    for (std::size_t n = 0; n < children.size(); ++n) {
      whole.log_odds = std::max(whole.log_odds, children[n].log_odds);
      if (children[n].log_odds >= occupied_from_) beliefs[n] = &children[n].beliefs;
      if (children[n].colour.count > 0) whole.colour.add(children[n].colour.mean());
    }
    whole.beliefs = combined(rule_, {beliefs.data(), children.size()});
    return whole;
  }

  const SemanticOcTree& tree_;
  const FusionRule& rule_;
  unsigned level_;
  bool free_too_;
  float occupied_from_;
  std::vector<CoarseVoxel> voxels_;
};

std::vector<CoarseVoxel> read(const SemanticMap& map, const FusionRule& rule, int times,
                              bool free_too) {
  check(rule);
  unsigned level = 0;
  while (level < 10 && 1 << level < times) ++level;
  if (1 << level != times)
    throw Error("times: the map is read at 1, 2, 4, 8, ... or 1024 times its voxel size");
  return LevelReader(map.tree(), rule, level, free_too).read();
}

}  // namespace

std::vector<CoarseVoxel> read_at(const SemanticMap& map, const FusionRule& rule, int times) {
  return read(map, rule, times, true);
}

void export_color_at(const SemanticMap& map, const FusionRule& rule, int times, Paint paint,
                     const ClassTable& table, double threshold, const std::filesystem::path& file) {
  octomap::ColorOcTree coloured(map.edge_m() * times);
  for (const CoarseVoxel& voxel : read(map, rule, times, false)) {
    std::optional<Colour> colour = voxel.colour;
    if (paint == Paint::classes) {
      const ClassProbability best = voxel.best();
      if (best.class_id == kBackground || best.probability < threshold) continue;
      if (best.class_id >= table.classes.size())
        throw Error("map: class " + std::to_string(best.class_id) +
                    " is not in the class table; export it with the table that it was made with");
      colour = table.classes[best.class_id].colour;
    }
    if (colour)
      coloured.updateNode(octree_key(voxel.key), true, true)
          ->setColor(colour->r, colour->g, colour->b);
  }
  if (coloured.size() > 0) coloured.updateInnerOccupancy();
  WholeFile whole(file);
  coloured.write(whole.stream());
  whole.finish();
}

}  // namespace mapscore
