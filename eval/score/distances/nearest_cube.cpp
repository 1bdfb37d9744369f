// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/distances/nearest_cube.hpp"

#include "eval/score/distance_tally.hpp"

#include <nanoflann.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>

namespace mapscore::eval {

namespace {

/// How far `enter` looks first, and then before it asks the tree, voxels.
constexpr int kNear = 2, kFarther = 6;
constexpr std::size_t kLeafCubes = 16;

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

/// Built by the first thread that needs it.
struct NearestCube::Tree {
  CubeIndices indices;
  std::once_flag built;
  std::unique_ptr<KdTree> index;

  explicit Tree(std::span<const VoxelKey> cubes) : indices{cubes} {}
  [[nodiscard]] const KdTree& get() {
    std::call_once(built, [this] { index = std::make_unique<KdTree>(3, indices, kLeafCubes); });
    return *index;
  }
};

NearestCube::NearestCube(std::span<const VoxelKey> cubes, double edge_m)
    : cubes_(cubes),
      edge_m_(edge_m),
      tree_(std::make_shared<Tree>(cubes)),
      near_(cubes, kNear),
      farther_(cubes, kFarther) {}

void NearestCube::enter(const VoxelKey& voxel) {
  candidates_.clear();
  if (cubes_.empty()) return;
  if (voxel < entered_) {  // windows only move on
    near_ = VoxelWindow<VoxelKey>(cubes_, kNear);
    farther_ = VoxelWindow<VoxelKey>(cubes_, kFarther);
  }
  entered_ = voxel;
  if (!look_around(voxel, kNear, near_) && !look_around(voxel, kFarther, farther_)) {
    search_tree(voxel);
  }
  std::ranges::sort(candidates_, {}, &Candidate::least_squared);
}

/// True when that was enough. A cube out of reach has an offset of more than `reach` on some axis,
/// hence is at least `reach` from any point; the nearest one is at most its offset away.
bool NearestCube::look_around(const VoxelKey& voxel, int reach, VoxelWindow<VoxelKey>& around) {
  candidates_.clear();
  double nearest_squared = std::numeric_limits<double>::infinity();
  around.for_each_within_reach(voxel, [&](const VoxelKey& cube) {
    candidates_.emplace_back(cube, voxel);
    nearest_squared = std::min(nearest_squared, candidates_.back().offset.squaredNorm());
  });
  if (nearest_squared >= reach * reach) return false;
  keep_nearest(nearest_squared);
  return true;
}

void NearestCube::search_tree(const VoxelKey& voxel) {
  const Eigen::Vector3d here(voxel.i, voxel.j, voxel.k);
  WithinReach reach;
  tree_->get().radiusSearchCustomCallback(here.data(), reach);
  candidates_.clear();
  for (const std::uint32_t cube : reach.found()) candidates_.emplace_back(cubes_[cube], voxel);
  keep_nearest(reach.nearest_squared());
}

/// Of the candidates those that can be nearer than the nearest index vector.
void NearestCube::keep_nearest(double squared) {
  std::erase_if(candidates_, [=](const Candidate& c) { return c.least_squared > squared; });
}

NearestCube::Candidate::Candidate(const VoxelKey& cube, const VoxelKey& voxel)
    : offset(cube.i - voxel.i, cube.j - voxel.j, cube.k - voxel.k),
      least_squared((offset.array().abs() - 1.0).max(0.0).matrix().squaredNorm()) {}

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
