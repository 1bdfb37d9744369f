// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/fusion/fusion_rule.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

namespace mapscore {

/// Throws Error when the rule is out of range, `draws` < 1, or hits are not ascending by voxel and
/// class, have no draws or more than `draws` in a voxel, a sum of scores outside [0, draws], or a
/// class beyond `class_count` or the rule's own classes.
void check_fusion(std::span<const VoxelHit> hits, int draws, const FusionRule& rule,
                  std::size_t class_count);

/// Calls act(hits of one voxel) in their order.
void for_each_voxel(std::span<const VoxelHit> hits, auto&& act) {
  for (auto hit = hits.begin(); hit != hits.end();) {
    const auto end =
        std::find_if(hit, hits.end(), [&](const VoxelHit& h) { return h.key != hit->key; });
    act(std::span<const VoxelHit>(hit, end));
    hit = end;
  }
}

}  // namespace mapscore
