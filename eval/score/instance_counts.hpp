// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

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
  /// Pools.
  InstanceCounts& operator+=(const InstanceCounts& other);
  bool operator==(const InstanceCounts&) const = default;
};

}  // namespace mapscore::eval
