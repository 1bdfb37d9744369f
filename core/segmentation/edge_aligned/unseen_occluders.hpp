// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/edge_aligned/color_places.hpp"
#include "core/segmentation/edge_aligned/depth_edges.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"

#include <opencv2/core.hpp>

namespace mapscore {

/// What the colour camera does not see for objects that the depth camera does not see: 255 at depth
/// pixels that may lie behind one. `mended`: as `alignment` corrects it. Only what has a mask
/// matters. Thread-safe.
///
/// Objects nearer than the sensor's range are near holes (near_holes.hpp), of whose cells every
/// second in both ways is tried. A hole counts where one mask holds it wherever it stood, as near
/// as half of the least depth or as far as the range goes; and where, at one depth, one mask holds
/// four fifths of its run along the baseline, as of a thin object. Beside an object before nothing,
/// as at the end of a scene's floor, a mask holds a part of the hole alone, and only if that is
/// taken to be near. A surface that itself runs on into the hole, ending at the least depth, is not
/// hidden by it: in lines along the baseline, as far as such a hole may hide (a depth of 1.3
/// against half the least one). Nor does a hole of a noisy image (is_noisy) hide anything where it
/// may be the shadow of a projector: what is near would cover the surface beside it in the colour
/// image, yet its mask is the same there and farther away than anything near can cover.
///
/// Objects beside the depth camera's view, within the range, are seen by the colour camera alone.
/// In lines along the baseline, a surface without a mask that runs on into a mask where such an
/// object may hide it is taken to be hidden: its own outline would be a step or a crease. Of a
/// range that begins at 0 nothing is nearer: all 0.
[[nodiscard]] cv::Mat1b unseen_occluders(const DepthEdges& edges, const ColorPlaces& places,
                                         const MaskField& masks, const OutlineAlignment& alignment,
                                         const Calibration& mended);

}  // namespace mapscore
