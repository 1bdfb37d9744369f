// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/segmentation.hpp"

#include <vector>

namespace mapscore::testing {

/// Equal cameras of 40 x 30 pixels, f = 100, before a plane at 2 m: neighbouring points lie 2 cm
/// apart. `label` is what the colour camera sees, instances 1 and 2 of a detected class.
struct MaskScene {
  Calibration pair;
  cv::Mat1w depth = cv::Mat1w(30, 40, std::uint16_t{10000});
  cv::Mat1w label = cv::Mat1w(30, 40, std::uint16_t{0});

  MaskScene() { pair.color = pair.depth = CameraModel{40, 30, 100, 100, 19.5, 14.5}; }

  [[nodiscard]] std::vector<Detection> detections() const {
    ClassTable table;
    table.classes.push_back({1, "thing", {}, true});
    table.instances.push_back({1, "thing_1", 1});
    table.instances.push_back({2, "thing_2", 1});
    return detections_of(label, table);
  }
  [[nodiscard]] std::vector<Segment> segments_by(const Segmentation& kind) const {
    return segment(Sight(pair, depth, detections()), kind, 0.05, true);
  }
  [[nodiscard]] Segment segment_by(const Segmentation& kind) const {
    return segments_by(kind).at(0);
  }
  /// The points of these pixels, in row-major order.
  [[nodiscard]] std::vector<Eigen::Vector3d> points(const std::vector<cv::Rect>& parts) const {
    cv::Mat1b inside(depth.size(), std::uint8_t{0});
    for (const cv::Rect& part : parts) inside(part) = 1;
    std::vector<Eigen::Vector3d> points;
    for (int v = 0; v < depth.rows; ++v)
      for (int u = 0; u < depth.cols; ++u)
        if (inside(v, u) != 0)
          points.push_back(pair.depth.back_project(u, v, depth(v, u) / kDepthUnitsPerMetre));
    return points;
  }
};

}  // namespace mapscore::testing
