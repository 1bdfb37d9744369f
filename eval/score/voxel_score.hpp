// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/confusion.hpp"
#include "eval/score/counts.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <cstddef>
#include <vector>

namespace mapscore::eval {

// What the voxels of one map, or of one frame's observation, are against surface truth S and
// visible truth V on the same lattice. `class_count` is the size of the class table. Time is linear
// in the voxels of map, S and V. Each throws Error when the map or V has a class that is not below
// `class_count`. Thread-safe.

/// Counts of the map. For each class c, with P_c predicted at `threshold`:
///
/// - each voxel of P_c is true (in S_c) or false: near, leak or floating, the first that applies;
/// - each voxel of V_c is found (in P_c) or missed: mislabelled, unlabelled or unmapped;
/// - at tolerance t, voxels of P_c within t voxels of S_c count as true, and voxels of V_c within t
///   voxels of P_c as found (largest difference of an index).
///
/// Throws Error also when the options are not usable or the lattices of S and V differ.
[[nodiscard]] Counts score_voxels(const MapSnapshot& map, double threshold,
                                  const SurfaceTruth& surface, const VisibleTruth& visible,
                                  std::size_t class_count, const ScoreOptions& options = {});

/// Curves by class id. Occupied voxels with a class count, whatever their probability.
[[nodiscard]] std::vector<ClassCurve> curves_of(const MapSnapshot& map, const SurfaceTruth& surface,
                                                const VisibleTruth& visible,
                                                std::size_t class_count);

/// Columns of a voxel confusion matrix behind the classes: class_count + kUnlabelled, ...
inline constexpr std::size_t kUnlabelled = 0;  ///< in the map, nothing predicted
inline constexpr std::size_t kUnmapped = 1;    ///< not in the map
inline constexpr std::size_t kVoxelAnswers = 2;

/// Where the voxels of V went, and what was predicted where nothing is: every voxel of V_t counts
/// in row t, at the class predicted there or at kUnlabelled or kUnmapped; a predicted voxel of
/// class p outside S_p and in no V counts in row background, column p. Column background stays
/// empty, since it is never predicted. Throws Error also when the lattices of S and V differ.
[[nodiscard]] ConfusionMatrix confusion_of(const MapSnapshot& map, double threshold,
                                           const SurfaceTruth& surface, const VisibleTruth& visible,
                                           std::size_t class_count);

}  // namespace mapscore::eval
