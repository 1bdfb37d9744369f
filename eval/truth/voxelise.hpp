// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"
#include "eval/truth/shapes/shape_tests.hpp"

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

namespace mapscore::eval {

/// A box of voxels by their indices, both corners included.
using VoxelBlock = Eigen::AlignedBox3i;

/// All voxels whose closed cube, widened by `epsilon_m`, could meet the piece. Throws Error when it
/// reaches beyond 2^20 voxels from the origin.
[[nodiscard]] VoxelBlock block_around(const PreparedShape& piece, double edge_m, double epsilon_m);

/// Thin enough to keep threads even and the slab in the processor's cache.
inline constexpr std::int32_t kSlabVoxels = 8;

/// The voxels with first_i <= i < first_i + kSlabVoxels, as a unit of work, and the pieces that
/// could meet one of them. A truth's rows are sorted by i first, so slabs can be voxelised, sorted
/// and packed one by one; appended in order, their rows are sorted as a whole.
struct Slab {
  std::int32_t first_i = 0;
  std::vector<const PreparedShape*> pieces;  ///< in their order
  std::vector<const PreparedShape*> solids;  ///< those of them that have an inside

  [[nodiscard]] VoxelBlock block() const {
    constexpr int kBeyond = 1 << 20;
    return {Eigen::Vector3i(first_i, -kBeyond, -kBeyond),
            Eigen::Vector3i(first_i + kSlabVoxels - 1, kBeyond, kBeyond)};
  }
};

/// The slabs that hold something, by rising i. Keeps pointers to `pieces`. Throws as block_around.
[[nodiscard]] std::vector<Slab> slabs_of(const std::vector<PreparedShape>& pieces, double edge_m,
                                         double epsilon_m);

/// A voxel of one piece's surface; `touch_only` when its open, unwidened cube misses the piece.
struct PieceVoxel {
  VoxelKey key;
  bool touch_only = false;
};

/// Finds the voxels of one piece after the other. A block of voxels is halved as long as its
/// widened box meets the surface and does not lie inside one other solid, so time and memory follow
/// the surface.
///
/// Buried rule: the widened cube is cut into 8, 64, 512 boxes. A box that the piece's boundary
/// meets is buried when it lies in the open interior of ONE other solid, exposed when it meets no
/// other closed solid, else undecided. The voxel stays when a box is exposed, or undecided among
/// the 512. Other means any other shape, also of the same body. A mesh is treated triangle by
/// triangle: a voxel stays when it stays for one of them, which is the same thing.
///
/// Holds scratch memory: one per thread.
class Voxeliser {
 public:
  Voxeliser(double edge_m, double epsilon_m) : edge_m_(edge_m), epsilon_m_(epsilon_m) {}

  /// Appends the voxels of `piece` in the block that stay, each once, in no promised order.
  /// `solids`: all that could meet one of the block.
  void voxelise(const PreparedShape& piece, const VoxelBlock& within,
                std::span<const PreparedShape* const> solids, std::vector<PieceVoxel>& voxels);

 private:
  void descend(const VoxelBlock& block, std::size_t first_other);
  void settle(const VoxelBlock& voxel, std::size_t first_other);
  bool push_others(const Box& box, std::size_t first, std::size_t last);
  Box box_of(const VoxelBlock& block, double margin_m) const;

  double edge_m_, epsilon_m_;
  const PreparedShape* piece_ = nullptr;
  std::vector<PieceVoxel>* voxels_ = nullptr;
  std::vector<const PreparedShape*> others_;  ///< a stack: a block's candidates from `first_other`
};

}  // namespace mapscore::eval
