// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/error.hpp"
#include "core/geometry/voxel.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <tuple>
#include <vector>

namespace mapscore::testing {

/// One point a voxel [R, section 3.4]: the indices, ascending, of the points nearest to the centres
/// of their voxels, ties to the lower index. Metres. Points that are not finite or beyond +-2^20
/// voxels are left out. Throws Error unless the edge is positive.
inline std::vector<std::size_t> voxel_filter(std::span<const Eigen::Vector3d> points,
                                             double edge_m) {
  if (!(edge_m > 0.0) || !std::isfinite(edge_m))
    throw Error("voxel_m: must be a positive length in metres");
  struct Candidate {
    std::uint64_t voxel;
    double distance;  ///< squared, from the voxel's centre
    std::size_t index;
  };
  constexpr double kMostVoxels = 1 << 20;
  std::vector<Candidate> candidates;
  candidates.reserve(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (!((points[n].array() / edge_m).abs() < kMostVoxels).all()) continue;
    const VoxelKey key = voxel_of(points[n], edge_m);
    candidates.push_back({pack(key), (points[n] - centre_of(key, edge_m)).squaredNorm(), n});
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.voxel, a.distance, a.index) < std::tie(b.voxel, b.distance, b.index);
  });
  std::vector<std::size_t> kept;
  for (std::size_t n = 0; n < candidates.size(); ++n)
    if (n == 0 || candidates[n].voxel != candidates[n - 1].voxel)
      kept.push_back(candidates[n].index);
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace mapscore::testing
