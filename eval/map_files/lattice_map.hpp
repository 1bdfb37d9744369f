// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/pose.hpp"
#include "core/mapping/semantic_map.hpp"
#include "eval/map_files/map_file.hpp"

#include <cstdint>
#include <vector>

namespace mapscore::eval {

/// Whether voxels of another edge than the lattice's are brought onto it.
enum class Resample { refuse, allow };

/// How a map came onto the lattice: its voxels as they are, pulled or pushed, or its points binned.
enum class Placing { as_they_are, pulled, pushed, binned };

/// A foreign map on the lattice of the truth, ascending by key, each voxel once.
struct LatticeMap {
  std::vector<MapVoxel> voxels;
  std::vector<std::uint32_t> instances;  ///< one a voxel, 0: none; empty when the map has none
  Placing placing = Placing::as_they_are;
};

/// Brings a map onto the lattice of edge `edge_m` in frame map; `classes` has one class for each of
/// its elements. Points are binned: the class of most points wins, ties to the lower id, points
/// without a class count as background; probability: mean over the winning class's points;
/// instance: that of most of these, ties to the lower. Voxels of the lattice's edge (or of none
/// that the file tells) and an identity T_map_file stay as they are. Coarser ones, and equal ones
/// that move, are pulled: a target takes what the voxel holds in which its centre lies. Finer ones
/// are pushed: their centres vote as points do, occupied ones before free ones. Centres less than
/// 1e-9 m below a face between voxels count as on it, so that whole voxels move exactly. Throws
/// Error when edges differ and resampling is not allowed, for voxels beyond +-1000000, and for more
/// than 50 million voxels.
[[nodiscard]] LatticeMap on_lattice(const MapFile& map, const std::vector<ClassId>& classes,
                                    const Pose& T_map_file, double edge_m, Resample resample);

}  // namespace mapscore::eval
