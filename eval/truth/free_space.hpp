// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/frame.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/pose.hpp"
#include "core/geometry/voxel.hpp"
#include "eval/truth/surface_truth.hpp"

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace mapscore::eval {

/// Voxels that no surface touches and whose centre some frame saw through. With c the centre in the
/// map and (R, t) = T_map_base * T_base_depth,
///
///   (x, y, z) = R^T (c - t),  each row summed from left to right, without fused multiply-add,
///   u = floor(fx * x / z + cx + 0.5),  v = floor(fy * y / z + cy + 0.5),  from left to right,
///
/// all in doubles, a frame does so when range_min <= z <= range_max, the pixel (u, v) lies in the
/// depth image, its value is not 0, and z <= value / 5000.0. The voxels do not depend on the order
/// of frames or merges. Blocks of voxels outside the view, or behind all that is seen there, are
/// passed over as a whole, and no voxel is looked at again once it is known. Not thread-safe: one
/// per thread, merged at the end.
class FreeSpace {
 public:
  explicit FreeSpace(const SurfaceTruth& surface);

  [[nodiscard]] double edge_m() const { return edge_m_; }
  /// Adds what one frame saw through; reads `depth`. Throws Error naming the frame when the image
  /// has another size than the camera, the pose is not finite, or the view does not fit into 2^20
  /// voxels.
  void add(const Frame& frame, const Calibration& true_calibration, const Pose& T_map_base);
  /// Adds the voxels of another free space of the same surface; throws Error when the edges differ.
  void merge(const FreeSpace& other);

  /// All free voxels, ascending.
  [[nodiscard]] std::vector<VoxelKey> voxels() const;

 private:
  static constexpr int kBlockEdge = 8;
  /// One bit a voxel of a block of 8 x 8 x 8: word by i, bit 8 j + k.
  struct Block {
    std::array<std::uint64_t, kBlockEdge> settled{};  ///< on a surface, or free
    std::array<std::uint64_t, kBlockEdge> free{};
  };
  class View;

  void look(const View& view, const VoxelKey& block);

  double edge_m_;
  std::unordered_map<VoxelKey, Block> blocks_;  ///< by the key of the block
};

}  // namespace mapscore::eval
