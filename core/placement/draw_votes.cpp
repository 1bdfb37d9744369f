// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/placement/draw_votes.hpp"

#include <algorithm>
#include <utility>

namespace mapscore {

DrawVotes::DrawVotes(const Observation& observation) {
  for (const ObservedObject& object : observation) {
    classes_.push_back(object.class_id);
    scores_.push_back(object.score);
  }
}

bool DrawVotes::has(const VoxelKey& key, std::uint32_t object) {
  const std::uint32_t number = index_.find(key);
  if (number == kNone || voxels_[number].draw != draw_) return false;
  for (const Vote* vote = &voxels_[number].first; vote; vote = next(vote))
    if (vote->object == object) return vote->draw == draw_;
  return false;
}

bool DrawVotes::contested(const VoxelKey& key) {
  const std::uint32_t number = index_.find(key);
  return number != kNone && voxels_[number].draw == draw_ && voxels_[number].contested;
}

void DrawVotes::begin_votes(const VoxelKey& key, std::uint32_t object) {
  const std::uint32_t number = index_.number(key);
  if (number == voxels_.size()) voxels_.emplace_back();
  Voxel& voxel = voxels_[number];
  if (voxel.draw != draw_) {
    voxel.draw = draw_;
    voxel.class_id = classes_[object];
    voxel.contested = false;
    voted_.push_back(number);
  } else if (voxel.class_id != classes_[object]) {
    voxel.contested = any_contested_ = true;
  }
  Vote& vote = vote_of(voxel, object);
  if (vote.draw != draw_) vote.points = 0;
  vote.draw = draw_;
  last_key_ = key;
  last_object_ = object;
  last_vote_ = &vote;
}

DrawVotes::Vote& DrawVotes::vote_of(Voxel& voxel, std::uint32_t object) {
  if (voxel.first.object == kNone) voxel.first.object = object;
  Vote* vote = &voxel.first;
  while (vote->object != object && vote->next != kNone) vote = &votes_[vote->next];
  if (vote->object == object) return *vote;
  vote->next = static_cast<std::uint32_t>(votes_.size());
  return votes_.emplace_back(Vote{.object = object});
}

ClassId DrawVotes::winner_of(const Voxel& voxel) const {
  if (!voxel.contested) return voxel.class_id;
  int most = 0;
  ClassId winner = kBackground;
  for (const Vote* vote = &voxel.first; vote; vote = next(vote)) {
    if (vote->draw != draw_) continue;
    int points = 0;
    for (const Vote* same = &voxel.first; same; same = next(same))
      if (same->draw == draw_ && class_of(*same) == class_of(*vote)) points += same->points;
    if (points < most || (points == most && class_of(*vote) >= winner)) continue;
    most = points;
    winner = class_of(*vote);
  }
  return winner;
}

/// The class's score in a draw is the best one among its objects in the voxel.
void DrawVotes::credit(Voxel& voxel, ClassId winner) {
  Vote* first = nullptr;
  double best = 0.0;
  for (Vote* vote = &voxel.first; vote; vote = next(vote)) {
    if (class_of(*vote) != winner) continue;
    if (!first) first = vote;
    if (vote->draw == draw_) best = std::max(best, scores_[vote->object]);
  }
  ++first->draws_won;
  first->score_sum += best;
}

void DrawVotes::end_draw() {
  for (const std::uint32_t number : voted_) credit(voxels_[number], winner_of(voxels_[number]));
  voted_.clear();
  any_contested_ = false;
  last_object_ = kNone;
  ++draw_;
}

std::vector<VoxelHit> DrawVotes::hits() const {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;  // packed key, number
  order.reserve(voxels_.size());
  for (std::uint32_t number = 0; number < voxels_.size(); ++number)
    order.emplace_back(index_.keys()[number], number);
  std::sort(order.begin(), order.end());
  std::vector<VoxelHit> hits;
  hits.reserve(voxels_.size() + votes_.size());
  for (const auto& [key, number] : order) {
    const auto begin = static_cast<std::ptrdiff_t>(hits.size());
    for (const Vote* vote = &voxels_[number].first; vote; vote = next(vote))
      if (vote->draws_won > 0)
        hits.push_back({unpack(key), class_of(*vote), vote->draws_won, vote->score_sum});
    std::sort(hits.begin() + begin, hits.end(),
              [](const VoxelHit& a, const VoxelHit& b) { return a.class_id < b.class_id; });
  }
  return hits;
}

}  // namespace mapscore
