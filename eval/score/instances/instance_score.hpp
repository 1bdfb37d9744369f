// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/score/instances/instance_pieces.hpp"
#include "eval/score/part_counts.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace mapscore::eval {

/// Counts by class id; zero for classes that are not detected, whose instances are left out on both
/// sides. `surface` and `visible`: truth made with instance_table(table), on the lattice of the
/// map. Throws Error when a class or instance is not in the table, or the lattices of the truths
/// differ. Thread-safe.
[[nodiscard]] std::vector<InstanceCounts> score_instances(const PredictedInstances& predicted,
                                                          const SurfaceTruth& surface,
                                                          const VisibleTruth& visible,
                                                          const ClassTable& table);

/// AP at kInstancePercents[threshold]; nullopt when no instance is visible.
[[nodiscard]] std::optional<double> instance_ap(const InstanceCounts& counts,
                                                std::size_t threshold);

/// Counts pooled over the detected classes. Throws Error when sizes differ.
[[nodiscard]] InstanceCounts pool_detected_instances(const std::vector<InstanceCounts>& counts,
                                                     const ClassTable& table);

/// The mean of every figure over the detected classes with visible instances; a class for which a
/// figure is undefined is left out of that figure's mean. Empty when there is no such class. Throws
/// Error when sizes differ.
[[nodiscard]] std::vector<Metric> macro_instance_metrics(const std::vector<InstanceCounts>& counts,
                                                         const ClassTable& table);

}  // namespace mapscore::eval
