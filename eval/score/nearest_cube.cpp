// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/nearest_cube.hpp"

#include "eval/score/distance_tally.hpp"

#include <nanoflann.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mapscore::eval {

namespace {

/// Cube indices as nanoflann reads them; in double precision they and their squared distances are
/// exact.
struct CubeIndices {
  std::span<const VoxelKey> cubes;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return cubes.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t cube, std::size_t axis) const {
    const VoxelKey& key = cubes[cube];
    return axis == 0 ? key.i : axis == 1 ? key.j : key.k;
  }
  template <class BoundingBox>
  bool kdtree_get_bbox(BoundingBox&) const {
    return false;
  }
};

using KdTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, CubeIndices>,
                                        CubeIndices, 3, std::uint32_t>;

/// Search result: the nearest index vector, at D edges, and all within D + sqrt(3), among which are
/// all cubes that can be nearest to some point of the voxel. With d the offset of a cube, its
/// distance from any point is at least |max(|d| - 1, 0)| >= |d| - sqrt(3) and at most |d|.
class WithinReach {
 public:
  [[nodiscard]] std::size_t size() const { return found_.size(); }
  [[nodiscard]] bool full() const { return true; }
  bool addPoint(double squared, std::uint32_t cube) {
    if (squared > reach_squared_) return true;
    found_.push_back(cube);
    if (squared < nearest_squared_) {
      nearest_squared_ = squared;
      const double reach = std::sqrt(squared) + std::numbers::sqrt3 + 1e-6;
      reach_squared_ = reach * reach;
    }
    return true;
  }
  [[nodiscard]] double worstDist() const { return reach_squared_; }
  [[nodiscard]] double nearest_squared() const { return nearest_squared_; }
  [[nodiscard]] const std::vector<std::uint32_t>& found() const { return found_; }

 private:
  double nearest_squared_ = std::numeric_limits<double>::infinity();
  double reach_squared_ = std::numeric_limits<double>::infinity();
  std::vector<std::uint32_t> found_;
};

}  // namespace

struct NearestCube::Tree {
  CubeIndices indices;
  KdTree tree;

  explicit Tree(std::span<const VoxelKey> cubes) : indices{cubes}, tree(3, indices, {16}) {
    if (!cubes.empty()) tree.buildIndex();
  }
};

NearestCube::NearestCube(std::span<const VoxelKey> cubes, double edge_m)
    : edge_m_(edge_m), tree_(std::make_unique<Tree>(cubes)) {}

NearestCube::~NearestCube() = default;

void NearestCube::enter(const VoxelKey& voxel) {
  candidates_.clear();
  if (tree_->indices.cubes.empty()) return;
  const Eigen::Vector3d here(voxel.i, voxel.j, voxel.k);
  WithinReach reach;
  tree_->tree.radiusSearchCustomCallback(here.data(), reach);
  for (const std::uint32_t cube : reach.found()) {
    const VoxelKey& key = tree_->indices.cubes[cube];
    const Eigen::Vector3d offset = Eigen::Vector3d(key.i, key.j, key.k) - here;
    const double least = (offset.array().abs() - 1.0).max(0.0).matrix().squaredNorm();
    if (least <= reach.nearest_squared()) candidates_.push_back({offset, least});
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    return a.least_squared < b.least_squared;
  });
}

double NearestCube::distance_m(const Eigen::Vector3d& offset_m) const {
  const Eigen::Vector3d p = offset_m / edge_m_;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : candidates_) {
    if (candidate.least_squared >= nearest) break;
    const double squared =
        ((candidate.offset - p).array().abs() - 0.5).max(0.0).matrix().squaredNorm();
    nearest = std::min(nearest, squared);
  }
  return candidates_.empty() ? kUnreached : std::sqrt(nearest) * edge_m_;
}

}  // namespace mapscore::eval
