// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

namespace mapscore::eval {

/// Finds the nearest of a set of closed lattice cubes for the points of one voxel at a time. Exact:
/// a KD-tree over the cubes' indices gives, for the whole voxel, every cube that can be nearest to
/// a point of it. Not thread-safe; make one where it is used.
class NearestCube {
 public:
  /// `cubes` must outlive this.
  NearestCube(std::span<const VoxelKey> cubes, double edge_m);
  ~NearestCube();
  NearestCube(const NearestCube&) = delete;
  NearestCube& operator=(const NearestCube&) = delete;

  /// Prepares `distance_m` for points of this voxel.
  void enter(const VoxelKey& voxel);
  /// Euclidean distance in metres from a point of the entered voxel (`offset_m` from its centre) to
  /// the nearest cube, 0 inside or on it; kUnreached when there is no cube.
  [[nodiscard]] double distance_m(const Eigen::Vector3d& offset_m) const;

 private:
  /// A cube that can be nearest: its lattice offset from the entered voxel, and the least squared
  /// distance between the two cubes, in edges.
  struct Candidate {
    Eigen::Vector3d offset;
    double least_squared;
  };
  struct Tree;

  double edge_m_;
  std::unique_ptr<Tree> tree_;
  std::vector<Candidate> candidates_;  ///< by ascending least distance
};

}  // namespace mapscore::eval
