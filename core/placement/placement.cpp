// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/placement/placement.hpp"

#include "core/error.hpp"
#include "core/geometry/voxel_packer.hpp"
#include "core/placement/point_parts.hpp"
#include "core/placement/voxel_index.hpp"
#include "core/wide_vectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace mapscore {
namespace {

/// Counts each object's points in each voxel, one draw after the other, and credits each voxel to
/// the class with most points. Only contested voxels, which hold points of several classes, need
/// exact counts; in all others one vote an object is enough.
class DrawVotes {
 public:
  /// Objects are numbered by their place in the observation, which must outlive this.
  explicit DrawVotes(const Observation& observation) : observation_(observation) {}

  /// Adds points of an object to a voxel (packed) in the current draw.
  void add(std::uint64_t voxel, std::uint32_t object, int points) {
    if (voxel != last_voxel_ || object != last_object_) begin_votes(voxel, object);
    last_vote_->points += points;
  }
  /// True if the object has votes in the voxel in the current draw.
  [[nodiscard]] bool has(const VoxelKey& key, std::uint32_t object) {
    const std::uint32_t number = index_.find(pack(key));
    if (number == kNone || voxels_[number].draw != draw_) return false;
    for (const Vote* vote = &voxels_[number].first; vote; vote = next(vote))
      if (vote->object == object) return vote->draw == draw_;
    return false;
  }
  /// True if several classes have votes in the voxel in the current draw.
  [[nodiscard]] bool contested(const VoxelKey& key) {
    const std::uint32_t number = index_.find(pack(key));
    return number != kNone && voxels_[number].draw == draw_ && voxels_[number].contested;
  }
  /// True if any voxel is contested in the current draw.
  [[nodiscard]] bool any_contested() const { return any_contested_; }

  /// Credits each voxel to the class with most points, ties to the lower id, and starts a new draw.
  void end_draw() {
    for (const std::uint32_t number : voted_) credit(voxels_[number], winner_of(voxels_[number]));
    voted_.clear();
    any_contested_ = false;
    last_object_ = kNone;
    ++draw_;
  }
  /// What each class won in all ended draws, ascending by voxel, then class.
  [[nodiscard]] std::vector<VoxelHit> hits() const {
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
      std::ranges::sort(hits.begin() + begin, hits.end(), {}, &VoxelHit::class_id);
    }
    return hits;
  }

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

  void begin_votes(std::uint64_t packed, std::uint32_t object) {
    const std::uint32_t number = index_.number(packed);
    if (number == voxels_.size()) voxels_.emplace_back();
    Voxel& voxel = voxels_[number];
    const ClassId class_id = observation_[object].class_id;
    if (voxel.draw != draw_) {
      voxel.draw = draw_;
      voxel.class_id = class_id;
      voxel.contested = false;
      voted_.push_back(number);
    } else if (voxel.class_id != class_id) {
      voxel.contested = any_contested_ = true;
    }
    Vote& vote = vote_of(voxel, object);
    if (vote.draw != draw_) vote.points = 0;
    vote.draw = draw_;
    last_voxel_ = packed;
    last_object_ = object;
    last_vote_ = &vote;
  }

  [[nodiscard]] Vote& vote_of(Voxel& voxel, std::uint32_t object) {
    if (voxel.first.object == kNone) voxel.first.object = object;
    Vote* vote = &voxel.first;
    while (vote->object != object && vote->next != kNone) vote = &votes_[vote->next];
    if (vote->object == object) return *vote;
    vote->next = static_cast<std::uint32_t>(votes_.size());
    return votes_.emplace_back(Vote{.object = object});
  }

  [[nodiscard]] ClassId winner_of(const Voxel& voxel) const {
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
  void credit(Voxel& voxel, ClassId winner) {
    Vote* first = nullptr;
    double best = 0.0;
    for (Vote* vote = &voxel.first; vote; vote = next(vote)) {
      if (class_of(*vote) != winner) continue;
      if (!first) first = vote;
      if (vote->draw == draw_) best = std::max(best, observation_[vote->object].score);
    }
    ++first->draws_won;
    first->score_sum += best;
  }

  [[nodiscard]] ClassId class_of(const Vote& vote) const {
    return observation_[vote.object].class_id;
  }
  [[nodiscard]] Vote* next(const Vote* vote) {
    return vote->next == kNone ? nullptr : &votes_[vote->next];
  }
  [[nodiscard]] const Vote* next(const Vote* vote) const {
    return vote->next == kNone ? nullptr : &votes_[vote->next];
  }

  const Observation& observation_;
  VoxelIndex index_;
  std::vector<Voxel> voxels_;         ///< by their numbers in index_
  std::vector<Vote> votes_;           ///< all but the first of each voxel
  int draw_ = 0;                      ///< the current one
  std::vector<std::uint32_t> voted_;  ///< numbers of the voxels with votes in the current draw
  bool any_contested_ = false;
  std::uint64_t last_voxel_ = 0;  ///< with last_object_, what add() was called with last
  std::uint32_t last_object_ = kNone;
  Vote* last_vote_ = nullptr;
};

/// The packed voxels of points, as VoxelPacker gives them.
MAPSCORE_WIDE_VECTORS
void pack_points(const Eigen::Vector3d* points, std::size_t count, const VoxelPacker& packer,
                 std::uint64_t* packed) {
  const VoxelPacker pack = packer;
  for (std::size_t n = 0; n < count; ++n)
    packed[n] = pack(points[n].x(), points[n].y(), points[n].z());
}

/// Places the points of one frame in one draw after the other (docs/fusion.md, Many draws).
class FramePlacer {
 public:
  FramePlacer(const Observation& observation, const PointParts& parts, PartBoxes boxes,
              double edge_m)
      : edge_m_(edge_m), parts_(parts), boxes_(std::move(boxes)), votes_(observation) {}

  void place(const Pose& T_map_sensor) {
    T_map_sensor_ = T_map_sensor;
    packer_ = VoxelPacker(T_map_sensor, edge_m_);
    for (const PointPart& part : parts_.loose) vote_by_points(part);
    if (boxes_.move_to(T_map_sensor))
      vote_by_parts();
    else
      for (const PointPart& part : parts_.small) vote_by_points(part);
    votes_.end_draw();
  }
  [[nodiscard]] std::vector<VoxelHit> hits() const { return votes_.hits(); }

 private:
  void vote_by_points(const PointPart& part) {
    for (std::span rest = part.points; !rest.empty();) {
      const auto points = rest.first(std::min(rest.size(), packed_.size()));
      rest = rest.subspan(points.size());
      pack_points(points.data(), points.size(), packer_, packed_.data());
      for (std::size_t n = 0; n < points.size(); ++n) {
        if (packed_[n] != VoxelPacker::kNone)
          votes_.add(packed_[n], part.object, 1);
        else if (const auto far = packable_voxel_of(T_map_sensor_ * points[n], edge_m_))
          votes_.add(pack(*far), part.object, 1);
      }
    }
  }

  /// Looks at the points of a part only where they can change the outcome: where its box reaches
  /// a voxel in which its object has no votes yet, or a contested one.
  void vote_by_parts() {
    open_.clear();
    unread_.clear();
    for (std::uint32_t n = 0; n < parts_.small.size(); ++n) {
      const auto& [object, points] = parts_.small[n];
      if (boxes_.within_one_voxel(n))
        votes_.add(pack(boxes_.low(n)), object, static_cast<int>(points.size()));
      else
        open_.push_back(n);
    }
    for (const std::uint32_t n : open_) {
      const std::uint32_t object = parts_.small[n].object;
      if (reaches_any(n, [&](const VoxelKey& key) { return !votes_.has(key, object); }))
        vote_by_points(parts_.small[n]);
      else
        unread_.push_back(n);
    }
    if (!votes_.any_contested()) return;
    for (const std::uint32_t n : unread_)
      if (reaches_any(n, [&](const VoxelKey& key) { return votes_.contested(key); }))
        vote_by_points(parts_.small[n]);
  }

  /// True if `test` holds for any of the voxels that a part's box reaches.
  [[nodiscard]] bool reaches_any(std::uint32_t part, auto&& test) const {
    const VoxelKey low = boxes_.low(part), high = boxes_.high(part);
    for (std::int32_t i = low.i; i <= high.i; ++i)
      for (std::int32_t j = low.j; j <= high.j; ++j)
        for (std::int32_t k = low.k; k <= high.k; ++k)
          if (test(VoxelKey{i, j, k})) return true;
    return false;
  }

  double edge_m_;
  const PointParts& parts_;
  PartBoxes boxes_;
  DrawVotes votes_;
  Pose T_map_sensor_;  ///< of the current draw
  VoxelPacker packer_{Pose::Identity(), edge_m_};
  std::array<std::uint64_t, 512> packed_{};
  std::vector<std::uint32_t> open_;    ///< parts that may lie in several voxels
  std::vector<std::uint32_t> unread_;  ///< of these, parts that can enter no further voxel
};

/// About the mean rotation of the draws, over the edge: in these coordinates of the points the
/// map's axes are nearly those of the boxes. Draws all around have no mean; any matrix serves.
Eigen::Matrix3d to_voxels(std::span<const Pose> T_map_sensor, double edge_m) {
  constexpr double kLeastDeterminant = 0.1;
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (const Pose& pose : T_map_sensor)
    mean += pose.linear() / static_cast<double>(T_map_sensor.size());
  if (!(mean.determinant() > kLeastDeterminant)) mean.setIdentity();
  return mean / edge_m;
}

}  // namespace

std::vector<VoxelHit> place(const Observation& observation, std::span<const Pose> T_map_sensor,
                            double edge_m) {
  if (!(edge_m > 0.0) || !std::isfinite(edge_m))
    throw Error("voxel_m: must be a positive length in metres");
  const Eigen::Matrix3d turn = to_voxels(T_map_sensor, edge_m);
  const PointParts parts = sort_into_parts(observation, turn, T_map_sensor.size());
  FramePlacer placer(observation, parts, PartBoxes(parts.boxes, turn, T_map_sensor, edge_m),
                     edge_m);
  for (const Pose& pose : T_map_sensor) placer.place(pose);
  return placer.hits();
}

}  // namespace mapscore
