// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// Erosion by one pixel more than it should be; stands in for core/segmentation/erosion.cpp.
#include "exactly_eroded.cpp"

namespace mapscore {

cv::Mat1b erode_mask(const Detection& detection, int radius_px, int image_width_px,
                     int image_height_px) {
  return exactly_eroded(detection, radius_px + 1, image_width_px, image_height_px);
}

}  // namespace mapscore
