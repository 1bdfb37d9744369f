// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"
#include "core/mapping/draw_set.hpp"
#include "core/mapping/position_cells.hpp"
#include "core/mapping/voxel_hit.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mapscore {

/// Voxels from low to high, both included.
struct VoxelBox {
  VoxelKey low, high;
};

/// Gathers the hits of one frame, batch of draws by batch: in which draws groups are present in a
/// voxel, how many positions the classes have in contested ones, and what each class won so far. A
/// grid of blocks of 8 x 8 x 8 voxels that come into being where something is hit.
class HitGrid {
 public:
  /// Most blocks that the box may span.
  static constexpr std::size_t kMostBlocks = 1 << 20;
  [[nodiscard]] static bool holds(const VoxelBox& box);

  /// For hits within a box that `holds` allows. `groups` must outlive it.
  HitGrid(const VoxelBox& box, std::span<const ScoredClass> groups);

  /// Says that a group has positions in the voxel in these draws.
  void mark(const VoxelKey& key, std::uint16_t group, const DrawSet& draws) {
    rows_[row_of(key, group)].draws |= draws;
  }
  [[nodiscard]] DrawSet marked(const VoxelKey& key, std::uint16_t group) const {
    const std::uint32_t row = find_row(key, group);
    return row == kNone ? DrawSet{} : rows_[row].draws;
  }
  /// Once all is marked, finds where positions of several classes are in one voxel.
  void find_contested();
  [[nodiscard]] DrawSet contested(const VoxelKey& key) const {
    const std::uint32_t slot = find(key);
    return slot == kNone ? DrawSet{} : slots_[slot].contested;
  }
  /// Whether there may be such voxels in a box.
  [[nodiscard]] bool contested_within(const VoxelBox& box) const;
  /// Adds to a group's positions in a marked voxel, in a draw in which it is contested; needed for
  /// all of them.
  void count(const VoxelKey& key, std::uint16_t group, std::size_t draw, int positions) {
    counts_[rows_[find_row(key, group)].counts + draw] += positions;
  }

  /// Decides the winners of the draws of this batch and begins the next.
  void end_batch();

  /// All hits, ascending by voxel, then class.
  [[nodiscard]] std::vector<VoxelHit> hits() const;

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  struct Slot {
    std::uint64_t voxel = 0;     ///< packed key
    std::uint32_t rows = kNone;  ///< first of this batch
    std::uint32_t wins = kNone;  ///< first of its wins
    DrawSet contested;
  };
  /// One group in one voxel in the draws of the batch.
  struct Row {
    DrawSet draws;
    std::uint16_t group = 0;
    std::uint32_t next = kNone;    ///< of the same voxel
    std::uint32_t counts = kNone;  ///< of its class, a number by draw
  };
  /// What one class won in a voxel so far.
  struct Wins {
    ClassId class_id = kBackground;
    int draws = 0;
    double score_sum = 0.0;
    std::uint32_t next = kNone;  ///< of the same voxel
  };

  [[nodiscard]] std::size_t block_of(const VoxelKey& key) const {
    return (static_cast<std::size_t>((key.i - low_.i) >> 3) * blocks_y_ +
            static_cast<std::size_t>((key.j - low_.j) >> 3)) *
               blocks_z_ +
           static_cast<std::size_t>((key.k - low_.k) >> 3);
  }
  [[nodiscard]] std::size_t within_block(const VoxelKey& key) const {
    return static_cast<std::size_t>(((key.i - low_.i) & 7) << 6 | ((key.j - low_.j) & 7) << 3 |
                                    ((key.k - low_.k) & 7));
  }
  [[nodiscard]] std::uint32_t find(const VoxelKey& key) const {
    const std::uint32_t block = blocks_[block_of(key)];
    return block == kNone ? kNone : in_blocks_[512 * std::size_t{block} + within_block(key)];
  }
  [[nodiscard]] std::uint32_t row_in(std::uint32_t slot, std::uint16_t group) const {
    std::uint32_t row = slots_[slot].rows;
    while (row != kNone && rows_[row].group != group) row = rows_[row].next;
    return row;
  }
  [[nodiscard]] std::uint32_t find_row(const VoxelKey& key, std::uint16_t group) const {
    const std::uint32_t slot = find(key);
    return slot == kNone ? kNone : row_in(slot, group);
  }
  std::uint32_t row_of(const VoxelKey& key, std::uint16_t group) {
    const std::uint32_t row = find_row(key, group);
    return row == kNone ? make_row(key, group) : row;
  }
  std::uint32_t make_row(const VoxelKey& key, std::uint16_t group);
  std::uint32_t make_slot(const VoxelKey& key);
  [[nodiscard]] ClassId class_of(const Row& row) const { return groups_[row.group].class_id; }
  /// Leaves each contested draw to the class that won it.
  void decide(const Slot& slot);
  void win(Slot& slot, std::uint32_t first_row);

  VoxelKey low_;
  std::size_t blocks_y_, blocks_z_;
  std::span<const ScoredClass> groups_;
  std::vector<std::uint32_t> blocks_, in_blocks_;
  std::vector<bool> contested_blocks_;  ///< as blocks_; empty where there are none
  std::vector<Slot> slots_;
  std::vector<Row> rows_;
  std::vector<Wins> wins_;
  std::vector<std::uint32_t> touched_;  ///< slots with rows
  std::vector<int> counts_;
};

}  // namespace mapscore
