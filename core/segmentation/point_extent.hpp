// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>

namespace mapscore {

/// Bounding box of the points; `finite` is false when some coordinate is not.
struct PointExtent {
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;
  bool finite = true;
};

[[nodiscard]] inline PointExtent extent_of(std::span<const Eigen::Vector3d> points) {
  PointExtent extent;
  Eigen::Array3d zero = Eigen::Array3d::Zero();  // turns NaN with the first infinity or NaN
  for (const Eigen::Vector3d& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      extent.low[axis] = p[axis] < extent.low[axis] ? p[axis] : extent.low[axis];
      extent.high[axis] = p[axis] > extent.high[axis] ? p[axis] : extent.high[axis];
      zero[axis] += 0.0 * p[axis];
    }
  }
  extent.finite = (zero == 0.0).all();
  return extent;
}

}  // namespace mapscore
