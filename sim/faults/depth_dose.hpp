// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <numbers>

namespace mapscore::sim {

/// Doses of the faults of a structured-light depth camera, and the numbers that a dose of 1 stands
/// for (docs/methods.md, "Depth faults"). Every dose is 0 (off) or more.
struct DepthDose {
  double axial = 0.0;         ///< multiplies the standard deviation along z
  double lateral = 0.0;       ///< multiplies the standard deviation across the view
  double quantisation = 0.0;  ///< multiplies the step of the disparity
  double grazing = 0.0;       ///< multiplies the chance of no return at grazing angles, up to 1
  double shadow = 0.0;        ///< multiplies the baseline that the projector's shadow comes from
  double flying = 0.0;        ///< multiplies the share of flying pixels at depth edges, up to 1
  double range = 0.0;         ///< chance that a value out of range is dropped, up to 1

  double axial_base_m = 0.0012;        ///< sigma_z at 0.4 m (Nguyen, Izadi, Lovell 2012)
  double axial_growth_per_m = 0.0019;  ///< times (z - 0.4 m)^2 (Nguyen et al.)
  double lateral_px = 0.8;             ///< sigma across, seen straight on (Nguyen et al.)
  double baseline_m = 0.075;   ///< projector to the right of the camera (Khoshelham, Elberink 2012)
  double subpixel_px = 0.125;  ///< step of the disparity (Khoshelham, Elberink 2012)
  double grazing_from_rad = 70.0 * std::numbers::pi / 180.0;  ///< angle of incidence, first losses
  double grazing_to_rad = 85.0 * std::numbers::pi / 180.0;    ///< ... and none comes back
  double flying_share = 0.1;                                  ///< of the pixels beside a depth edge
  double range_min_m = 0.6, range_max_m = 8.0;                ///< planar z, limits included

  bool operator==(const DepthDose&) const = default;
};

/// True when every dose is zero.
[[nodiscard]] bool is_zero(const DepthDose& dose);

/// Throws Error naming the member when a dose is negative or not finite, or a number makes no
/// sense.
void check(const DepthDose& dose);

/// Ready-made sensors.
enum class DepthPreset {
  ideal,     ///< every dose zero
  astra,     ///< Orbbec Astra: every dose 1, 0.6 to 8 m
  kinect_v1  ///< Microsoft Kinect for Xbox 360: every dose 1, 0.8 to 4 m
};

[[nodiscard]] DepthDose depth_preset(DepthPreset preset);

}  // namespace mapscore::sim
