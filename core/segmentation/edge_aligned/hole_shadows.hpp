// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/edge_aligned/depth_edges.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// What objects nearer than the sensor's range hide from the colour camera: 255 at depth pixels
/// that lie behind a near hole (near_holes.hpp), empty where nothing does. `cells`: by depth pixel
/// its place in the colour image, row-major, -1 beyond it.
///
/// Only what has a mask matters. A hole counts where one mask holds it wherever it stood, as near
/// as half of the least depth or as far as the range goes; and where, at one depth, one mask holds
/// four fifths of its run along the baseline, as of a thin object. Beside an object before nothing,
/// as at the end of a scene's floor, a mask holds a part of the hole alone, and only if that is
/// taken to be near. A surface that itself runs on into the hole, ending at the least depth, is not
/// hidden by it: in lines along the baseline, as far as such a hole may hide (a depth of 1.3
/// against half the least one). Thread-safe.
[[nodiscard]] cv::Mat1b hole_shadows(const DepthEdges& edges, const cv::Mat1i& cells,
                                     const OutlineField& field, const OutlineAlignment& alignment,
                                     const Calibration& believed);

}  // namespace mapscore
