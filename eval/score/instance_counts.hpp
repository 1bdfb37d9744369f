// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/metric.hpp"

#include <array>
#include <cstdint>
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
  /// pq, sq, rq, ap_25, ap_50, ap_75, ap_mean, in this order.
  [[nodiscard]] std::vector<Metric> metrics() const;

  static auto counts() {
    return std::to_array<CountField<InstanceCounts>>({
        {"instances_true_positive", &InstanceCounts::true_positive},
        {"instances_false_positive", &InstanceCounts::false_positive},
        {"instances_false_negative", &InstanceCounts::false_negative},
        {"instances_iou_sum_billionth", &InstanceCounts::iou_sum_nano, false},
        {"instances_void", &InstanceCounts::void_predicted},
    });
  }
  /// Pools.
  InstanceCounts& operator+=(const InstanceCounts& other);
  bool operator==(const InstanceCounts&) const = default;
};

}  // namespace mapscore::eval
