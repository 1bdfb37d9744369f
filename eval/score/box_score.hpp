// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/frame.hpp"
#include "core/geometry/camera.hpp"
#include "eval/score/part_counts.hpp"

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

namespace mapscore::eval {

/// Boxes of the noise-free depth samples of one frame, by instance id, in the depth camera's
/// optical frame, metres; empty (`isEmpty()`) for an instance without a sample, for background (0)
/// and for ids from `instance_count` on. Samples as SampleCounter takes them: every pixel centre
/// whose depth is not 0 and lies in the camera's range, limits included. Reads `depth` and
/// `depth_label`. Throws Error naming the frame when an image has another size than the camera.
[[nodiscard]] std::vector<Eigen::AlignedBox3d> truth_boxes(const Frame& frame,
                                                           const Calibration& true_calibration,
                                                           std::size_t instance_count);

}  // namespace mapscore::eval
