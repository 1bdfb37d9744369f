// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"
#include "eval/truth/shapes/shape_tests.hpp"
#include "eval/truth/voxel_slabs.hpp"

#include <span>
#include <vector>

namespace mapscore::eval {

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
  Voxeliser(double edge_m, double epsilon_m);

  /// Appends the voxels of `piece` in the slab that stay, each once, in no promised order.
  void voxelise(const PreparedShape& piece, const Slab& slab, std::vector<PieceVoxel>& voxels);

  /// The same for a block of voxels. `solids`: all that could meet one of them.
  void voxelise(const PreparedShape& piece, const VoxelBlock& within,
                std::span<const PreparedShape* const> solids, std::vector<PieceVoxel>& voxels);

 private:
  void descend(const VoxelBlock& block, std::size_t first_other);
  void settle(const VoxelKey& key, std::size_t first_other);
  bool push_others(const Box& box, std::size_t first, std::size_t last);
  Box box_of(const VoxelBlock& block, double margin_m) const;

  double edge_m_, epsilon_m_;
  const PreparedShape* piece_ = nullptr;
  std::vector<PieceVoxel>* voxels_ = nullptr;
  std::vector<const PreparedShape*> others_;  ///< a stack: a block's candidates from `first_other`
};

}  // namespace mapscore::eval
