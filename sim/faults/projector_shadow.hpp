// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"

#include <opencv2/core.hpp>

namespace mapscore::sim {

/// 255 where the projector, `baseline_m` to the right of the camera (+x of its optical frame), does
/// not reach the surface that the pixel sees, because another pixel's surface stands nearer on the
/// same ray. To the left of an edge from z_near to z_far that is f b (1/z_near - 1/z_far) pixels.
/// Rays of the projector stay in the pixel's row. What the camera does not see casts no shadow.
[[nodiscard]] cv::Mat1b projector_shadow(const cv::Mat1d& z_m, const CameraModel& camera,
                                         double baseline_m);

}  // namespace mapscore::sim
