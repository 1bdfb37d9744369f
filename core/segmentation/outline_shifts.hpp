// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/depth_edges.hpp"
#include "core/segmentation/outline_alignment.hpp"
#include "core/segmentation/outline_field.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// What a single alignment of the frame leaves: displacements of parts of the image, as of a limb
/// that moved between the two images. Given at nodes `pitch_px` apart, bilinear between them.
struct OutlineShifts {
  static constexpr int kPitch_px = 32;
  cv::Mat2f nodes;  ///< to add to a depth pixel's place in the colour image; empty: none

  [[nodiscard]] cv::Vec2f at(float u, float v) const;
};

[[nodiscard]] OutlineShifts find_outline_shifts(const DepthEdges& edges, const OutlineField& field,
                                                const OutlineAlignment& alignment,
                                                const Calibration& believed);

}  // namespace mapscore
