// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/label_counts.hpp"

#include <algorithm>

namespace mapscore::eval {

std::vector<Metric> LabelCounts::metrics() const {
  // PQ = sum IoU / (TP + FP / 2 + FN / 2) = 2 sum IoU / (detections + instances), as TP is in both.
  const std::int64_t either = detections + instances;
  const auto quality = [](std::int64_t sum_nano, std::int64_t whole) {
    return ratio(sum_nano, whole * kBillion);
  };
  return {{"label_accuracy", ratio(right_px, true_px)},
          {"label_iou", ratio(right_px, true_px + named_px - right_px)},
          {"label_instance_recall", ratio(instances_found, instances)},
          {"label_instance_precision", ratio(instances_found, detections)},
          {"label_pq", quality(2 * iou_sum_nano, either)},
          {"label_sq", quality(iou_sum_nano, instances_found)},
          {"label_rq", ratio(2 * instances_found, either)},
          {"label_boundary_f", f1(right_edge_px, named_edge_px, found_edge_px, true_edge_px)},
          {"label_score_ece", scores.error()},
          {"label_pixel_ece", pixels.error()}};
}

LabelCounts& LabelCounts::operator+=(const LabelCounts& other) {
  add_counts(*this, other);
  named_as.resize(std::max(named_as.size(), other.named_as.size()));
  for (std::size_t c = 0; c < other.named_as.size(); ++c) named_as[c] += other.named_as[c];
  scores += other.scores;
  pixels += other.pixels;
  return *this;
}

}  // namespace mapscore::eval
