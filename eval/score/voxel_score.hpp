// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/counts.hpp"
#include "eval/score/prediction.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

namespace mapscore::eval {

/// Counts of one map, or of one frame's observation, against surface truth S and visible truth V on
/// the same lattice. For each class c, with P_c predicted at `threshold`:
///
/// - every voxel of P_c is true (in S_c) or false by the first cause that applies: near, leak,
/// floating;
/// - every voxel of V_c is found (in P_c) or missed by its cause: mislabelled, unlabelled,
/// unmapped;
/// - at tolerance t, P_c counts as true within t voxels of S_c and V_c as found within t voxels of
/// P_c,
///   distances by the largest axis.
///
/// Time is linear in the voxels of map and V. `class_count` is the size of the class table. Throws
/// Error when the options are not usable, the lattices of S and V differ, or the map has a class
/// that the table has not. Thread-safe.
[[nodiscard]] Counts score_voxels(const MapSnapshot& map, double threshold,
                                  const SurfaceTruth& surface, const VisibleTruth& visible,
                                  std::size_t class_count, const ScoreOptions& options = {});

}  // namespace mapscore::eval
