// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/random_stream.hpp"
#include "sim/faults/depth_dose.hpp"

#include <opencv2/core.hpp>

namespace mapscore::sim {

// What comes back to the sensor at all, and from where. One draw, or pair of draws, for each pixel
// in row-major order, whatever the pixel holds.

/// Takes the return (z = 0) of each pixel with the chance min(1, grazing * grazing_loss(angle)).
void drop_grazing(cv::Mat1d& z_m, const cv::Mat1f& incidence_rad, const DepthDose& dose,
                  RandomStream stream);

/// A pixel with a return and a neighbour (of four) across a step of the noise-free image reports,
/// with the chance min(1, flying * flying_share), the mix z + m (z_neighbour - z), m uniform in [0,
/// 1); of several the neighbour across the largest step in 1/z, ties to the order left, right,
/// above, below.
void add_flying_pixels(cv::Mat1d& z_m, const cv::Mat1d& noise_free_m, const CameraModel& camera,
                       const DepthDose& dose, RandomStream stream);

}  // namespace mapscore::sim
