// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/voxelise.hpp"

#include "core/error.hpp"

#include <map>
#include <span>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

/// Blocks are kept by a wider margin than voxels, so that rounding never loses a voxel.
constexpr double kBlockMargin_m = 10 * kContact_m;
constexpr int kFinestCut = 3;  // 2^3 = 8 boxes along an edge, 512 in all
constexpr double kFarthestIndex = (1 << 20) - 2;

Eigen::Vector3i indices_of(const Vector3d& p_in_voxels) {
  const VoxelKey key = voxel_of(p_in_voxels, 1.0);
  return {key.i, key.j, key.k};
}

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

VoxelBlock block_around(const PreparedShape& piece, double edge_m, double epsilon_m) {
  const Box& bounds = piece.bounds();
  const Vector3d low = (bounds.min().array() - epsilon_m) / edge_m - 1.5;
  const Vector3d high = (bounds.max().array() + epsilon_m) / edge_m + 0.5;
  if (low.minCoeff() < -kFarthestIndex || high.maxCoeff() > kFarthestIndex) {
    throw Error("shape " + std::to_string(piece.shape()) + ": reaches beyond 2^20 voxels of " +
                std::to_string(edge_m) + " m from the map's origin; take larger voxels or cut it");
  }
  return {indices_of(low), indices_of(high)};
}

std::vector<Slab> slabs_of(const std::vector<PreparedShape>& pieces, double edge_m,
                           double epsilon_m) {
  std::map<std::int32_t, Slab> by_first_i;
  for (const PreparedShape& piece : pieces) {
    const VoxelBlock block = block_around(piece, edge_m, epsilon_m);
    for (int i = block.min().x() & -kSlabVoxels; i <= block.max().x(); i += kSlabVoxels) {
      Slab& slab = by_first_i[i];
      slab.first_i = i;
      slab.pieces.push_back(&piece);
      if (piece.solid()) slab.solids.push_back(&piece);
    }
  }
  std::vector<Slab> slabs;
  slabs.reserve(by_first_i.size());
  for (auto& [first_i, slab] : by_first_i) slabs.push_back(std::move(slab));
  return slabs;
}

void Voxeliser::voxelise(const PreparedShape& piece, const VoxelBlock& within,
                         std::span<const PreparedShape* const> solids,
                         std::vector<PieceVoxel>& voxels) {
  piece_ = &piece;
  voxels_ = &voxels;
  const VoxelBlock block = block_around(piece, edge_m_, epsilon_m_).intersection(within);
  if (block.isEmpty()) return;
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
  const Eigen::Vector3i span = block.sizes();
  int axis = 0;
  const bool one_voxel = span.maxCoeff(&axis) == 0;
  const Box box = box_of(block, epsilon_m_ + kBlockMargin_m);
  if (!one_voxel && !meets_surface(*piece_, box)) return;
  const std::size_t first = others_.size();
  const bool buried = push_others(box, first_other, first);
  if (buried) {
    // nothing of it stays
  } else if (one_voxel) {
    settle(block, first);
  } else {
    VoxelBlock lower = block, upper = block;
    lower.max()[axis] = block.min()[axis] + span[axis] / 2;
    upper.min()[axis] = lower.max()[axis] + 1;
    descend(lower, first);
    descend(upper, first);
  }
  others_.resize(first);
}

/// Decides one voxel.
void Voxeliser::settle(const VoxelBlock& voxel, std::size_t first_other) {
  const Box cube = box_of(voxel, epsilon_m_);
  if (!meets_surface(*piece_, cube)) return;
  const std::span others(others_.data() + first_other, others_.size() - first_other);
  if (!others.empty() && fate_of(cube, others) != Fate::exposed &&
      !any_stays(*piece_, cube, others, 1)) {
    return;
  }
  const bool meets = open_meets_surface(*piece_, box_of(voxel, 0));
  const Eigen::Vector3i& at = voxel.min();
  voxels_->push_back({{at.x(), at.y(), at.z()}, !meets});
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
  const Vector3d low = block.min().cast<double>(), past = block.max().cast<double>().array() + 1.0;
  return widened({low * edge_m_, past * edge_m_}, margin_m);
}

}  // namespace mapscore::eval
