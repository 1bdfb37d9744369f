// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

#include <opencv2/core.hpp>

#include <vector>

namespace mapscore {

/// Tight bounding box in pixels, limits included.
struct PixelBox {
  int u_min = 0, v_min = 0, u_max = -1, v_max = -1;

  [[nodiscard]] int width() const { return u_max - u_min + 1; }
  [[nodiscard]] int height() const { return v_max - v_min + 1; }
  [[nodiscard]] cv::Rect rect() const { return {u_min, v_min, width(), height()}; }
  bool operator==(const PixelBox&) const = default;
};

/// One instance in one colour image.
struct Detection {
  ClassId class_id = kBackground;
  InstanceId instance = 0;
  double score = 1.0;
  PixelBox box;
  cv::Mat1b mask;       ///< of the box's size, 255 inside; may be in pieces
  cv::Size image_px{};  ///< of the image it was found in; 0 x 0 where that is not known
};

/// Throws Error unless the mask fills its box, the box lies within a colour image of this size, and
/// the detection was found in such an image, where that is known. Thread-safe.
void check(const Detection& detection, int width_px, int height_px);

/// One detection for each instance of a detected class that covers at least one pixel of the label
/// image (instance ids, colour camera), in the order of instance ids. Throws Error when the table
/// is not in the order of its ids, or an instance names a class beyond it. Thread-safe.
[[nodiscard]] std::vector<Detection> detections_of(const cv::Mat1w& label, const ClassTable& table);

/// 255 on the pixels whose registered point some segmentation reads: the masks, and the middle
/// pixel of each box. Size: of the colour image. Throws Error for a detection that does not fit it
/// (check). Thread-safe.
[[nodiscard]] cv::Mat1b pixels_wanted(const std::vector<Detection>& detections, int width_px,
                                      int height_px);

}  // namespace mapscore
