// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/known_space.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore {
namespace {

constexpr double kLeastCube_m = 0.04;
constexpr int kLeastBeside = 2;  ///< occupied neighbours of what is no speck

}  // namespace

KnownSpace::KnownSpace(const SemanticMap& map, const Eigen::AlignedBox3d& box_m,
                       double unsure_below)
    : edge_m_(map.edge_m()), unsure_below_(unsure_below) {
  if (!map.carves())
    throw Error(
        "map: does not carve, so it has no free space to explore from; set occupancy.carve");
  if (box_m.isEmpty() || !box_m.min().allFinite() || !box_m.max().allFinite())
    throw Error("box: must be finite, its low corner nowhere above its high corner");
  for (; edge_m_ < kLeastCube_m; edge_m_ *= 2) ++level_;
  low_ = voxel_of(box_m.min(), edge_m_);
  const VoxelKey high = voxel_of(box_m.max(), edge_m_);
  size_ = {high.i - low_.i + 1, high.j - low_.j + 1, high.k - low_.k + 1};
  strides_[2] = 1;
  strides_[1] = size_.k + 2;
  strides_[0] = strides_[1] * (size_.j + 2);
  cubes_.assign(static_cast<std::size_t>(strides_[0] * (size_.i + 2)), Space::beyond);
  for (std::int32_t i = 0; i < size_.i; ++i)
    for (std::int32_t j = 0; j < size_.j; ++j) {
      const auto first = cubes_.begin() + place_of({low_.i + i, low_.j + j, low_.k});
      std::fill(first, first + size_.k, Space::unknown);
    }
  const SemanticOcTree& tree = map.tree();
  if (tree.getRoot() == nullptr) return;
  const std::int32_t low = -(1 << (tree.getTreeDepth() - 1 - level_));
  read(tree, tree.getRoot(), tree.getTreeDepth(), {low, low, low});
  free_specks();
}

void KnownSpace::free_specks() {
  const auto is_occupied = [&](std::ptrdiff_t place) {
    return at(place) == Space::occupied || at(place) == Space::unsure;
  };
  std::vector<std::ptrdiff_t> specks;
  for (std::int32_t i = low_.i; i < low_.i + size_.i; ++i)
    for (std::int32_t j = low_.j; j < low_.j + size_.j; ++j)
      for (std::int32_t k = low_.k; k < low_.k + size_.k; ++k) {
        const std::ptrdiff_t place = place_of({i, j, k});
        if (!is_occupied(place)) continue;
        int beside = -1;  // itself
        for (std::ptrdiff_t x = -1; x <= 1 && beside < kLeastBeside; ++x)
          for (std::ptrdiff_t y = -1; y <= 1; ++y)
            for (std::ptrdiff_t z = -1; z <= 1; ++z)
              beside += is_occupied(place + x * strides_[0] + y * strides_[1] + z) ? 1 : 0;
        if (beside < kLeastBeside) specks.push_back(place);
      }
  for (const std::ptrdiff_t place : specks) cubes_[static_cast<std::size_t>(place)] = Space::free;
}

bool KnownSpace::contains(const VoxelKey& key) const {
  const auto within = [](std::int32_t index, std::int32_t low, std::int32_t size) {
    return index >= low - 1 && index <= low + size;
  };
  return within(key.i, low_.i, size_.i) && within(key.j, low_.j, size_.j) &&
         within(key.k, low_.k, size_.k);
}

/// `low`: lowest cube of the node, or the cube that the node is part of.
void KnownSpace::read(const SemanticOcTree& tree, const SemanticOcTreeNode* node, unsigned level,
                      const VoxelKey& low) {
  const std::int32_t span = level > level_ ? 1 << (level - level_) : 1;
  const auto apart = [span](std::int32_t from, std::int32_t box, std::int32_t size) {
    return from >= box + size || from + span <= box;
  };
  if (apart(low.i, low_.i, size_.i) || apart(low.j, low_.j, size_.j) ||
      apart(low.k, low_.k, size_.k))
    return;
  if (!tree.nodeHasChildren(node)) return fill(*node, tree.isNodeOccupied(node), low, span);
  const std::int32_t half = level > level_ ? span / 2 : 0;
  for (int index = 0; index < 8; ++index)
    if (tree.nodeChildExists(node, static_cast<unsigned>(index)))
      read(tree, tree.getNodeChild(node, static_cast<unsigned>(index)), level - 1,
           {low.i + half * (index & 1), low.j + half * (index >> 1 & 1),
            low.k + half * (index >> 2)});
}

void KnownSpace::fill(const SemanticOcTreeNode& leaf, bool occupied, const VoxelKey& low,
                      std::int32_t span) {
  Space space = occupied ? Space::occupied : Space::free;
  if (occupied && !leaf.beliefs().empty() && leaf.best().probability < unsure_below_)
    space = Space::unsure;
  const auto from = [](std::int32_t index, std::int32_t box) { return std::max(index, box); };
  const auto to = [span](std::int32_t index, std::int32_t box, std::int32_t size) {
    return std::min(index + span, box + size);
  };
  for (std::int32_t i = from(low.i, low_.i); i < to(low.i, low_.i, size_.i); ++i)
    for (std::int32_t j = from(low.j, low_.j); j < to(low.j, low_.j, size_.j); ++j)
      for (std::int32_t k = from(low.k, low_.k); k < to(low.k, low_.k, size_.k); ++k) {
        Space& cube = cubes_[static_cast<std::size_t>(place_of({i, j, k}))];
        cube = std::max(cube, space);
      }
}

}  // namespace mapscore
