// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/map_query.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore {
namespace {

/// First and last index on one axis whose voxel's centre lies within [low, high].
struct IndexRange {
  std::int32_t first, last;
};

IndexRange range_of(double low_m, double high_m, double edge_m) {
  constexpr double kSpan = 1 << 15;
  const auto index = [&](double value) {
    return static_cast<std::int32_t>(std::clamp(value, -kSpan - 2, kSpan + 2));
  };
  IndexRange range{index(std::floor(low_m / edge_m) - 1), index(std::floor(high_m / edge_m) + 1)};
  const auto centre = [&](std::int32_t i) { return (i + 0.5) * edge_m; };
  while (range.first <= range.last && centre(range.first) < low_m) ++range.first;
  while (range.first <= range.last && centre(range.last) > high_m) --range.last;
  return range;
}

class BoxReader {
 public:
  using Inside = std::function<bool(const Eigen::Vector3d&)>;

  BoxReader(const SemanticMap& map, const Eigen::AlignedBox3d& box_m, const Inside& inside,
            const VoxelWanted& wanted)
      : tree_(map.tree()), edge_m_(map.edge_m()), inside_(inside), wanted_(wanted) {
    for (int n = 0; n < 3; ++n) ranges_[n] = range_of(box_m.min()[n], box_m.max()[n], map.edge_m());
  }

  std::vector<MapVoxel> read() {
    if (tree_.getRoot() != nullptr) {
      const std::int32_t low = -(1 << (tree_.getTreeDepth() - 1));
      descend(tree_.getRoot(), tree_.getTreeDepth(), {low, low, low});
    }
    std::sort(voxels_.begin(), voxels_.end(),
              [](const MapVoxel& a, const MapVoxel& b) { return a.key < b.key; });
    return std::move(voxels_);
  }

 private:
  void descend(const SemanticOcTreeNode* node, unsigned level, const VoxelKey& low) {
    const std::int32_t span = 1 << level;
    if (low.i > ranges_[0].last || low.j > ranges_[1].last || low.k > ranges_[2].last) return;
    if (low.i + span <= ranges_[0].first || low.j + span <= ranges_[1].first ||
        low.k + span <= ranges_[2].first)
      return;
    if (!tree_.nodeHasChildren(node)) return add(*node, low, span);
    const std::int32_t half = span / 2;
    for (int index = 0; index < 8; ++index)
      if (tree_.nodeChildExists(node, static_cast<unsigned>(index)))
        descend(tree_.getNodeChild(node, static_cast<unsigned>(index)), level - 1,
                {low.i + half * (index & 1), low.j + half * (index >> 1 & 1),
                 low.k + half * (index >> 2)});
  }

  void add(const SemanticOcTreeNode& leaf, const VoxelKey& low, std::int32_t span) {
    const ClassProbability best = leaf.best();
    const bool occupied = tree_.isNodeOccupied(leaf);
    if (!occupied && (!wanted_.free_too || wanted_.class_id)) return;
    if (wanted_.class_id &&
        (best.class_id != *wanted_.class_id || best.probability < wanted_.threshold))
      return;
    const auto from = [](std::int32_t index, const IndexRange& range) {
      return std::max(index, range.first);
    };
    const auto to = [&](std::int32_t index, const IndexRange& range) {
      return std::min(index + span - 1, range.last);
    };
    for (std::int32_t i = from(low.i, ranges_[0]); i <= to(low.i, ranges_[0]); ++i)
      for (std::int32_t j = from(low.j, ranges_[1]); j <= to(low.j, ranges_[1]); ++j)
        for (std::int32_t k = from(low.k, ranges_[2]); k <= to(low.k, ranges_[2]); ++k) {
          if (inside_ && !inside_(centre_of({i, j, k}, edge_m_))) continue;
          if (voxels_.size() == kMostMapVoxels)
            throw Error("box: it holds too many voxels; ask for a smaller one");
          voxels_.push_back({{i, j, k}, best.class_id, best.probability, occupied});
        }
  }

  const SemanticOcTree& tree_;
  double edge_m_;
  const Inside& inside_;
  const VoxelWanted& wanted_;
  IndexRange ranges_[3]{};
  std::vector<MapVoxel> voxels_;
};

}  // namespace

std::vector<MapVoxel> voxels_in_region(const SemanticMap& map, const Eigen::AlignedBox3d& bounds_m,
                                       const std::function<bool(const Eigen::Vector3d&)>& inside,
                                       const VoxelWanted& wanted) {
  if (bounds_m.isEmpty() || !bounds_m.min().allFinite() || !bounds_m.max().allFinite())
    throw Error("box: must be finite, its low corner nowhere above its high corner");
  return BoxReader(map, bounds_m, inside, wanted).read();
}

std::vector<MapVoxel> voxels_in_box(const SemanticMap& map, const Eigen::AlignedBox3d& box_m,
                                    const VoxelWanted& wanted) {
  return voxels_in_region(map, box_m, {}, wanted);
}

}  // namespace mapscore
