// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/semantic_map.hpp"

#include <algorithm>

namespace mapscore {
namespace {

/// The octree's key at one corner of a box, within its span.
octomap::OcTreeKey key_within(const Eigen::Vector3d& corner, double edge_m) {
  constexpr double kReach = 1 << 15;
  const Eigen::Vector3d index =
      (corner / edge_m).array().floor().cwiseMax(-kReach).cwiseMin(kReach - 1.0);
  return octree_key(
      {static_cast<int>(index.x()), static_cast<int>(index.y()), static_cast<int>(index.z())});
}

bool is_hit(std::span<const VoxelHit> hits, const VoxelKey& key) {
  const auto hit = std::lower_bound(hits.begin(), hits.end(), key,
                                    [](const VoxelHit& h, const VoxelKey& k) { return h.key < k; });
  return hit != hits.end() && hit->key == key;
}

}  // namespace

void SemanticMap::decay_in_view(const DepthView& view, const BlendRule& rule,
                                std::span<const VoxelHit> hits) {
  check(rule);
  const Eigen::AlignedBox3d box = view.box(edge_m_);
  if (box.isEmpty()) return;
  const octomap::OcTreeKey low = key_within(box.min(), edge_m_);
  const octomap::OcTreeKey high = key_within(box.max(), edge_m_);
  std::vector<VoxelKey> in_view;
  const auto end = tree_->end_leafs_bbx();
  for (auto leaf = tree_->begin_leafs_bbx(low, high); leaf != end; ++leaf) {
    if (leaf->beliefs().empty()) continue;
    const int span = 1 << (tree_->getTreeDepth() - leaf.getDepth());
    const VoxelKey corner = voxel_key(leaf.getIndexKey());
    for (int n = 0; n < span * span * span; ++n) {
      const VoxelKey key{corner.i + n % span, corner.j + n / span % span,
                         corner.k + n / (span * span)};
      if (view.sees(key, edge_m_) && !is_hit(hits, key)) in_view.push_back(key);
    }
  }
  for (const VoxelKey& key : in_view) decay(rule, tree_->finest(octree_key(key)).mutable_beliefs());
}

}  // namespace mapscore
