// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/rivals/dbscan.hpp"

#include "core/segmentation/direct.hpp"
#include "core/segmentation/rivals/point_cells.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace mapscore {
namespace {

/// A smaller cluster is none (pcd_denoise_dbscan of ConceptGraphs).
constexpr int kLeastCluster = 5;

/// The pairs of points within a radius of each other, found by bins of that edge.
class NearPairs {
 public:
  NearPairs(std::span<const Eigen::Vector3d> points, double radius_m)
      : points_(points),
        radius2_(radius_m * radius_m),
        bins_(points, radius_m * (1 + 1e-9)),  // rounding cannot part a pair by two bins
        first_(bins_.count() + 1),
        members_(points.size()) {
    for (std::size_t bin = 0; bin < bins_.count(); ++bin)
      first_[bin + 1] = first_[bin] + static_cast<std::size_t>(bins_.sizes()[bin]);
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t n = 0; n < points.size(); ++n)
      members_[next[static_cast<std::size_t>(bins_.cell_of()[n])]++] = n;
  }

  /// Calls act(a, b) once for each pair of different points.
  void for_each(const auto& act) const {
    for (std::size_t bin = 0; bin < bins_.count(); ++bin) {
      for (std::size_t m = first_[bin]; m < first_[bin + 1]; ++m)
        pair_with(members_[m], m + 1, first_[bin + 1], act);
      const VoxelKey key = bins_.key(static_cast<int>(bin));
      for (const VoxelKey& step : kForward) {
        const int other = bins_.at({key.i + step.i, key.j + step.j, key.k + step.k});
        if (other == PointCells::kNone) continue;
        const auto near = static_cast<std::size_t>(other);
        for (std::size_t m = first_[bin]; m < first_[bin + 1]; ++m)
          pair_with(members_[m], first_[near], first_[near + 1], act);
      }
    }
  }

 private:
  /// Half of the 26 neighbours, so that each pair of bins comes once.
  static constexpr std::array<VoxelKey, 13> kForward{{{0, 0, 1},
                                                      {0, 1, -1},
                                                      {0, 1, 0},
                                                      {0, 1, 1},
                                                      {1, -1, -1},
                                                      {1, -1, 0},
                                                      {1, -1, 1},
                                                      {1, 0, -1},
                                                      {1, 0, 0},
                                                      {1, 0, 1},
                                                      {1, 1, -1},
                                                      {1, 1, 0},
                                                      {1, 1, 1}}};

  void pair_with(std::size_t a, std::size_t from, std::size_t to, const auto& act) const {
    for (std::size_t m = from; m < to; ++m)
      if ((points_[a] - points_[members_[m]]).squaredNorm() <= radius2_) act(a, members_[m]);
  }

  std::span<const Eigen::Vector3d> points_;
  double radius2_;
  PointCells bins_;
  std::vector<std::size_t> first_;  ///< of each bin in members_, and the end
  std::vector<std::size_t> members_;
};

/// Disjoint sets, each known by its least member.
class LeastRoots {
 public:
  explicit LeastRoots(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  [[nodiscard]] std::size_t root(std::size_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  void unite(std::size_t a, std::size_t b) {
    const std::size_t of_a = root(a), of_b = root(b);
    parent_[std::max(of_a, of_b)] = std::min(of_a, of_b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Mean of the points of each cell.
std::vector<Eigen::Vector3d> means_of(std::span<const Eigen::Vector3d> points,
                                      const PointCells& cells) {
  std::vector<Eigen::Vector3d> means(cells.count(), Eigen::Vector3d::Zero());
  for (std::size_t n = 0; n < points.size(); ++n)
    means[static_cast<std::size_t>(cells.cell_of()[n])] += points[n];
  for (std::size_t cell = 0; cell < means.size(); ++cell) means[cell] /= cells.sizes()[cell];
  return means;
}

/// The number of the largest cluster, the first of equal ones; kNoCluster where none is large
/// enough.
int largest_of(const std::vector<int>& clusters) {
  std::vector<int> sizes;
  for (const int cluster : clusters) {
    if (cluster == kNoCluster) continue;
    const auto number = static_cast<std::size_t>(cluster);
    if (number >= sizes.size()) sizes.resize(number + 1, 0);
    ++sizes[number];
  }
  const auto largest = std::ranges::max_element(sizes);
  if (largest == sizes.end() || *largest < kLeastCluster) return kNoCluster;
  return static_cast<int>(largest - sizes.begin());
}

}  // namespace

std::vector<int> dbscan_clusters(std::span<const Eigen::Vector3d> points, double eps_m,
                                 int min_points) {
  constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();
  const NearPairs pairs(points, eps_m);
  std::vector<int> neighbours(points.size(), 1);
  pairs.for_each([&](std::size_t a, std::size_t b) { ++neighbours[a], ++neighbours[b]; });
  const auto is_core = [&](std::size_t n) { return neighbours[n] >= min_points; };
  LeastRoots sets(points.size());
  pairs.for_each([&](std::size_t a, std::size_t b) {
    if (is_core(a) && is_core(b)) sets.unite(a, b);
  });
  std::vector<std::size_t> joined(points.size(), kNobody);  // the root of each point's cluster
  for (std::size_t n = 0; n < points.size(); ++n)
    if (is_core(n)) joined[n] = sets.root(n);
  pairs.for_each([&](std::size_t a, std::size_t b) {
    if (is_core(a) == is_core(b)) return;
    const auto [core, border] = is_core(a) ? std::pair(a, b) : std::pair(b, a);
    joined[border] = std::min(joined[border], joined[core]);
  });
  std::vector<int> number(points.size(), kNoCluster), clusters(points.size(), kNoCluster);
  int count = 0;
  for (std::size_t n = 0; n < points.size(); ++n)
    if (joined[n] == n) number[n] = count++;
  for (std::size_t n = 0; n < points.size(); ++n)
    if (joined[n] != kNobody) clusters[n] = number[joined[n]];
  return clusters;
}

Segment Dbscan::segment(const Detection& detection, const RegisteredCloud& cloud, double voxel_m,
                        bool with_voxels) const {
  std::vector<Eigen::Vector3d> points = points_behind(detection.mask, detection.box, cloud);
  const PointCells cells(points, cell_m);
  const std::vector<int> clusters = dbscan_clusters(means_of(points, cells), eps_m, min_points);
  const int largest = largest_of(clusters);
  if (largest == kNoCluster) return segment_of(std::move(points), voxel_m, with_voxels);
  std::vector<Eigen::Vector3d> kept;
  kept.reserve(points.size());
  for (std::size_t n = 0; n < points.size(); ++n)
    if (clusters[static_cast<std::size_t>(cells.cell_of()[n])] == largest)
      kept.push_back(points[n]);
  return segment_of(std::move(kept), voxel_m, with_voxels);
}

}  // namespace mapscore
