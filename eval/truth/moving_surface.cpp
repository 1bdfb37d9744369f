// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/moving_surface.hpp"

#include "eval/truth/voxelise.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

namespace mapscore::eval {
namespace {

/// Of equal pairs of voxel and class the one that truly meets comes first.
bool before(const SurfaceVoxel& a, const SurfaceVoxel& b) {
  if (a.key != b.key) return a.key < b.key;
  return std::tie(a.class_id, a.touch_only) < std::tie(b.class_id, b.touch_only);
}

bool same_pair(const SurfaceVoxel& a, const SurfaceVoxel& b) {
  return a.key == b.key && a.class_id == b.class_id;
}

/// Pieces of shapes that follow `first` others.
std::vector<PreparedShape> numbered_from(int first, const std::vector<PreparedShape>& pieces) {
  std::vector<PreparedShape> numbered;
  numbered.reserve(pieces.size());
  for (const PreparedShape& piece : pieces)
    numbered.emplace_back(piece.form(), piece.solid(), first + piece.shape(), piece.instance());
  return numbered;
}

VoxelBlock spanning(const VoxelBlock& a, const VoxelBlock& b) {
  return {
      {std::min(a.low.i, b.low.i), std::min(a.low.j, b.low.j), std::min(a.low.k, b.low.k)},
      {std::max(a.high.i, b.high.i), std::max(a.high.j, b.high.j), std::max(a.high.k, b.high.k)}};
}

constexpr VoxelBlock kNoVoxels{{0, 0, 0}, {-1, -1, -1}};

}  // namespace

MovingSurface::MovingSurface(const std::vector<Shape>& fixed, const ClassTable& table,
                             const Pose& T_map_world, const SurfaceOptions& options)
    : table_(table),
      T_map_world_(T_map_world),
      options_(options),
      fixed_shapes_(static_cast<int>(fixed.size())),
      pieces_(prepare(fixed, T_map_world)),
      surface_(surface_truth(fixed, table, T_map_world, options)) {}

bool MovingSurface::Zone::holds(const VoxelKey& key) const {
  return eval::holds(around, key) &&
         std::any_of(blocks.begin(), blocks.end(),
                     [&key](const VoxelBlock& block) { return eval::holds(block, key); });
}

MovingSurface::Zone MovingSurface::zone_of(const std::vector<PreparedShape>& moving) const {
  Zone zone{{}, kNoVoxels};
  for (const PreparedShape& piece : moving) {
    if (!piece.solid()) continue;
    const VoxelBlock block = block_around(piece, options_.edge_m, options_.epsilon_m);
    zone.around = zone.blocks.empty() ? block : spanning(zone.around, block);
    zone.blocks.push_back(block);
  }
  return zone;
}

/// Rows of the moving pieces, and those of the fixed ones in the zone.
std::vector<SurfaceVoxel> MovingSurface::made_anew(const std::vector<PreparedShape>& moving,
                                                   const Zone& zone) const {
  std::vector<const PreparedShape*> solids;
  for (const auto* pieces : {&pieces_, &moving})
    for (const PreparedShape& piece : *pieces)
      if (piece.solid()) solids.push_back(&piece);
  Voxeliser voxeliser(options_.edge_m, options_.epsilon_m);
  std::vector<PieceVoxel> voxels;
  std::vector<SurfaceVoxel> rows;
  const auto add = [&](const PreparedShape& piece, const VoxelBlock& within) {
    voxels.clear();
    voxeliser.voxelise(piece, within, solids, voxels);
    const ClassId class_id = table_.class_of(piece.instance());
    for (const PieceVoxel& voxel : voxels) rows.push_back({voxel.key, class_id, voxel.touch_only});
  };
  for (const PreparedShape& piece : moving)
    add(piece, block_around(piece, options_.edge_m, options_.epsilon_m));
  for (const PreparedShape& piece : pieces_) {
    const VoxelBlock block = block_around(piece, options_.edge_m, options_.epsilon_m);
    if (empty(common(block, zone.around))) continue;
    for (const VoxelBlock& near : zone.blocks)
      if (!empty(common(block, near))) add(piece, near);
  }
  std::sort(rows.begin(), rows.end(), before);
  rows.erase(std::unique(rows.begin(), rows.end(), same_pair), rows.end());
  return rows;
}

SurfaceTruth MovingSurface::at(const std::vector<Shape>& moving) const {
  const std::vector<PreparedShape> pieces =
      numbered_from(fixed_shapes_, prepare(moving, T_map_world_));
  const Zone zone = zone_of(pieces);
  const std::vector<SurfaceVoxel> anew = made_anew(pieces, zone);
  std::vector<SurfaceVoxel> kept, rows;
  kept.reserve(surface_.voxels().size());
  std::copy_if(surface_.voxels().begin(), surface_.voxels().end(), std::back_inserter(kept),
               [&zone](const SurfaceVoxel& row) { return !zone.holds(row.key); });
  rows.reserve(kept.size() + anew.size());
  std::merge(kept.begin(), kept.end(), anew.begin(), anew.end(), std::back_inserter(rows), before);
  rows.erase(std::unique(rows.begin(), rows.end(), same_pair), rows.end());
  return {std::move(rows), options_.edge_m};
}

}  // namespace mapscore::eval
