// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace mapscore {

/// The packed voxels of many points, p -> pack(voxel_of(R p + t, edge)), each row of R p summed
/// from left to right. Without branches: take a copy before a loop, so that the compiler knows that
/// nothing changes it, and the loop becomes wide vectors.
class VoxelPacker {
 public:
  /// In place of a packed voxel.
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};

  VoxelPacker(const Pose& T, double edge_m) : edge_m_(edge_m) {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) rows_[row][column] = T(row, column);
  }

  /// kNone where a coordinate of R p + t is not finite, or more than 2^20 - 1 edges from zero.
  [[gnu::always_inline]] [[nodiscard]] std::uint64_t operator()(double x, double y,
                                                                double z) const {
    const double reach_m = ((1 << 20) - 1) * edge_m_;
    std::uint64_t packed = 0, beyond = 0;
    for (const auto& row : rows_) {
      const double moved = row[0] * x + row[1] * y + row[2] * z + row[3];
      double clamped = moved > -reach_m ? moved : -reach_m;  // NaN too
      clamped = clamped < reach_m ? clamped : reach_m;
      beyond |= static_cast<std::uint64_t>(clamped != moved);
      const double a = clamped / edge_m_;
      const auto truncated = static_cast<std::int32_t>(a);
      const std::int32_t index = truncated - (a < truncated ? 1 : 0) + (1 << 20);
      packed = packed << 21 | static_cast<std::uint64_t>(index);
    }
    return packed | (std::uint64_t{0} - beyond);
  }

 private:
  std::array<std::array<double, 4>, 3> rows_{};
  double edge_m_;
};

}  // namespace mapscore
