// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/edge_aligned/depth_edges.hpp"

#include <opencv2/core.hpp>

#include <vector>

namespace mapscore {

/// Continuity to the next pixel of the row, of the column: 0 to 1.
struct Continuity {
  cv::Mat1f right, down;
};

/// The continuity of a depth image, with 0 also across its concave creases, as where an object
/// stands on a floor or against a wall: depth goes on there, but the surface turns. On a plane the
/// inverse depth w is linear in the pixel, and where two planes meet in a valley its slope rises.
/// The turn of a pair (p, q) is the slope of w over up to 4 pixels from q on, less that over up to
/// 4 pixels up to p, at least 2 on either side without a step. A crease is a pair whose turn is the
/// largest within 2 pixels along its line and exceeds max(0.0003 / m, 5 sigma (1 / a + 1 / b)),
/// with a and b the lengths of the two slopes and sigma the noise of w where depth is good to 1 mm,
/// or the image's where that is larger. A floor under a camera h above it turns by 1 / (f h) a
/// pixel, 0.002 / m at 0.9 m, at any distance. Thread-safe.
[[nodiscard]] Continuity part_at_creases(const DepthEdges& edges);

/// The creases of columns as edges of strength 1: where something stands on a floor or a table, its
/// outline ends without a step of depth, and what goes on below is what it stands on. `parted`:
/// part_at_creases(edges); row-major. Thread-safe.
[[nodiscard]] std::vector<DepthEdge> contacts_of(const DepthEdges& edges, const Continuity& parted,
                                                 const CameraModel& camera);

}  // namespace mapscore
