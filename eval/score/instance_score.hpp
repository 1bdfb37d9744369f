// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/score/instance_pieces.hpp"
#include "eval/score/metrics.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace mapscore::eval {

/// Least IoUs of the average precisions, percent; ap_mean is over all but the first.
inline constexpr std::array<int, 11> kInstancePercents{25, 50, 55, 60, 65, 70, 75, 80, 85, 90, 95};

/// Predicted instances of one score: how many, and how many find an instance at each IoU.
struct InstanceStep {
  int score = 0;  ///< thousandths
  std::int64_t predicted = 0;
  std::array<std::int64_t, kInstancePercents.size()> true_predicted{};

  bool operator==(const InstanceStep&) const = default;
};

/// Instances of one class: integers that add over maps, trials and classes.
struct InstanceCounts {
  std::int64_t true_positive = 0, false_positive = 0, false_negative = 0;
  std::int64_t iou_sum_nano = 0;    ///< of the true positives, each rounded to 1e-9, halves up
  std::int64_t void_predicted = 0;  ///< predictions of what was never seen; in no other count
  std::vector<InstanceStep> steps;  ///< by falling score, each score once

  /// True instances with visible voxels.
  [[nodiscard]] std::int64_t visible() const { return true_positive + false_negative; }
  /// Pools.
  InstanceCounts& operator+=(const InstanceCounts& other);
  bool operator==(const InstanceCounts&) const = default;
};

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

/// pq, sq, rq, ap_25, ap_50, ap_75, ap_mean, in this order.
[[nodiscard]] std::vector<Metric> instance_metrics(const InstanceCounts& counts);

/// Counts pooled over the detected classes. Throws Error when sizes differ.
[[nodiscard]] InstanceCounts pool_detected_instances(const std::vector<InstanceCounts>& counts,
                                                     const ClassTable& table);

/// The mean of every figure over the detected classes with visible instances; a class for which a
/// figure is undefined is left out of that figure's mean. Empty when there is no such class. Throws
/// Error when sizes differ.
[[nodiscard]] std::vector<Metric> macro_instance_metrics(const std::vector<InstanceCounts>& counts,
                                                         const ClassTable& table);

}  // namespace mapscore::eval
