// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/score/instances/instance_pieces.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <cstdint>
#include <vector>

namespace mapscore::eval {

/// A predicted and a true instance of one class that share visible voxels. Their IoU is the exact
/// fraction hits / whole, with hits = |p in V_i| and whole = |V_i| + |p outside S_i|.
struct InstancePair {
  std::uint32_t prediction = 0;  ///< index into PredictedInstances::instances
  InstanceId instance = 0;
  std::int64_t hits = 0, whole = 0;
};

/// How the predicted instances lie on the true ones.
struct InstanceOverlap {
  std::vector<InstancePair> pairs;    ///< by prediction, then instance
  std::vector<bool> is_void;          ///< by prediction: shows what was never seen; counts nowhere
  std::vector<std::int64_t> visible;  ///< |V_i| by instance id
};

/// Overlaps of one class each; `surface` and `visible` hold instances as classes
/// (instance_table(table)), on the lattice of the prediction. Linear in the voxels. Throws Error
/// when an instance or a class is not in the table, or the lattices of the truths differ.
[[nodiscard]] InstanceOverlap overlap_of(const PredictedInstances& predicted,
                                         const SurfaceTruth& surface, const VisibleTruth& visible,
                                         const ClassTable& table);

/// Indices of the pairs with an IoU above 1/2, taken by falling IoU (ties: lower instance, then
/// lower prediction) while both are free.
[[nodiscard]] std::vector<std::size_t> match_by_iou(const std::vector<InstancePair>& pairs);

/// Which of the predictions find an instance: each in the order of `predictions` takes, of the free
/// instances with an IoU of at least `percent` / 100 with it, the one with the greatest (ties:
/// lower id). As long as `predictions`.
[[nodiscard]] std::vector<bool> match_by_score(const std::vector<InstancePair>& pairs,
                                               const std::vector<std::uint32_t>& predictions,
                                               int percent);

}  // namespace mapscore::eval
