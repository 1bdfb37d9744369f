// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/edge_aligned/depth_edges.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"
#include "core/segmentation/edge_aligned/outline_shifts.hpp"

#include <opencv2/core.hpp>

#include <cstddef>

namespace mapscore {

/// What the masks say of each depth pixel, each pixel by itself.
struct PixelVotes {
  cv::Mat1w owner;   ///< 1 + detection in whose object it lies, 0 for none
  cv::Mat1f weight;  ///< 0 to 1; little where the colour camera does not see the surface
};

/// The votes under the mended calibration, of masks as large as their objects are. `masks`: of the
/// size of the believed colour camera's images.
[[nodiscard]] PixelVotes pixel_votes(const DepthEdges& edges, const MaskField& masks,
                                     const OutlineAlignment& alignment, const OutlineShifts& shifts,
                                     const Calibration& believed, std::size_t detections);

}  // namespace mapscore
