// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/counts.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

namespace mapscore::eval {

/// Counts of one map, or of one frame's observation, against surface truth S and visible truth V on
/// the same lattice. For each class c, with P_c predicted at `threshold`:
///
/// - each voxel of P_c is true (in S_c) or false: near, leak or floating, the first that applies;
/// - each voxel of V_c is found (in P_c) or missed: mislabelled, unlabelled or unmapped;
/// - at tolerance t, voxels of P_c within t voxels of S_c count as true, and voxels of V_c within t
///   voxels of P_c as found (largest difference of an index).
///
/// Time is linear in the voxels of map and V. `class_count` is the size of the class table. Throws
/// Error when the options are not usable, the lattices of S and V differ, or the map has a class
/// that is not in the table. Thread-safe.
[[nodiscard]] Counts score_voxels(const MapSnapshot& map, double threshold,
                                  const SurfaceTruth& surface, const VisibleTruth& visible,
                                  std::size_t class_count, const ScoreOptions& options = {});

}  // namespace mapscore::eval
