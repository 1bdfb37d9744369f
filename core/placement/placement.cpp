// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/placement/placement.hpp"

#include "core/error.hpp"
#include "core/geometry/voxel.hpp"
#include "core/placement/draw_votes.hpp"
#include "core/placement/part_boxes.hpp"
#include "core/placement/point_parts.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

namespace mapscore {
namespace {

/// Places the points of one frame in one draw after the other (docs/fusion.md, Many draws).
class FramePlacer {
 public:
  FramePlacer(const Observation& observation, const PointParts& parts, PartBoxes boxes,
              double edge_m)
      : edge_m_(edge_m), parts_(parts), boxes_(std::move(boxes)), votes_(observation) {}

  void place(const Pose& T_map_sensor) {
    R_ = T_map_sensor.linear();
    t_ = T_map_sensor.translation();
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
    for (const Eigen::Vector3d& p_sensor : part.points) {
      const Eigen::Vector3d p_map = R_ * p_sensor + t_;
      if (const auto key = packable_voxel_of(p_map, edge_m_)) votes_.add(*key, part.object, 1);
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
        votes_.add(boxes_.low(n), object, static_cast<int>(points.size()));
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
  Eigen::Matrix3d R_;  ///< of the current draw, with t_
  Eigen::Vector3d t_;
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
