// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"

#include <opencv2/core.hpp>

namespace mapscore::sim {

/// Planar z in metres of a stored depth image; 0 where there is none.
[[nodiscard]] cv::Mat1d metres_of(const cv::Mat1w& depth);

/// Steps between neighbouring pixels: |z1 - z2| > limit min(z1, z2), which no surface seen at less
/// than 87 degrees makes; limit = tan(87 deg) / f, with f the mean focal length in pixels.
struct StepRule {
  double limit;
  explicit StepRule(const CameraModel& camera);
  /// Between two pixels that both have a depth, `apart` pixels from each other. Inverse depths may
  /// stand in place of depths: the answer is the same.
  [[nodiscard]] bool is_step(double z1_m, double z2_m, int apart = 1) const {
    return (z1_m < z2_m ? z2_m - z1_m : z1_m - z2_m) > apart * limit * (z1_m < z2_m ? z1_m : z2_m);
  }
};

/// Angle between each pixel's ray and the normal of its surface, radians in [0, pi/2); 0 where
/// there is no depth. On a plane 1/z is linear in the pixel, so that slopes of 1/z over two pixels
/// to both sides (one pixel, one side or none at depth edges) give the normal exactly, but for the
/// depth's resolution. Sides that differ by more than half of the steeper (an edge too low to be a
/// step, a crease) give the flatter.
[[nodiscard]] cv::Mat1f incidence_angles(const cv::Mat1d& z_m, const CameraModel& camera);

/// 255 where the projector, `baseline_m` to the right of the camera (+x of its optical frame), does
/// not reach the surface that the pixel sees, because another pixel's surface stands nearer on the
/// same ray. To the left of an edge from z_near to z_far that is f b (1/z_near - 1/z_far) pixels.
/// Rays of the projector stay in the pixel's row. What the camera does not see casts no shadow.
[[nodiscard]] cv::Mat1b projector_shadow(const cv::Mat1d& z_m, const CameraModel& camera,
                                         double baseline_m);

}  // namespace mapscore::sim
