// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/core/geometry/voxel_ray.hpp"

#include "core/error.hpp"

#include <array>
#include <cmath>
#include <cstdint>

namespace mapscore {
namespace {

/// Products of two lengths along an axis take up to 107 bits.
__extension__ using Wide = __int128;

constexpr int kFractionBits = 32;
constexpr double kMostVoxels = 1 << 20;

std::int64_t fixed_point(double coordinate_m, double edge_m) {
  const double voxels = coordinate_m / edge_m;
  if (!(std::abs(voxels) < kMostVoxels))
    throw Error("segment: its ends must be finite and within 2^20 voxels of the origin");
  return static_cast<std::int64_t>(std::floor(std::ldexp(voxels, kFractionBits)));
}

/// The planes between voxels that the segment crosses on one axis. The next one is reached at the
/// share `distance / length` of the way.
struct Axis {
  std::int32_t cell = 0;
  std::int32_t step = 0;      ///< 1, -1, or 0 where no plane is crossed
  std::int32_t left = 0;      ///< planes still to be crossed
  std::int64_t distance = 0;  ///< from the start to the next plane
  std::int64_t length = 0;    ///< of the segment on this axis

  Axis(std::int64_t from, std::int64_t to)
      : cell(static_cast<std::int32_t>(from >> kFractionBits)),
        left(static_cast<std::int32_t>(to >> kFractionBits) - cell) {
    const std::int64_t low = static_cast<std::int64_t>(cell) << kFractionBits;
    step = left > 0 ? 1 : left < 0 ? -1 : 0;
    left *= step;
    length = to > from ? to - from : from - to;
    distance = step > 0 ? low + (std::int64_t{1} << kFractionBits) - from : from - low;
  }

  void cross() {
    cell += step;
    --left;
    distance += std::int64_t{1} << kFractionBits;
  }
};

/// Whether a's next plane is reached before b's.
bool before(const Axis& a, const Axis& b) {
  return static_cast<Wide>(a.distance) * b.length < static_cast<Wide>(b.distance) * a.length;
}

}  // namespace

std::vector<VoxelKey> voxels_on_segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                        double edge_m) {
  if (!(edge_m > 0.0)) throw Error("voxel_m: must be a positive length in metres");
  const auto axis = [&](int n) {
    return Axis(fixed_point(from[n], edge_m), fixed_point(to[n], edge_m));
  };
  std::array<Axis, 3> axes{axis(0), axis(1), axis(2)};
  std::vector<VoxelKey> voxels;
  const auto visit = [&] { voxels.push_back({axes[0].cell, axes[1].cell, axes[2].cell}); };
  visit();
  for (;;) {
    const Axis* next = nullptr;
    for (const Axis& candidate : axes)
      if (candidate.left > 0 && (next == nullptr || before(candidate, *next))) next = &candidate;
    if (next == nullptr) return voxels;
    const Axis first = *next;
    // A plane belongs to the voxel above it: going up it is crossed on arrival, going down after.
    for (const int direction : {1, -1}) {
      bool crossed = false;
      for (Axis& candidate : axes) {
        if (candidate.left == 0 || candidate.step != direction || before(first, candidate))
          continue;
        candidate.cross();
        crossed = true;
      }
      if (crossed) visit();
    }
  }
}

}  // namespace mapscore
