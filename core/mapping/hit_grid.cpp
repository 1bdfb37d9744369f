// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/hit_grid.hpp"

#include <algorithm>

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
      blocks_(blocks_between(box.low.i, box.high.i) * blocks_y_ * blocks_z_, kNone) {}

std::uint32_t HitGrid::make_row(const VoxelKey& key, std::uint16_t group) {
  const std::uint32_t found = find(key);
  const std::uint32_t slot = found == kNone ? make_slot(key) : found;
  const auto row = static_cast<std::uint32_t>(rows_.size());
  if (slots_[slot].rows == kNone) touched_.push_back(slot);
  rows_.push_back({{}, group, slots_[slot].rows, kNone});
  slots_[slot].rows = row;
  return row;
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

void HitGrid::find_contested() {
  for (const std::uint32_t touched : touched_) {
    Slot& slot = slots_[touched];
    const Row& first = rows_[slot.rows];
    if (first.next == kNone) continue;
    for (std::uint32_t a = slot.rows; a != kNone; a = rows_[a].next)
      for (std::uint32_t b = rows_[a].next; b != kNone; b = rows_[b].next)
        if (class_of(rows_[a]) != class_of(rows_[b]))
          slot.contested |= rows_[a].draws & rows_[b].draws;
    if (!slot.contested.any()) continue;
    contested_blocks_.resize(blocks_.size());
    contested_blocks_[block_of(unpack(slot.voxel))] = true;
    for (std::uint32_t a = slot.rows; a != kNone; a = rows_[a].next) {
      if (rows_[a].counts != kNone) continue;
      for (std::uint32_t b = a; b != kNone; b = rows_[b].next)
        if (class_of(rows_[a]) == class_of(rows_[b]))
          rows_[b].counts = static_cast<std::uint32_t>(counts_.size());
      counts_.resize(counts_.size() + DrawSet::kMost, 0);
    }
  }
}

bool HitGrid::contested_within(const VoxelBox& box) const {
  if (contested_blocks_.empty()) return false;
  const std::size_t first = block_of(box.low), last = block_of(box.high);
  const std::size_t x0 = first / blocks_z_ / blocks_y_, x1 = last / blocks_z_ / blocks_y_;
  const std::size_t y0 = first / blocks_z_ % blocks_y_, y1 = last / blocks_z_ % blocks_y_;
  const std::size_t z0 = first % blocks_z_, z1 = last % blocks_z_;
  for (std::size_t x = x0; x <= x1; ++x)
    for (std::size_t y = y0; y <= y1; ++y)
      for (std::size_t z = z0; z <= z1; ++z)
        if (contested_blocks_[(x * blocks_y_ + y) * blocks_z_ + z]) return true;
  return false;
}

/// The class with most positions wins, ties to the lower id.
void HitGrid::decide(const Slot& slot) {
  for_each_draw(slot.contested, [&](std::size_t draw) {
    int most = 0;
    ClassId winner = kBackground;
    for (std::uint32_t row = slot.rows; row != kNone; row = rows_[row].next) {
      if (!rows_[row].draws.has(draw)) continue;
      const int positions = counts_[rows_[row].counts + draw];
      const ClassId class_id = class_of(rows_[row]);
      if (positions < most || (positions == most && class_id >= winner)) continue;
      most = positions;
      winner = class_id;
    }
    for (std::uint32_t row = slot.rows; row != kNone; row = rows_[row].next)
      if (class_of(rows_[row]) != winner) rows_[row].draws &= ~DrawSet::of(draw);
  });
}

/// Takes the draws of the class of a row, and ends the class's rows.
void HitGrid::win(Slot& slot, std::uint32_t first_row) {
  const ClassId class_id = class_of(rows_[first_row]);
  DrawSet draws;
  for (std::uint32_t row = first_row; row != kNone; row = rows_[row].next)
    if (class_of(rows_[row]) == class_id) draws |= rows_[row].draws;
  if (!draws.any()) return;
  std::uint32_t at = slot.wins;
  while (at != kNone && wins_[at].class_id != class_id) at = wins_[at].next;
  if (at == kNone) {
    at = static_cast<std::uint32_t>(wins_.size());
    wins_.push_back({class_id, 0, 0.0, slot.wins});
    slot.wins = at;
  }
  Wins& wins = wins_[at];
  wins.draws += static_cast<int>(draws.count());
  for_each_draw(draws, [&](std::size_t draw) {
    double best = 0.0;
    for (std::uint32_t row = first_row; row != kNone; row = rows_[row].next)
      if (class_of(rows_[row]) == class_id && rows_[row].draws.has(draw))
        best = std::max(best, groups_[rows_[row].group].score);
    wins.score_sum += best;
  });
  for (std::uint32_t row = first_row; row != kNone; row = rows_[row].next)
    if (class_of(rows_[row]) == class_id) rows_[row].draws = {};
}

void HitGrid::end_batch() {
  for (const std::uint32_t touched : touched_) {
    Slot& slot = slots_[touched];
    decide(slot);
    for (std::uint32_t row = slot.rows; row != kNone; row = rows_[row].next) win(slot, row);
    slot.rows = kNone;
    slot.contested = {};
  }
  contested_blocks_.clear();
  touched_.clear();
  rows_.clear();
  counts_.clear();
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
