// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace mapscore {

using Point3f = std::array<float, 3>;

/// Voxel traversal of a ray, bit for bit that of octomap::OcTreeBaseImpl::computeRayKeys (OctoMap
/// 1.9.7; after Amanatides and Woo, 1987): end points and direction in single precision, distances
/// along the ray summed in doubles; it also stops at the ray's length, should rounding make it miss
/// the last voxel.
class OctomapRay {
 public:
  /// From one point (metres) to another; their voxels are `first` and `last`.
  OctomapRay(const Point3f& from, const Point3f& to, const VoxelKey& first, const VoxelKey& last,
             double edge_m) {
    Point3f way;
    for (std::size_t n = 0; n < 3; ++n) way[n] = to[n] - from[n];
    const float squared = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
    length_ = static_cast<float>(std::sqrt(static_cast<double>(squared)));
    const std::array<std::int32_t, 3> cell{first.i, first.j, first.k};
    left_ = {last.i - first.i, last.j - first.j, last.k - first.k};
    for (std::size_t n = 0; n < 3; ++n) set_axis(n, from[n], way[n] / length_, cell[n], edge_m);
  }

  /// Calls mark(index) for every voxel of the ray from the first to the one before the last; for
  /// none if these are equal. `index`: of the first voxel in a dense array; `strides`: of the array
  /// along x, y, z.
  template <class Mark>
  void walk(std::ptrdiff_t index, const std::array<std::ptrdiff_t, 3>& strides, Mark&& mark) const {
    const std::ptrdiff_t end =
        index + left_[0] * strides[0] + left_[1] * strides[1] + left_[2] * strides[2];
    if (index == end) return;
    const std::array<std::ptrdiff_t, 3> move{step_[0] * strides[0], step_[1] * strides[1],
                                             step_[2] * strides[2]};
    double x = next_[0], y = next_[1], z = next_[2];
    const double length = length_;
    mark(index);
    for (;;) {
      const bool x_first = x < y && x < z;  // ties go to z before y before x
      const bool y_first = !(x < y) && y < z;
      const bool z_first = !x_first && !y_first;
      index += x_first ? move[0] : y_first ? move[1] : move[2];
      x += x_first ? delta_[0] : 0.0;
      y += y_first ? delta_[1] : 0.0;
      z += z_first ? delta_[2] : 0.0;
      if (index == end) return;
      const double least = x < y ? (x < z ? x : z) : (y < z ? y : z);
      if (least > length) return;
      mark(index);
    }
  }

 private:
  void set_axis(std::size_t n, float from, float direction, std::int32_t cell, double edge_m) {
    step_[n] = direction > 0.0f ? 1 : direction < 0.0f ? -1 : 0;
    next_[n] = delta_[n] = std::numeric_limits<double>::max();
    if (step_[n] == 0) return;
    double border = (cell + 0.5) * edge_m;
    border += static_cast<float>(step_[n] * edge_m * 0.5);
    next_[n] = (border - from) / direction;
    delta_[n] = edge_m / std::fabs(direction);
  }

  float length_ = 0.0f;
  std::array<std::int32_t, 3> left_{};
  std::array<std::ptrdiff_t, 3> step_{};
  std::array<double, 3> next_{}, delta_{};
};

}  // namespace mapscore
