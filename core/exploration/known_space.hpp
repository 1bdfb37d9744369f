// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"
#include "core/mapping/semantic_map.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore {

/// What is known of a cube of space. The order is that of precedence where a cube holds several
/// voxels.
enum class Space : std::uint8_t { unknown, free, occupied, unsure, beyond };

/// Copy of a box of a carved map, a byte a cube, for very many reads: unknown, free, occupied, and
/// `unsure`: occupied by a surface whose class is uncertain. A cube is a voxel of the map, or of
/// voxels below 4 cm the smallest node of the octree that is not; it is occupied when a voxel in it
/// is, and free when one is free and none occupied. Occupied cubes with fewer than two occupied
/// ones among their 26 neighbours are specks of a depth camera's noise, and taken for free. Around
/// the box lies a layer `beyond`. Immutable, safe to share between threads.
class KnownSpace {
 public:
  /// `unsure_below`: the class of a voxel with beliefs is uncertain when its best probability is
  /// below. Throws Error for a map that does not carve and a box that is empty or not finite.
  KnownSpace(const SemanticMap& map, const Eigen::AlignedBox3d& box_m, double unsure_below);

  [[nodiscard]] double edge_m() const { return edge_m_; }
  /// Lowest cube of the box and the number of cubes on each axis.
  [[nodiscard]] const VoxelKey& low() const { return low_; }
  [[nodiscard]] const VoxelKey& size() const { return size_; }
  /// Whether the box or its layer holds the cube.
  [[nodiscard]] bool contains(const VoxelKey& key) const;
  /// The box or its layer must contain the cube.
  [[nodiscard]] std::ptrdiff_t place_of(const VoxelKey& key) const {
    return (key.i - low_.i + 1) * strides_[0] + (key.j - low_.j + 1) * strides_[1] +
           (key.k - low_.k + 1);
  }
  /// To the next cube along x, y, z.
  [[nodiscard]] const std::array<std::ptrdiff_t, 3>& strides() const { return strides_; }
  [[nodiscard]] Space at(std::ptrdiff_t place) const {
    return cubes_[static_cast<std::size_t>(place)];
  }
  /// Beyond the box where it holds no such cube.
  [[nodiscard]] Space at(const VoxelKey& key) const {
    return contains(key) ? at(place_of(key)) : Space::beyond;
  }

 private:
  void read(const SemanticOcTree& tree, const SemanticOcTreeNode* node, unsigned level,
            const VoxelKey& low);
  void free_specks();
  void fill(const SemanticOcTreeNode& leaf, bool occupied, const VoxelKey& low, std::int32_t span);

  double edge_m_, unsure_below_;
  unsigned level_ = 0;  ///< of the octree that a cube is a node of
  VoxelKey low_, size_;
  std::array<std::ptrdiff_t, 3> strides_{};
  std::vector<Space> cubes_;
};

}  // namespace mapscore
