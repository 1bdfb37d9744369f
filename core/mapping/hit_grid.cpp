// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/hit_grid.hpp"

#include <algorithm>
#include <bit>

namespace mapscore {
namespace {

std::size_t blocks_between(std::int32_t low, std::int32_t high) {
  return static_cast<std::size_t>((std::int64_t{high} - low) / 8 + 1);
}

}  // namespace

bool HitGrid::holds(const VoxelBox& box) {
  constexpr std::int32_t kReach = 1 << 20;  // of packed keys
  const auto fits = [](std::int32_t low, std::int32_t high) {
    return low >= -kReach && high < kReach && high >= low;
  };
  if (!fits(box.low.i, box.high.i) || !fits(box.low.j, box.high.j) || !fits(box.low.k, box.high.k))
    return false;
  return blocks_between(box.low.i, box.high.i) * blocks_between(box.low.j, box.high.j) <=
         kMostBlocks / blocks_between(box.low.k, box.high.k);
}

HitGrid::HitGrid(const VoxelBox& box, std::span<const ScoredClass> groups)
    : low_(box.low),
      blocks_y_(blocks_between(box.low.j, box.high.j)),
      blocks_z_(blocks_between(box.low.k, box.high.k)),
      groups_(groups),
      blocks_(blocks_between(box.low.i, box.high.i) * blocks_y_ * blocks_z_, kNone) {
  for (std::size_t group = 0; group < groups.size(); ++group) {
    if (class_of_rank_.empty() || class_of_rank_.back() != groups[group].class_id) {
      class_of_rank_.push_back(groups[group].class_id);
      groups_of_rank_.push_back(0);
    }
    groups_of_rank_.back() |= std::uint64_t{1} << group;
    rank_of_group_.push_back(static_cast<std::uint16_t>(class_of_rank_.size() - 1));
  }
}

std::uint32_t HitGrid::make_slot(const VoxelKey& key) {
  std::uint32_t& block = blocks_[block_of(key)];
  if (block == kNone) {
    block = static_cast<std::uint32_t>(in_blocks_.size() / 512);
    in_blocks_.resize(in_blocks_.size() + 512, kNone);
  }
  const auto slot = static_cast<std::uint32_t>(slots_.size());
  in_blocks_[512 * std::size_t{block} + within_block(key)] = slot;
  slots_.push_back({});
  slots_.back().voxel = pack(key);
  return slot;
}

void HitGrid::touch(std::uint32_t slot) {
  slots_[slot].draw = draw_;
  slots_[slot].present = 0;
  slots_[slot].counts = kNone;
  touched_.push_back(slot);
}

bool HitGrid::contested(const VoxelKey& key) const {
  const std::uint32_t slot = find(key);
  if (slot == kNone || slots_[slot].draw != draw_) return false;
  const std::uint64_t present = slots_[slot].present;
  const auto first = static_cast<std::size_t>(std::countr_zero(present));
  return (present & ~groups_of_rank_[rank_of_group_[first]]) != 0;
}

void HitGrid::count(const VoxelKey& key, std::uint16_t group, int positions) {
  Slot& slot = slot_in_draw(key);
  if (slot.counts == kNone) {
    slot.counts = static_cast<std::uint32_t>(counts_.size());
    counts_.resize(counts_.size() + class_of_rank_.size(), 0);
  }
  counts_[slot.counts + rank_of_group_[group]] += positions;
}

/// Rank of the class with most positions, ties to the lower id; the only one present needs no
/// counts.
ClassId HitGrid::winner_of(const Slot& slot) const {
  const std::uint16_t first =
      rank_of_group_[static_cast<std::size_t>(std::countr_zero(slot.present))];
  if ((slot.present & ~groups_of_rank_[first]) == 0) return first;
  const auto row = counts_.begin() + slot.counts;
  const auto end = row + static_cast<std::ptrdiff_t>(class_of_rank_.size());
  return static_cast<ClassId>(std::max_element(row, end) - row);
}

void HitGrid::win(Slot& slot, ClassId class_id, double score) {
  std::uint32_t* link = &slot.wins;
  while (*link != kNone && wins_[*link].class_id != class_id) link = &wins_[*link].next;
  if (*link == kNone) {
    *link = static_cast<std::uint32_t>(wins_.size());
    wins_.push_back({class_id, 1, score, kNone});
    return;
  }
  ++wins_[*link].draws;
  wins_[*link].score_sum += score;
}

void HitGrid::end_draw() {
  for (const std::uint32_t touched : touched_) {
    Slot& slot = slots_[touched];
    const ClassId rank = winner_of(slot);
    const std::uint64_t present = slot.present & groups_of_rank_[rank];
    // A class's groups ascend by score, so the last is the best.
    const auto best = static_cast<std::size_t>(63 - std::countl_zero(present));
    win(slot, class_of_rank_[rank], groups_[best].score);
  }
  touched_.clear();
  counts_.clear();
  ++draw_;
}

std::vector<VoxelHit> HitGrid::hits() const {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(slots_.size());
  for (const Slot& slot : slots_)
    if (slot.wins != kNone) order.emplace_back(slot.voxel, slot.wins);
  std::sort(order.begin(), order.end());
  std::vector<VoxelHit> hits;
  hits.reserve(wins_.size());
  for (const auto& [voxel, wins] : order) {
    const auto first = static_cast<std::ptrdiff_t>(hits.size());
    for (std::uint32_t n = wins; n != kNone; n = wins_[n].next)
      hits.push_back({unpack(voxel), wins_[n].class_id, wins_[n].draws, wins_[n].score_sum});
    std::sort(hits.begin() + first, hits.end(),
              [](const VoxelHit& a, const VoxelHit& b) { return a.class_id < b.class_id; });
  }
  return hits;
}

}  // namespace mapscore
