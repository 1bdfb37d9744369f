// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/edge_aligned/depth_edges.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"
#include "core/segmentation/edge_aligned/outline_shifts.hpp"
#include "core/segmentation/edge_aligned/surface_creases.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// Labels the depth image: 1 + index of the detection that a pixel belongs to, 0 for none. `on`:
/// along what votes spread; it is parted where two masks meet at a step, or where a surface plainly
/// goes on. May be the edges' own images. `masks`: of the size of the colour camera's images.
[[nodiscard]] cv::Mat1w vote_on_surfaces(const DepthEdges& edges, const MaskField& masks,
                                         const OutlineAlignment& alignment,
                                         const OutlineShifts& shifts, const Calibration& believed,
                                         std::size_t detections, Continuity& on, double reach_px);

}  // namespace mapscore
