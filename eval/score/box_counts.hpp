// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/metric.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace mapscore::eval {

/// Volume of the intersection over that of the union of two boxes in one frame, both widened by
/// `widen_m` >= 0 on each side; 0 when one is empty or the union has no volume. Half a voxel keeps
/// flat boxes comparable: a picture on a wall seen from the front has no thickness.
[[nodiscard]] double box_iou(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b,
                             double widen_m);

/// How well the boxes of detections fit: integers that add over frames, trials and classes.
struct BoxCounts {
  std::int64_t detections = 0;    ///< whose instance has a depth sample in the frame
  std::int64_t unseen = 0;        ///< detections whose instance has none; in no figure
  std::int64_t iou_sum_nano = 0;  ///< of the detections, each rounded to 1e-9
  std::int64_t at_25 = 0, at_50 = 0, at_75 = 0;  ///< with a rounded IoU of at least 0.25, ...

  /// Counts one detection: the box of its kept points (empty when it was skipped) against the
  /// truth's of its instance in the same frame (empty when it has no sample).
  void add(const Eigen::AlignedBox3d& box, const Eigen::AlignedBox3d& truth, double widen_m);
  /// box_iou, box_25, box_50, box_75, in this order; nullopt without a detection that could be
  /// judged.
  [[nodiscard]] std::vector<Metric> metrics() const;

  static auto counts() {
    return std::to_array<CountField<BoxCounts>>({
        {"boxes", &BoxCounts::detections},
        {"boxes_unseen", &BoxCounts::unseen},
        {"iou_sum_billionth", &BoxCounts::iou_sum_nano, false},
        {"at_25", &BoxCounts::at_25, false},
        {"at_50", &BoxCounts::at_50, false},
        {"at_75", &BoxCounts::at_75, false},
    });
  }
  /// Pools.
  BoxCounts& operator+=(const BoxCounts& other) {
    add_counts(*this, other);
    return *this;
  }
  bool operator==(const BoxCounts&) const = default;
};

}  // namespace mapscore::eval
