// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/detection.hpp"

namespace mapscore {

/// The detection's mask eroded by the disc dx^2 + dy^2 <= radius^2, of the box's size. Pixels
/// outside the mask erode it, those beyond the image's edge do not: there the mask goes on. A
/// radius beyond the image's diagonal is that diagonal. Throws Error when it is negative.
/// Thread-safe.
[[nodiscard]] cv::Mat1b erode_mask(const Detection& detection, int radius_px, int image_width_px,
                                   int image_height_px);

}  // namespace mapscore
