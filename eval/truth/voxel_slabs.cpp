// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/voxel_slabs.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

constexpr double kFarthestIndex = (1 << 20) - 2;

/// Which slab holds index i, counted from the one that begins at 0.
std::int32_t slab_number(std::int32_t i) {
  return i >= 0 ? i / kSlabVoxels : -1 - (-1 - i) / kSlabVoxels;
}

}  // namespace

VoxelBlock common(const VoxelBlock& a, const VoxelBlock& b) {
  return {
      {std::max(a.low.i, b.low.i), std::max(a.low.j, b.low.j), std::max(a.low.k, b.low.k)},
      {std::min(a.high.i, b.high.i), std::min(a.high.j, b.high.j), std::min(a.high.k, b.high.k)}};
}

bool empty(const VoxelBlock& block) {
  return block.low.i > block.high.i || block.low.j > block.high.j || block.low.k > block.high.k;
}

bool holds(const VoxelBlock& block, const VoxelKey& key) {
  return key.i >= block.low.i && key.i <= block.high.i && key.j >= block.low.j &&
         key.j <= block.high.j && key.k >= block.low.k && key.k <= block.high.k;
}

VoxelBlock block_around(const PreparedShape& piece, double edge_m, double epsilon_m) {
  const Box& bounds = piece.bounds();
  const Vector3d low = (bounds.min().array() - epsilon_m) / edge_m - 1.5;
  const Vector3d high = (bounds.max().array() + epsilon_m) / edge_m + 0.5;
  if (low.minCoeff() < -kFarthestIndex || high.maxCoeff() > kFarthestIndex) {
    throw Error("shape " + std::to_string(piece.shape()) + ": reaches beyond 2^20 voxels of " +
                std::to_string(edge_m) + " m from the map's origin; take larger voxels or cut it");
  }
  return {voxel_of(low, 1.0), voxel_of(high, 1.0)};
}

std::vector<Slab> slabs_of(const std::vector<PreparedShape>& pieces, double edge_m,
                           double epsilon_m) {
  std::map<std::int32_t, Slab> by_number;
  for (const PreparedShape& piece : pieces) {
    const VoxelBlock block = block_around(piece, edge_m, epsilon_m);
    for (std::int32_t n = slab_number(block.low.i); n <= slab_number(block.high.i); ++n) {
      Slab& slab = by_number[n];
      slab.first_i = n * kSlabVoxels;
      slab.pieces.push_back(&piece);
      if (piece.solid()) slab.solids.push_back(&piece);
    }
  }
  std::vector<Slab> slabs;
  slabs.reserve(by_number.size());
  for (auto& [number, slab] : by_number) slabs.push_back(std::move(slab));
  return slabs;
}

}  // namespace mapscore::eval
