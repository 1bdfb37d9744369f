// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT
//
// OctoMap's own mapper as a method of a study: octomap_mapper TRIAL MAP.csv. insertPointCloud
// decides which voxels are occupied; a voxel's class is that of most points that were ever seen in
// it behind a detection's mask.

#include "core/error.hpp"
#include "core/mapping/mapper.hpp"
#include "core/segmentation/direct.hpp"
#include "eval/foreign/trial_folder.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>

namespace {

using namespace mapscore;

/// Points of every class in every voxel.
using Votes = std::map<VoxelKey, std::map<ClassId, int>>;

octomap::point3d point_of(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

/// All depth points in frame map.
octomap::Pointcloud cloud_of(const Sight& sight, const Pose& T_map_depth) {
  octomap::Pointcloud cloud;
  const Calibration& believed = sight.believed();
  for (int v = 0; v < sight.depth().rows; ++v)
    for (int u = 0; u < sight.depth().cols; ++u) {
      const double z_m = sight.depth()(v, u) / kDepthUnitsPerMetre;
      if (z_m >= believed.range_min_m && z_m <= believed.range_max_m)
        cloud.push_back(point_of(T_map_depth * believed.depth.back_project(u, v, z_m)));
    }
  return cloud;
}

void add_frame(const eval::TrialFolder& trial, int n, octomap::OcTree& tree, Votes& votes) {
  const Sight sight = trial.sight(n);
  const Pose T_map_depth = mean_sensor_pose(trial.frame(n).belief, sight.believed());
  constexpr bool kLazy = false, kOneRayAVoxel = true;  // the second: a tenth of the time
  tree.insertPointCloud(cloud_of(sight, T_map_depth), point_of(T_map_depth.translation()), -1.0,
                        kLazy, kOneRayAVoxel);
  for (const Detection& one : sight.detections())
    for (const Eigen::Vector3d& p : points_behind(one.mask, one.box, sight.cloud()))
      ++votes[voxel_of(T_map_depth * p, trial.sheet().voxel_m)][one.class_id];
}

void write_map(const octomap::OcTree& tree, const Votes& votes, const char* file) {
  std::ofstream csv(file);
  csv << "i,j,k,class\n";
  for (const auto& [key, counts] : votes) {
    const auto* node = tree.search(point_of(centre_of(key, tree.getResolution())));
    if (node == nullptr || !tree.isNodeOccupied(node)) continue;
    const auto most =
        std::ranges::max_element(counts, {}, [](const auto& of) { return of.second; });
    csv << key.i << ',' << key.j << ',' << key.k << ',' << most->first << '\n';
  }
}

}  // namespace

int main(int count, char** words) try {
  if (count != 3) throw Error("octomap_mapper TRIAL MAP.csv");
  const eval::TrialFolder trial(words[1]);
  octomap::OcTree tree(trial.sheet().voxel_m);
  Votes votes;
  for (int n = 0; n < trial.frame_count(); ++n) add_frame(trial, n, tree, votes);
  write_map(tree, votes, words[2]);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
