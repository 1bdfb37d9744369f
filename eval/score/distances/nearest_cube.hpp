// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"
#include "eval/score/voxel_window.hpp"

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

namespace mapscore::eval {

/// Finds the nearest of a set of closed lattice cubes for the points of one voxel at a time. Exact:
/// finds, for the whole voxel, every cube that can be nearest to a point of it, in the surroundings
/// where one is near, else by a KD-tree over the cubes' indices. Not thread-safe, but copies share
/// the tree: give each thread its own.
class NearestCube {
 public:
  /// `cubes` ordered by key; they must outlive this and its copies.
  NearestCube(std::span<const VoxelKey> cubes, double edge_m);

  /// Prepares `distance_m` for points of this voxel. Fastest when voxels come ordered by key.
  void enter(const VoxelKey& voxel);
  /// Euclidean distance in metres from a point of the entered voxel (`offset_m` from its centre) to
  /// the nearest cube, 0 inside or on it; kUnreached when there is no cube.
  [[nodiscard]] double distance_m(const Eigen::Vector3d& offset_m) const;

 private:
  /// A cube that can be nearest: its lattice offset from the entered voxel, and the least squared
  /// distance between the two cubes, in edges.
  struct Candidate {
    Candidate(const VoxelKey& cube, const VoxelKey& voxel);
    Eigen::Vector3d offset;
    double least_squared;
  };
  struct Tree;

  [[nodiscard]] bool look_around(const VoxelKey& voxel, int reach, VoxelWindow<VoxelKey>& around);
  void search_tree(const VoxelKey& voxel);
  void keep_nearest(double squared);

  std::span<const VoxelKey> cubes_;
  double edge_m_;
  std::shared_ptr<Tree> tree_;
  VoxelWindow<VoxelKey> near_, farther_;
  VoxelKey entered_;
  std::vector<Candidate> candidates_;  ///< by ascending least distance
};

}  // namespace mapscore::eval
