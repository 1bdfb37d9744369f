// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"
#include "core/segmentation/detection.hpp"
#include "core/segmentation/registered_cloud.hpp"
#include "core/segmentation/segment.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// The mask eroded by the disc dx^2 + dy^2 <= radius^2, then direct. A radius of 0 is direct.
struct Erosion {
  static constexpr std::string_view kKind = "erosion";
  static constexpr std::string_view kMeaning = "erode the mask, then direct";
  int radius_px = 5;

  static void fields(auto& s, auto&& visit) {
    visit(s.radius_px, Field{"radius_px", "radius of the disc that erodes the mask", {0, 1000}});
  }
  /// As `segment` of segmentation.hpp, which fills in class, instance, score and box.
  [[nodiscard]] Segment segment(const Detection& detection, const RegisteredCloud& cloud,
                                double voxel_m, bool with_voxels) const;
  bool operator==(const Erosion&) const = default;
};

/// The detection's mask eroded by the disc dx^2 + dy^2 <= radius^2, of the box's size. Pixels
/// outside the mask erode it, those beyond the image's edge do not: there the mask goes on. A
/// radius beyond the image's diagonal is that diagonal. Throws Error when it is negative.
/// Thread-safe.
[[nodiscard]] cv::Mat1b erode_mask(const Detection& detection, int radius_px, int image_width_px,
                                   int image_height_px);

}  // namespace mapscore
