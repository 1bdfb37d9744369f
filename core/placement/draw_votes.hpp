// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/placement/observation.hpp"
#include "core/placement/voxel_hit.hpp"
#include "core/placement/voxel_index.hpp"

#include <cstdint>
#include <vector>

namespace mapscore {

/// Counts each object's points in each voxel, one draw after the other, and credits each voxel to
/// the class with most points. Only contested voxels, which hold points of several classes, need
/// exact counts; in all others one vote an object is enough. Not thread-safe.
class DrawVotes {
 public:
  /// Objects are numbered by their place in the observation.
  explicit DrawVotes(const Observation& observation);

  /// Adds points of an object to a voxel in the current draw.
  void add(const VoxelKey& key, std::uint32_t object, int points) {
    if (key != last_key_ || object != last_object_) begin_votes(key, object);
    last_vote_->points += points;
  }
  /// True if the object has votes in the voxel in the current draw.
  [[nodiscard]] bool has(const VoxelKey& key, std::uint32_t object);
  /// True if several classes have votes in the voxel in the current draw.
  [[nodiscard]] bool contested(const VoxelKey& key);
  /// True if any voxel is contested in the current draw.
  [[nodiscard]] bool any_contested() const { return any_contested_; }

  /// Credits each voxel to the class with most points, ties to the lower id, and starts a new draw.
  void end_draw();
  /// What each class won in all ended draws, ascending by voxel, then class.
  [[nodiscard]] std::vector<VoxelHit> hits() const;

 private:
  static constexpr std::uint32_t kNone = VoxelIndex::kNone;

  /// One object in one voxel.
  struct Vote {
    std::uint32_t object = kNone;
    std::uint32_t next = kNone;  ///< in the list of the same voxel, an index into votes_
    int draw = -1;               ///< latest draw in which the object had points here
    int points = 0;              ///< in that draw
    int draws_won = 0;           ///< by the class; kept in the class's first vote of the voxel
    double score_sum = 0.0;      ///< over those draws
  };
  /// The votes of one voxel: `first`, then the list that starts at its `next`.
  struct Voxel {
    Vote first;
    int draw = -1;                   ///< latest draw in which anything had points here
    ClassId class_id = kBackground;  ///< of the first vote of that draw
    bool contested = false;          ///< in that draw
  };

  void begin_votes(const VoxelKey& key, std::uint32_t object);
  [[nodiscard]] Vote& vote_of(Voxel& voxel, std::uint32_t object);
  [[nodiscard]] ClassId winner_of(const Voxel& voxel) const;
  void credit(Voxel& voxel, ClassId winner);
  [[nodiscard]] ClassId class_of(const Vote& vote) const { return classes_[vote.object]; }
  [[nodiscard]] Vote* next(const Vote* vote) {
    return vote->next == kNone ? nullptr : &votes_[vote->next];
  }
  [[nodiscard]] const Vote* next(const Vote* vote) const {
    return vote->next == kNone ? nullptr : &votes_[vote->next];
  }

  std::vector<ClassId> classes_;  ///< by object
  std::vector<double> scores_;    ///< by object
  VoxelIndex index_;
  std::vector<Voxel> voxels_;         ///< by their numbers in index_
  std::vector<Vote> votes_;           ///< all but the first of each voxel
  int draw_ = 0;                      ///< the current one
  std::vector<std::uint32_t> voted_;  ///< numbers of the voxels with votes in the current draw
  bool any_contested_ = false;
  VoxelKey last_key_;  ///< with last_object_, what add() was called with last
  std::uint32_t last_object_ = kNone;
  Vote* last_vote_ = nullptr;
};

}  // namespace mapscore
