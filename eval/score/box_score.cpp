// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/box_score.hpp"

#include "core/geometry/depth_rays.hpp"
#include "eval/truth/sample_counter.hpp"
#include "eval/truth/shapes/shape_tests.hpp"

#include <cmath>

namespace mapscore::eval {

double box_iou(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b, double widen_m) {
  if (a.isEmpty() || b.isEmpty()) return 0.0;
  const Eigen::AlignedBox3d wide_a = widened(a, widen_m), wide_b = widened(b, widen_m);
  const Eigen::AlignedBox3d overlap = wide_a.intersection(wide_b);
  const double common = overlap.isEmpty() ? 0.0 : overlap.volume();
  const double both = wide_a.volume() + wide_b.volume() - common;
  return both > 0.0 ? common / both : 0.0;
}

std::vector<Eigen::AlignedBox3d> truth_boxes(const Frame& frame,
                                             const Calibration& true_calibration,
                                             std::size_t instance_count) {
  check_depth_images(frame, true_calibration.depth);
  const DepthRays rays(true_calibration.depth);
  std::vector<Eigen::AlignedBox3d> boxes(instance_count);
  for (int v = 0; v < frame.depth.rows; ++v) {
    const std::uint16_t* depth = frame.depth[v];
    const std::uint16_t* label = frame.depth_label[v];
    for (int u = 0; u < frame.depth.cols; ++u) {
      if (depth[u] == 0 || label[u] == 0 || label[u] >= instance_count) continue;
      const double z = depth[u] / kDepthUnitsPerMetre;
      if (z < true_calibration.range_min_m || z > true_calibration.range_max_m) continue;
      boxes[label[u]].extend(rays.point(u, v, z));
    }
  }
  return boxes;
}

void BoxCounts::add(const Eigen::AlignedBox3d& box, const Eigen::AlignedBox3d& truth,
                    double widen_m) {
  if (truth.isEmpty()) {
    ++unseen;
    return;
  }
  const std::int64_t iou =
      std::llround(box_iou(box, truth, widen_m) * static_cast<double>(kBillion));
  ++detections;
  iou_sum_nano += iou;
  at_25 += 4 * iou >= kBillion;
  at_50 += 2 * iou >= kBillion;
  at_75 += 4 * iou >= 3 * kBillion;
}

std::vector<Metric> BoxCounts::metrics() const {
  return {{"box_iou", ratio(iou_sum_nano, detections * kBillion)},
          {"box_25", ratio(at_25, detections)},
          {"box_50", ratio(at_50, detections)},
          {"box_75", ratio(at_75, detections)}};
}

}  // namespace mapscore::eval
