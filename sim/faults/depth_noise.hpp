// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "sim/faults/image_doses.hpp"

#include <opencv2/core.hpp>

#include <cstdint>

namespace mapscore::sim {

/// Standard deviation along z of a dose of 1, in metres: axial_base_m + axial_growth_per_m (z - 0.4
/// m)^2 + 0.0001 / sqrt(z) theta^2 / (pi/2 - theta)^2 (Nguyen, Izadi, Lovell 2012, equation 5),
/// theta at most 85 degrees.
[[nodiscard]] double axial_sigma_m(const DepthDose& dose, double z_m, double incidence_rad);

/// Standard deviation across the view of a dose of 1, in pixels on each axis: lateral_px + 0.035
/// theta / (pi/2 - theta) (Nguyen et al., equation 1), theta at most 85 degrees.
[[nodiscard]] double lateral_sigma_px(const DepthDose& dose, double incidence_rad);

/// Chance of no return of a dose of 1: 0 up to grazing_from_deg, 1 from grazing_to_deg on, linear
/// between.
[[nodiscard]] double grazing_loss(const DepthDose& dose, double incidence_rad);

/// The depth image as the sensor would have measured it. In this order: no return in the
/// projector's shadow and at grazing angles; flying pixels at depth edges; lateral noise; axial
/// noise; disparity quantisation; range. Angles, edges and shadow come from the noise-free image.
/// Each effect draws from the stream (seed, "depth.EFFECT", frame) by pixel, so that neither its
/// draws nor those of the others depend on any dose. Doses that are all zero return `depth` itself.
/// `depth`: planar z in 1/5000 m, 0 = none, of `camera`'s size; not changed. Values beyond the
/// format's 13.1 m become none. Thread-safe. Throws Error on a bad dose (check) or a size that
/// differs.
[[nodiscard]] cv::Mat1w corrupt_depth(const cv::Mat1w& depth, const CameraModel& camera,
                                      const DepthDose& dose, std::uint64_t seed, int frame);

}  // namespace mapscore::sim
