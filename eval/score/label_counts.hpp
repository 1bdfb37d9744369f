// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/metric.hpp"
#include "eval/score/reliability.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace mapscore::eval {

/// Of detections in the colour images against the true label images (detection_score.hpp), of one
/// class: pixels, edges and instances, which add over frames, trials and classes.
struct LabelCounts {
  std::int64_t true_px = 0;    ///< of the class in the truth
  std::int64_t named_px = 0;   ///< in masks that name the class
  std::int64_t right_px = 0;   ///< in both
  std::int64_t instances = 0;  ///< true ones with a pixel, one a frame
  std::int64_t detections = 0;
  std::int64_t instances_found = 0;         ///< by a detection of their class with an IoU above 0.5
  std::int64_t iou_sum_nano = 0;            ///< of these, each rounded to 1e-9, halves up
  std::int64_t true_edge_px = 0;            ///< pixels at the class's edge in the truth
  std::int64_t found_edge_px = 0;           ///< of these, near an edge of the masks that name it
  std::int64_t named_edge_px = 0;           ///< pixels at the edge of those masks
  std::int64_t right_edge_px = 0;           ///< of these, near an edge of the class in the truth
  std::vector<std::int64_t> named_as = {};  ///< the true pixels by the class of their masks
  Reliability scores = {};  ///< of the detections, right where one finds an instance
  Reliability pixels =
      {};  ///< of the pixels that a network gives the class, where it says how sure

  /// label_accuracy, label_iou, label_instance_recall, label_instance_precision, label_pq,
  /// label_sq, label_rq, label_boundary_f, label_score_ece, label_pixel_ece, in this order.
  [[nodiscard]] std::vector<Metric> metrics() const;

  static auto counts() {
    return std::to_array<CountField<LabelCounts>>({
        {"label_true_px", &LabelCounts::true_px},
        {"label_named_px", &LabelCounts::named_px},
        {"label_right_px", &LabelCounts::right_px},
        {"label_instances", &LabelCounts::instances},
        {"label_detections", &LabelCounts::detections},
        {"label_instances_found", &LabelCounts::instances_found},
        {"label_iou_sum_billionth", &LabelCounts::iou_sum_nano, false},
        {"label_true_edge_px", &LabelCounts::true_edge_px},
        {"label_found_edge_px", &LabelCounts::found_edge_px},
        {"label_named_edge_px", &LabelCounts::named_edge_px},
        {"label_right_edge_px", &LabelCounts::right_edge_px},
    });
  }
  /// Pools.
  LabelCounts& operator+=(const LabelCounts& other);
  bool operator==(const LabelCounts&) const = default;
};

}  // namespace mapscore::eval
