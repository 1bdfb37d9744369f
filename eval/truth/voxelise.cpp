// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/voxelise.hpp"

#include <algorithm>
#include <span>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

/// Blocks are kept by a wider margin than voxels, so that rounding never loses a voxel.
constexpr double kBlockMargin_m = 10 * kContact_m;
constexpr int kFinestCut = 3;  // 2^3 = 8 boxes along an edge, 512 in all

enum class Fate { buried, exposed, undecided };

Fate fate_of(const Box& box, std::span<const PreparedShape* const> others) {
  bool met = false;
  for (const PreparedShape* other : others) {
    if (inside_open(*other, box)) return Fate::buried;
    met = met || meets_solid(*other, box);
  }
  return met ? Fate::undecided : Fate::exposed;
}

Box octant_of(const Box& box, int octant) {
  const Vector3d centre = box.center();
  const Vector3d corner = corner_of(box, octant);
  return {centre.cwiseMin(corner), centre.cwiseMax(corner)};
}

/// Cuts a box that others meet; true when a part of the piece's boundary in it is not buried.
bool any_stays(const PreparedShape& piece, const Box& box,
               std::span<const PreparedShape* const> others, int cut) {
  for (int octant = 0; octant < 8; ++octant) {
    const Box part = octant_of(box, octant);
    if (!meets_surface(piece, part)) continue;
    const Fate fate = fate_of(part, others);
    if (fate == Fate::buried) continue;
    if (fate == Fate::exposed || cut == kFinestCut) return true;
    if (any_stays(piece, part, others, cut + 1)) return true;
  }
  return false;
}

}  // namespace

Voxeliser::Voxeliser(double edge_m, double epsilon_m) : edge_m_(edge_m), epsilon_m_(epsilon_m) {}

void Voxeliser::voxelise(const PreparedShape& piece, const Slab& slab,
                         std::vector<PieceVoxel>& voxels) {
  VoxelBlock block = block_around(piece, edge_m_, epsilon_m_);
  block.low.i = slab.first_i;
  block.high.i = slab.first_i + kSlabVoxels - 1;
  voxelise(piece, block, slab.solids, voxels);
}

void Voxeliser::voxelise(const PreparedShape& piece, const VoxelBlock& within,
                         std::span<const PreparedShape* const> solids,
                         std::vector<PieceVoxel>& voxels) {
  piece_ = &piece;
  voxels_ = &voxels;
  const VoxelBlock block = common(block_around(piece, edge_m_, epsilon_m_), within);
  if (empty(block)) return;
  const Box box = box_of(block, epsilon_m_ + kBlockMargin_m);
  others_.clear();
  for (const PreparedShape* solid : solids) {
    if (solid->shape() != piece.shape() && solid->bounds().intersects(box)) {
      others_.push_back(solid);
    }
  }
  descend(block, 0);
}

void Voxeliser::descend(const VoxelBlock& block, std::size_t first_other) {
  const Eigen::Vector3i span{block.high.i - block.low.i, block.high.j - block.low.j,
                             block.high.k - block.low.k};
  int axis = 0;
  const bool one_voxel = span.maxCoeff(&axis) == 0;
  const Box box = box_of(block, epsilon_m_ + kBlockMargin_m);
  if (!one_voxel && !meets_surface(*piece_, box)) return;
  const std::size_t first = others_.size();
  const bool buried = push_others(box, first_other, first);
  if (buried) {
    // nothing of it stays
  } else if (one_voxel) {
    settle(block.low, first);
  } else {
    const auto index = [axis](VoxelKey& key) -> std::int32_t& {
      return axis == 0 ? key.i : axis == 1 ? key.j : key.k;
    };
    VoxelBlock lower = block, upper = block;
    index(lower.high) = index(lower.low) + span[axis] / 2;
    index(upper.low) = index(lower.high) + 1;
    descend(lower, first);
    descend(upper, first);
  }
  others_.resize(first);
}

/// Decides one voxel.
void Voxeliser::settle(const VoxelKey& key, std::size_t first_other) {
  const Box cube = box_of({key, key}, epsilon_m_);
  if (!meets_surface(*piece_, cube)) return;
  const std::span others(others_.data() + first_other, others_.size() - first_other);
  if (!others.empty() && fate_of(cube, others) != Fate::exposed &&
      !any_stays(*piece_, cube, others, 1)) {
    return;
  }
  const bool meets = open_meets_surface(*piece_, box_of({key, key}, 0));
  voxels_->push_back({key, !meets});
}

/// Pushes the candidates of [first, last) whose bounds meet the box; true when one of them holds
/// all of the box, which is then buried.
bool Voxeliser::push_others(const Box& box, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const PreparedShape* other = others_[i];
    if (!other->bounds().intersects(box)) continue;
    if (inside_open(*other, box)) return true;
    others_.push_back(other);
  }
  return false;
}

Box Voxeliser::box_of(const VoxelBlock& block, double margin_m) const {
  const VoxelKey past{block.high.i + 1, block.high.j + 1, block.high.k + 1};
  return widened({low_corner_of(block.low, edge_m_), low_corner_of(past, edge_m_)}, margin_m);
}

}  // namespace mapscore::eval
