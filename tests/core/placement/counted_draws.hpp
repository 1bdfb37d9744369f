// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/placement/placement.hpp"

#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

namespace mapscore::testing {

/// Points of one object in one voxel.
struct Run {
  std::uint64_t voxel;  ///< packed key
  ClassId class_id;
  int points;
  double score;
};

/// Every point of one draw in its voxel; neighbours in one voxel are counted together.
inline std::vector<Run> runs_of(const Observation& observation, const Pose& T_map_sensor,
                                double edge_m) {
  std::vector<Run> runs;
  const Eigen::Matrix3d R = T_map_sensor.linear();
  const Eigen::Vector3d t = T_map_sensor.translation();
  for (const ObservedObject& object : observation) {
    const std::size_t first = runs.size();
    for (const Eigen::Vector3d& p_sensor : object.positions) {
      const Eigen::Vector3d p_map = R * p_sensor + t;
      const auto key = packable_voxel_of(p_map, edge_m);
      if (!key) continue;
      if (runs.size() > first && runs.back().voxel == pack(*key))
        ++runs.back().points;
      else
        runs.push_back({pack(*key), object.class_id, 1, object.score});
    }
  }
  return runs;
}

/// Sorts the runs of one draw and gives each voxel to the class with most points, ties to the lower
/// id.
inline void append_winners(std::vector<Run> runs, std::vector<VoxelHit>& wins) {
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) {
    return std::tie(a.voxel, a.class_id) < std::tie(b.voxel, b.class_id);
  });
  for (auto run = runs.begin(); run != runs.end();) {
    VoxelHit winner{unpack(run->voxel), kBackground, 1, 0.0};
    int most = 0;
    for (const std::uint64_t voxel = run->voxel; run != runs.end() && run->voxel == voxel;) {
      const ClassId class_id = run->class_id;
      int points = 0;
      double best = 0.0;
      for (; run != runs.end() && run->voxel == voxel && run->class_id == class_id; ++run) {
        points += run->points;
        best = std::max(best, run->score);
      }
      if (points <= most) continue;
      most = points;
      winner.class_id = class_id;
      winner.score_sum = best;
    }
    wins.push_back(winner);
  }
}

/// Plain passes, one a draw: every point is looked at in every draw, and everything is sorted. What
/// place() must equal to the bit, far points included.
inline std::vector<VoxelHit> counted_place(const Observation& observation,
                                           std::span<const Pose> T_map_sensor, double edge_m) {
  std::vector<VoxelHit> wins;
  for (const Pose& pose : T_map_sensor) append_winners(runs_of(observation, pose, edge_m), wins);
  const auto before = [](const VoxelHit& a, const VoxelHit& b) {
    return std::tie(a.key, a.class_id) < std::tie(b.key, b.class_id);
  };
  if (T_map_sensor.size() > 1) std::stable_sort(wins.begin(), wins.end(), before);
  std::vector<VoxelHit> hits;
  for (const VoxelHit& win : wins) {
    if (hits.empty() || before(hits.back(), win)) {
      hits.push_back(win);
      continue;
    }
    ++hits.back().draws;
    hits.back().score_sum += win.score_sum;
  }
  return hits;
}

}  // namespace mapscore::testing
