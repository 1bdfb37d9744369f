// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"

#include <opencv2/core.hpp>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace mapscore {

/// Side of a pixel pair on which the farther surface lies, seen from the nearer one.
enum class Outward { right, left, down, up };

/// A place where the depth image steps between two pixels of a row or a column.
struct DepthEdge {
  Eigen::Vector3f point;  ///< on the nearer surface, half a pixel beyond its last pixel
  Outward outward = Outward::right;
  float strength = 0;  ///< 0 to 1
};

/// Steps of a depth image, and what hangs together in it.
struct DepthEdges {
  cv::Mat1f inverse_depth;       ///< 1 / z in 1/m; 0 where there is no usable depth
  float noise = 0;               ///< standard deviation of inverse_depth, 1/m
  cv::Mat1b near_holes;          ///< where something nearer than the range may stand, at half size
  cv::Mat1f right, down;         ///< continuity to the next pixel of the row, of the column: 0 to 1
  std::vector<DepthEdge> steps;  ///< row-major, rows before columns of a pixel
};

/// Which steps count. The defaults are the segmentation's.
struct DepthEdgeRules {
  /// Relative difference of inverse depth up to which the nearer sides of two steps are one
  /// surface, so that the inner step is a crease of it.
  float same_depth = 0.03F;
  /// Whether a near hole of a row that may be a projector's shadow has a left edge of strength 1 at
  /// its right end, in noisy images. The projector is taken to stand at most 0.08 m to the right of
  /// the depth camera, as a Kinect's and an Astra's do.
  bool shadow_ends = false;
};

/// True when the noise of the inverse depth exceeds 0.0005/m, so that 4 sigma exceed the least step
/// that counts as an edge (0.002/m): only such images are smoothed, and are taken to have shadows
/// of a projector.
[[nodiscard]] bool is_noisy(const DepthEdges& edges);

/// Finds the steps of a depth image of `camera`. On a plane the inverse depth w = 1/z is linear in
/// the pixel, so a pair (p, q) is judged by how far w_q lies from the line through p's side and w_p
/// from the line through q's side, the lesser of the two: e = min(|w_q - 2 w_p + w_p'|, |w_p - 2
/// w_q + w_q'|). strength = (e - tau) / (2 tau), limited to 0 and 1; tau = max(0.002 / m, 4 sigma),
/// sigma the noise of w as the image's own second differences show it. Depths outside the camera's
/// range are none. A gap of up to 23 pixels without depth is stepped over. Behind a wider one, or
/// one that reaches the image's border, lies nothing within the range unless it is a near hole
/// (near_holes.hpp): the surfaces at its ends are edges of strength 1, but those beyond 0.9 of the
/// range, which may end there because the range does. A near hole of a row may be a projector's
/// shadow where the surface on its right is nearer by dw > tau and it is no wider than 0.08 m f dw
/// + 4 pixels, f the depth camera's fx. Not given is a step beyond which the next one that faces
/// alike in its row or column lies within 6 pixels, with a w on its nearer side that is the same
/// but for DepthEdgeRules::same_depth: it is a crease of the surface that ends there, or noise
/// about that end. Thread-safe.
[[nodiscard]] DepthEdges find_depth_edges(const cv::Mat1w& depth, const Calibration& believed,
                                          const DepthEdgeRules& rules = {});

}  // namespace mapscore
