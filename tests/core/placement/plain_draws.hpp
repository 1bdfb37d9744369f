// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/mapping/semantic_octree.hpp"
#include "core/placement/placement.hpp"

#include <octomap/OcTreeNode.h>
#include <octomap/OccupancyOcTreeBase.h>

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace mapscore::testing {

/// What one class has in one voxel: positions and best score in the draw under way, and what it won
/// in the draws before.
struct Votes {
  int positions = 0;
  double best_score = 0.0;
  int draws = 0;
  double score_sum = 0.0;
};

class VoteNode : public octomap::OcTreeNode {
 public:
  std::map<ClassId, Votes> votes;
  int draw = -1;  ///< that saw it last
};

class VoteTree : public octomap::OccupancyOcTreeBase<VoteNode> {
 public:
  using OccupancyOcTreeBase<VoteNode>::OccupancyOcTreeBase;
  VoteTree* create() const override { return new VoteTree(resolution); }
  std::string getTreeType() const override { return "VoteTree"; }
};

/// The class with most positions, ties to the lower id, wins the voxel; the votes begin anew.
inline void end_draw(VoteNode& voxel) {
  auto winner = voxel.votes.begin();
  for (auto votes = voxel.votes.begin(); votes != voxel.votes.end(); ++votes)
    if (votes->second.positions > winner->second.positions) winner = votes;
  ++winner->second.draws;
  winner->second.score_sum += winner->second.best_score;
  for (auto& [class_id, votes] : voxel.votes) {
    votes.positions = 0;
    votes.best_score = 0.0;
  }
}

/// N passes over an octree, plainly: in each draw every position is looked up in the octree and
/// votes in its voxel.
inline std::vector<VoxelHit> plain_place(const Observation& observation,
                                         std::span<const Pose> T_map_sensor, double edge_m) {
  VoteTree tree(edge_m);
  std::vector<VoteNode*> seen;
  for (int draw = 0; draw < static_cast<int>(T_map_sensor.size()); ++draw) {
    const Eigen::Matrix3d R = T_map_sensor[static_cast<std::size_t>(draw)].linear();
    const Eigen::Vector3d t = T_map_sensor[static_cast<std::size_t>(draw)].translation();
    seen.clear();
    for (const ObservedObject& object : observation)
      for (const Eigen::Vector3d& p_sensor : object.positions) {
        const Eigen::Vector3d p_map = R * p_sensor + t;
        constexpr bool kLazy = true;
        VoteNode* voxel = tree.updateNode(octree_key(voxel_of(p_map, edge_m)), true, kLazy);
        if (voxel->draw != draw) seen.push_back(voxel);
        voxel->draw = draw;
        Votes& votes = voxel->votes[object.class_id];
        ++votes.positions;
        votes.best_score = std::max(votes.best_score, object.score);
      }
    for (VoteNode* voxel : seen) end_draw(*voxel);
  }
  std::vector<VoxelHit> hits;
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf)
    for (const auto& [class_id, votes] : leaf->votes)
      if (votes.draws > 0)
        hits.push_back({voxel_key(leaf.getIndexKey()), class_id, votes.draws, votes.score_sum});
  std::sort(hits.begin(), hits.end(), [](const VoxelHit& a, const VoxelHit& b) {
    return a.key != b.key ? a.key < b.key : a.class_id < b.class_id;
  });
  return hits;
}

}  // namespace mapscore::testing
