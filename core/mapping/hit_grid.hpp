// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"
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

/// Gathers the hits of one frame, draw by draw: which groups are present in a voxel, how many
/// positions the classes have in contested ones, and what each class won so far. A grid of blocks
/// of 8 x 8 x 8 voxels that come into being where something is hit.
class HitGrid {
 public:
  /// Most blocks that the box may span.
  static constexpr std::size_t kMostBlocks = 1 << 20;
  [[nodiscard]] static bool holds(const VoxelBox& box);

  /// For hits within a box that `holds` allows. `groups` must outlive it.
  HitGrid(const VoxelBox& box, std::span<const ScoredClass> groups);

  /// Says that a group has positions in the voxel, in the draw under way.
  void mark(const VoxelKey& key, std::uint16_t group) {
    slot_in_draw(key).present |= std::uint64_t{1} << group;
  }
  [[nodiscard]] bool marked(const VoxelKey& key, std::uint16_t group) const {
    const std::uint32_t slot = find(key);
    return slot != kNone && slots_[slot].draw == draw_ && (slots_[slot].present >> group & 1) != 0;
  }
  /// Whether positions of several classes are marked in the voxel.
  [[nodiscard]] bool contested(const VoxelKey& key) const;
  /// Adds to a group's positions in a marked voxel; needed for all of them where classes meet, of
  /// no effect elsewhere.
  void count(const VoxelKey& key, std::uint16_t group, int positions);

  /// Decides the winners of the draw under way and begins the next.
  void end_draw();

  /// All hits, ascending by voxel, then class.
  [[nodiscard]] std::vector<VoxelHit> hits() const;

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  struct Slot {
    std::uint64_t voxel = 0;    ///< packed key
    std::uint64_t present = 0;  ///< bit by group, in draw `draw`
    std::uint32_t draw = 0;
    std::uint32_t counts = kNone;  ///< row of counts_ in draw `draw`
    std::uint32_t wins = kNone;    ///< first of its wins
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
  Slot& slot_in_draw(const VoxelKey& key) {
    const std::uint32_t found = find(key);
    const std::uint32_t slot = found == kNone ? make_slot(key) : found;
    if (slots_[slot].draw != draw_) touch(slot);
    return slots_[slot];
  }
  std::uint32_t make_slot(const VoxelKey& key);
  void touch(std::uint32_t slot);
  [[nodiscard]] ClassId winner_of(const Slot& slot) const;
  void win(Slot& slot, ClassId class_id, double score);

  VoxelKey low_;
  std::size_t blocks_y_, blocks_z_;
  std::span<const ScoredClass> groups_;
  std::vector<std::uint16_t> rank_of_group_;  ///< which of the classes that occur it belongs to
  std::vector<ClassId> class_of_rank_;
  std::vector<std::uint64_t> groups_of_rank_;  ///< bits
  std::vector<std::uint32_t> blocks_, in_blocks_;
  std::vector<Slot> slots_;
  std::vector<Wins> wins_;
  std::vector<std::uint32_t> touched_;
  std::vector<int> counts_;  ///< rows, a number by rank of class
  std::uint32_t draw_ = 1;
};

}  // namespace mapscore
