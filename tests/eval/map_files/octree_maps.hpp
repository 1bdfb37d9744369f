// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/mapping/semantic_map.hpp"

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace mapscore::testing {

/// Maps such as other programs make, by OctoMap's own calls alone.

inline constexpr double kOctreeEdge = 0.05;

/// A ball seen from all around: its surface occupied, the air between it and the sensor free, and
/// pruned.
inline octomap::OcTree plain_tree(double radius_m = 0.8) {
  octomap::OcTree tree(kOctreeEdge);
  octomap::Pointcloud cloud;
  constexpr int kPoints = 2000;
  for (int n = 0; n < kPoints; ++n) {  // evenly spread by the golden angle
    const double z = 1.0 - (2.0 * n + 1.0) / kPoints, angle = 2.399963 * n;
    const double ring = radius_m * std::sqrt(1.0 - z * z);
    cloud.push_back(static_cast<float>(ring * std::cos(angle)),
                    static_cast<float>(ring * std::sin(angle)), static_cast<float>(radius_m * z));
  }
  for (int scan = 0; scan < 3; ++scan)
    tree.insertPointCloud(cloud, octomap::point3d(0.03f, -0.02f, 0.01f));
  tree.prune();
  return tree;
}

/// A board of two colours, a block of one colour that is pruned, and free space.
inline octomap::ColorOcTree colour_tree() {
  octomap::ColorOcTree tree(kOctreeEdge);
  const auto set = [&](int i, int j, int k, bool occupied, std::uint8_t red) {
    auto* node = tree.updateNode(octree_key({i, j, k}), occupied);
    node->setColor(red, 16, 200);
  };
  for (int i = -6; i < 9; ++i)
    for (int j = -3; j < 12; ++j) set(i, j, -1, true, (i + j) % 2 == 0 ? 10 : 250);
  for (int i = 8; i < 12; ++i)
    for (int j = 8; j < 12; ++j)
      for (int k = 8; k < 12; ++k) set(i, j, k, true, 99);
  for (int k = 0; k < 8; ++k) set(2, 3, k, false, 1);
  tree.updateNode(octree_key({20, 20, 20}), true);  // without a colour
  tree.updateInnerOccupancy();
  tree.prune();
  return tree;
}

/// Two classes that overlap, and a few voxels of background.
inline SemanticMap semantic_map() {
  SemanticMap map(kOctreeEdge);
  std::vector<VoxelHit> hits;
  for (int i = -9; i < 9; ++i)
    for (int j = -4; j < 4; ++j) {
      VoxelHit hit;
      hit.key = {i, j, i * j};
      hit.draws = 1;
      hit.class_id = static_cast<ClassId>(i < -6 ? kBackground : i < 2 ? 1 : 2);
      hit.score_sum = 0.5 + 0.02 * (i + j);
      hits.push_back(hit);
    }
  map.fuse(hits, 1, BlendRule{0.5});
  std::vector<VoxelHit> again(hits.begin() + 60, hits.begin() + 110);
  for (VoxelHit& hit : again) hit.class_id = 3;
  map.fuse(again, 1, BlendRule{0.5});
  return map;
}

/// What a tree writes, as .ot or as .bt.
template <class Tree>
void write_ot(const Tree& tree, const std::filesystem::path& file) {
  std::ofstream stream(file, std::ios::binary);
  tree.write(stream);
}
template <class Tree>
void write_bt(const Tree& tree, const std::filesystem::path& file) {
  std::ofstream stream(file, std::ios::binary);
  tree.writeBinaryConst(stream);
}

}  // namespace mapscore::testing
