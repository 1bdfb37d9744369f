// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/moving_surface.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

namespace mapscore::eval {
namespace {

/// Of equal pairs of voxel and class the one that truly meets comes first.
bool before(const SurfaceVoxel& a, const SurfaceVoxel& b) {
  return std::tie(a.key, a.class_id, a.touch_only) < std::tie(b.key, b.class_id, b.touch_only);
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

}  // namespace

MovingSurface::MovingSurface(const std::vector<Shape>& fixed, const ClassTable& table,
                             const Pose& T_map_world, const SurfaceOptions& options)
    : table_(table),
      T_map_world_(T_map_world),
      options_(options),
      fixed_shapes_(static_cast<int>(fixed.size())),
      pieces_(prepare(fixed, T_map_world)),
      surface_(surface_truth(fixed, table, T_map_world, options)) {}

MovingSurface::Zone MovingSurface::zone_of(const std::vector<PreparedShape>& moving) const {
  Zone zone;
  for (const PreparedShape& piece : moving) {
    if (!piece.solid()) continue;
    zone.blocks.push_back(block_around(piece, options_.edge_m, options_.epsilon_m));
    zone.around.extend(zone.blocks.back());
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
    if (!block.intersects(zone.around)) continue;
    for (const VoxelBlock& near : zone.blocks)
      if (block.intersects(near)) add(piece, near);
  }
  std::sort(rows.begin(), rows.end(), before);
  return rows;
}

SurfaceTruth MovingSurface::at(const std::vector<Shape>& moving) const {
  const std::vector<PreparedShape> pieces =
      numbered_from(fixed_shapes_, prepare(moving, T_map_world_));
  const Zone zone = zone_of(pieces);
  const std::vector<SurfaceVoxel> anew = made_anew(pieces, zone);
  std::vector<SurfaceVoxel> kept, rows;
  kept.reserve(surface_.voxels().size());
  for (const SurfaceVoxel& row : surface_.voxels()) {
    const Eigen::Vector3i at(row.key.i, row.key.j, row.key.k);
    const auto holds = [&at](const VoxelBlock& block) { return block.contains(at); };
    if (!holds(zone.around) || std::ranges::none_of(zone.blocks, holds)) kept.push_back(row);
  }
  rows.reserve(kept.size() + anew.size());
  std::merge(kept.begin(), kept.end(), anew.begin(), anew.end(), std::back_inserter(rows), before);
  rows.erase(std::unique(rows.begin(), rows.end(), same_pair), rows.end());
  return {std::move(rows), options_.edge_m};
}

}  // namespace mapscore::eval
