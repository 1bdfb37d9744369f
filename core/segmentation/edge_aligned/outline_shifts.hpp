// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/edge_aligned/depth_edges.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// Displacements of parts of the image that one alignment of the whole frame cannot explain, such
/// as of a limb that moved between the colour and the depth image. Given at nodes `kPitch_px`
/// apart, bilinear between them.
struct OutlineShifts {
  static constexpr int kPitch_px = 32;
  cv::Mat2f nodes;  ///< to add to a depth pixel's place in the colour image; empty: none

  [[nodiscard]] cv::Vec2f at(float u, float v) const;
};

/// None where the alignment is sharp, or explains too few of the outlines: a quarter, or half where
/// `is_known` says that `believed` is right. Thread-safe.
[[nodiscard]] OutlineShifts find_outline_shifts(const DepthEdges& edges, const OutlineField& field,
                                                const OutlineAlignment& alignment,
                                                const Calibration& believed, bool is_known = false);

}  // namespace mapscore
