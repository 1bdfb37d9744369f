// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <functional>
#include <optional>

namespace mapscore {

/// One voxel of a lattice of edge r anchored at the origin of its frame. Voxel (i, j, k) covers the
/// half-open cube [i r, (i+1) r) x [j r, (j+1) r) x [k r, (k+1) r); its position is its centre.
/// This is OctoMap's lattice. Ordered by i, then j, then k.
struct VoxelKey {
  std::int32_t i = 0, j = 0, k = 0;
  auto operator<=>(const VoxelKey&) const = default;
};

/// The voxel that holds a position: floor(x / r) on each axis. For finite positions within +-2^31
/// voxels.
[[nodiscard]] inline VoxelKey voxel_of(const Eigen::Vector3d& p, double edge_m) {
  // std::floor is a function call unless the processor is known to have SSE 4.1.
  const auto floor_of = [](double x) {
    const auto towards_zero = static_cast<std::int32_t>(x);
    return towards_zero - (towards_zero > x ? 1 : 0);
  };
  return {floor_of(p.x() / edge_m), floor_of(p.y() / edge_m), floor_of(p.z() / edge_m)};
}

/// Centre of a voxel in metres.
[[nodiscard]] inline Eigen::Vector3d centre_of(const VoxelKey& key, double edge_m) {
  return {(key.i + 0.5) * edge_m, (key.j + 0.5) * edge_m, (key.k + 0.5) * edge_m};
}

/// Low corner of a voxel in metres.
[[nodiscard]] inline Eigen::Vector3d low_corner_of(const VoxelKey& key, double edge_m) {
  return {key.i * edge_m, key.j * edge_m, key.k * edge_m};
}

/// Indices within +-2^20 packed into 63 bits, in the order of VoxelKey; for hashing and sorting.
[[nodiscard]] inline std::uint64_t pack(const VoxelKey& key) {
  constexpr std::int64_t kOffset = 1 << 20;
  return (static_cast<std::uint64_t>(key.i + kOffset) << 42) |
         (static_cast<std::uint64_t>(key.j + kOffset) << 21) |
         static_cast<std::uint64_t>(key.k + kOffset);
}
[[nodiscard]] inline VoxelKey unpack(std::uint64_t packed) {
  constexpr std::int32_t kOffset = 1 << 20;
  constexpr std::uint64_t kMask = (1u << 21) - 1;
  return {static_cast<std::int32_t>(packed >> 42 & kMask) - kOffset,
          static_cast<std::int32_t>(packed >> 21 & kMask) - kOffset,
          static_cast<std::int32_t>(packed & kMask) - kOffset};
}

/// voxel_of any position, to be packed: beyond +-2^20 voxels the last voxel on each axis; nothing
/// where a coordinate is not finite.
[[nodiscard]] inline std::optional<VoxelKey> packable_voxel_of(const Eigen::Vector3d& p,
                                                               double edge_m) {
  constexpr double kReach = 1 << 20;
  if ((p.array().abs() < (kReach - 1) * edge_m).all()) return voxel_of(p, edge_m);
  if (!p.allFinite()) return {};
  const auto index = [&](double x) {
    return static_cast<std::int32_t>(std::clamp(std::floor(x / edge_m), -kReach, kReach - 1));
  };
  return VoxelKey{index(p.x()), index(p.y()), index(p.z())};
}

/// Mixes all bits of a packed key (the finaliser of SplitMix64), so that power-of-two tables work.
[[nodiscard]] inline std::uint64_t mix_bits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace mapscore

template <>
struct std::hash<mapscore::VoxelKey> {
  std::size_t operator()(const mapscore::VoxelKey& key) const noexcept {
    return mapscore::mix_bits(mapscore::pack(key));
  }
};
