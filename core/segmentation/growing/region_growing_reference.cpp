// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/growing/region_growing.hpp"

#include <nanoflann.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <unordered_set>
#include <utility>

namespace mapscore {
namespace {

/// The finite points, in the precision that distances are compared in; nanoflann's view of a cloud.
template <class Scalar>
struct Cloud {
  std::vector<std::array<Scalar, 3>> points;
  std::vector<int> indices;  ///< in the caller's order

  explicit Cloud(std::span<const Eigen::Vector3d> all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i].allFinite()) continue;
      points.push_back({static_cast<Scalar>(all[i].x()), static_cast<Scalar>(all[i].y()),
                        static_cast<Scalar>(all[i].z())});
      indices.push_back(static_cast<int>(i));
    }
  }
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] Scalar kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][axis];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

template <class Scalar>
Region grow(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& seed, double pitch_m,
            double factor) {
  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<Scalar, Cloud<Scalar>>,
                                          Cloud<Scalar>, 3>;
  const Cloud<Scalar> cloud(points);
  Region region;
  if (cloud.points.empty()) return region;
  Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  tree.buildIndex();
  const double radius_m = factor * pitch_m;
  const auto radius_squared = static_cast<Scalar>(radius_m * radius_m);
  // The tree adds up its bounds in another order than the distance, so that its pruning may cost a
  // point within the last bits of the radius (seen with leaves of one point): search a little
  // wider, then test as defined.
  const Scalar search_squared =
      radius_squared * (1 + 1024 * std::numeric_limits<Scalar>::epsilon());

  std::unordered_set<VoxelKey> tried{{0, 0, 0}};
  std::deque<VoxelKey> queue{{0, 0, 0}};
  std::unordered_set<int> kept;
  std::vector<std::pair<std::uint32_t, Scalar>> found;
  const nanoflann::SearchParams kUnsorted(0, 0.0F, false);
  for (; !queue.empty(); queue.pop_front()) {
    const VoxelKey key = queue.front();
    const Eigen::Vector3d position = lattice_position(seed, pitch_m, key);
    const std::array<Scalar, 3> query{static_cast<Scalar>(position.x()),
                                      static_cast<Scalar>(position.y()),
                                      static_cast<Scalar>(position.z())};
    tree.radiusSearch(query.data(), search_squared, found, kUnsorted);
    std::erase_if(found, [&](const auto& match) { return !(match.second < radius_squared); });
    if (found.empty()) continue;
    region.positions.push_back(key);
    for (const auto& [point, distance] : found) kept.insert(cloud.indices[point]);
    for (int di = -1; di <= 1; ++di)
      for (int dj = -1; dj <= 1; ++dj)
        for (int dk = -1; dk <= 1; ++dk)
          if (const VoxelKey next{key.i + di, key.j + dj, key.k + dk}; tried.insert(next).second)
            queue.push_back(next);
  }
  std::sort(region.positions.begin(), region.positions.end());
  region.points.assign(kept.begin(), kept.end());
  std::sort(region.points.begin(), region.points.end());
  return region;
}

}  // namespace

Region grow_region_reference(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& seed,
                             double pitch_m, double factor, bool released) {
  return released ? grow<float>(points, seed, pitch_m, factor)
                  : grow<double>(points, seed, pitch_m, factor);
}

}  // namespace mapscore
