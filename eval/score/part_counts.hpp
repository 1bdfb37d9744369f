// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/localization/trajectory_errors.hpp"
#include "eval/score/metric.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

// The parts of a class's counts that are counted by themselves (ClassCounts::parts()).

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
  bool operator==(const BoxCounts&) const = default;
};

/// Of the voxels of P_c and V_c those that belong to thin parts (distances/thin_score.hpp).
struct ThinCounts {
  std::int64_t predicted = 0, true_predicted = 0;
  std::int64_t visible = 0, found = 0;

  /// thin_precision, thin_recall, thin_f1, in this order.
  [[nodiscard]] std::vector<Metric> metrics() const {
    return {{"thin_precision", ratio(true_predicted, predicted)},
            {"thin_recall", ratio(found, visible)},
            {"thin_f1", f1(true_predicted, predicted, found, visible)}};
  }

  static auto counts() {
    return std::to_array<CountField<ThinCounts>>({
        {"thin_predicted", &ThinCounts::predicted},
        {"thin_true_predicted", &ThinCounts::true_predicted},
        {"thin_visible", &ThinCounts::visible},
        {"thin_found", &ThinCounts::found},
    });
  }
  bool operator==(const ThinCounts&) const = default;
};

/// ate_m, ate_aligned_m, ate_deg, rpe_percent, rpe_deg_per_m, nees_share, nees_mean, nees6_share,
/// nees6_mean, in this order.
[[nodiscard]] std::vector<Metric> pose_metrics(const TrajectoryErrors& errors);

/// Errors of the poses that a trial maps from: integers that add over trials. A sum is kept as its
/// whole part and the 10^-12 parts of the rest, each sum rounded once a trial, so that neither a
/// lost robot nor a good one costs digits and the order of pooling does not matter.
struct PoseCounts {
  std::int64_t frames = 0, pairs = 0;  ///< pairs of frames a metre of way apart
  // Sums of squares: m^2 and rad^2, over the frames, then over the pairs.
  std::int64_t position = 0, position_parts = 0;
  std::int64_t aligned = 0, aligned_parts = 0;
  std::int64_t rotation = 0, rotation_parts = 0;
  std::int64_t relative_position = 0, relative_position_parts = 0;
  std::int64_t relative_rotation = 0, relative_rotation_parts = 0;
  // Normalised errors, of x y yaw, then of all six axes: frames that have one, of them in the band
  // and infinite, and the sum of the others.
  std::int64_t nees_frames = 0, nees_in_band = 0, nees_infinite = 0;
  std::int64_t nees = 0, nees_parts = 0;
  std::int64_t nees6_frames = 0, nees6_in_band = 0, nees6_infinite = 0;
  std::int64_t nees6 = 0, nees6_parts = 0;

  [[nodiscard]] static PoseCounts of(const TrajectoryErrors& errors);
  /// Those of pose_metrics.
  [[nodiscard]] std::vector<Metric> metrics() const;

  static auto counts() {
    return std::to_array<CountField<PoseCounts>>({
        {"pose_frames", &PoseCounts::frames},
        {"pose_pairs", &PoseCounts::pairs},
        {"position_m2", &PoseCounts::position, false},
        {"position_parts", &PoseCounts::position_parts, false},
        {"aligned_m2", &PoseCounts::aligned, false},
        {"aligned_parts", &PoseCounts::aligned_parts, false},
        {"rotation_rad2", &PoseCounts::rotation, false},
        {"rotation_parts", &PoseCounts::rotation_parts, false},
        {"relative_position_m2", &PoseCounts::relative_position, false},
        {"relative_position_parts", &PoseCounts::relative_position_parts, false},
        {"relative_rotation_rad2", &PoseCounts::relative_rotation, false},
        {"relative_rotation_parts", &PoseCounts::relative_rotation_parts, false},
        {"nees_frames", &PoseCounts::nees_frames},
        {"nees_in_band", &PoseCounts::nees_in_band, false},
        {"nees_infinite", &PoseCounts::nees_infinite, false},
        {"nees_sum", &PoseCounts::nees, false},
        {"nees_parts", &PoseCounts::nees_parts, false},
        {"nees6_frames", &PoseCounts::nees6_frames},
        {"nees6_in_band", &PoseCounts::nees6_in_band, false},
        {"nees6_infinite", &PoseCounts::nees6_infinite, false},
        {"nees6_sum", &PoseCounts::nees6, false},
        {"nees6_parts", &PoseCounts::nees6_parts, false},
    });
  }
  bool operator==(const PoseCounts&) const = default;
};

/// Least IoUs of the average precisions, percent; ap_mean is over all but the first.
inline constexpr std::array<int, 11> kInstancePercents{25, 50, 55, 60, 65, 70, 75, 80, 85, 90, 95};

/// Predicted instances of one score: how many, and how many find an instance at each IoU.
struct InstanceStep {
  int score = 0;  ///< thousandths
  std::int64_t predicted = 0;
  std::array<std::int64_t, kInstancePercents.size()> true_predicted{};

  /// Adds the instances of another step.
  InstanceStep& operator+=(const InstanceStep& other);
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
