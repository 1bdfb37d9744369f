// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

namespace mapscore {

/// Bounding box of the points; `finite` is false when some coordinate is not.
struct PointExtent {
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;
  bool finite = true;
};

/// Two points a step, since the processor then works on both at the same time.
[[nodiscard]] inline PointExtent extent_of(std::span<const Eigen::Vector3d> points) {
  constexpr std::size_t kLanes = 6;
  double low[kLanes], high[kLanes], zero[kLanes];
  const PointExtent empty;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    low[lane] = empty.low[static_cast<Eigen::Index>(lane % 3)];
    high[lane] = -low[lane];
    zero[lane] = 0.0;  // turns NaN with the first infinity or NaN
  }
  const auto add = [&](const double* p, std::size_t lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      low[lane] = p[lane] < low[lane] ? p[lane] : low[lane];
      high[lane] = p[lane] > high[lane] ? p[lane] : high[lane];
      zero[lane] += 0.0 * p[lane];
    }
  };
  for (std::size_t n = 0; n + 1 < points.size(); n += 2) add(points[n].data(), kLanes);
  if (points.size() % 2 == 1) add(points.back().data(), 3);
  PointExtent extent;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    extent.low[a] = std::min(low[axis], low[axis + 3]);
    extent.high[a] = std::max(high[axis], high[axis + 3]);
    extent.finite = extent.finite && zero[axis] == 0.0 && zero[axis + 3] == 0.0;
  }
  return extent;
}

}  // namespace mapscore
