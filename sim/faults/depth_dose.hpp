// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"

#include <array>
#include <string_view>

namespace mapscore::sim {

/// Ready-made depth cameras.
enum class DepthPreset {
  ideal,     ///< every dose zero
  astra,     ///< Orbbec Astra: every dose 1, 0.6 to 8 m
  kinect_v1  ///< Microsoft Kinect for Xbox 360: every dose 1, 0.8 to 4 m
};
constexpr auto names_of(DepthPreset) {
  return std::to_array<std::string_view>({"ideal", "astra", "kinect_v1"});
}

/// Doses of the faults of a structured-light depth camera, and the numbers that a dose of 1 stands
/// for (docs/methods.md, "Depth faults"). Every dose is 0 (off) or more. [N]: C. V. Nguyen, S.
/// Izadi, D. Lovell, 2012; [K]: K. Khoshelham, S. O. Elberink, 2012.
struct DepthDose {
  using Preset = DepthPreset;
  static constexpr Field kPreset{.key = "preset",
                                 .meaning =
                                     "depth camera that the other keys start from; ideal: "
                                     "no fault",
                                 .figure = "depth camera",
                                 .later = true};
  static constexpr Field kScale{
      .key = "scale", .meaning = "multiplies every dose", .range = {0, 100}, .later = true};

  double axial = 0, lateral = 0, quantisation = 0, grazing = 0, shadow = 0, flying = 0, range = 0;
  double axial_base_m = 0.0012, axial_growth_per_m = 0.0019;  ///< [N]
  double lateral_px = 0.8;                                    ///< seen straight on [N]
  double baseline_m = 0.075, subpixel_px = 0.125;             ///< [K]
  Degrees grazing_from_deg{70}, grazing_to_deg{85};
  double flying_share = 0.1;
  double range_min_m = 0.6, range_max_m = 8;  ///< planar z, limits included

  [[nodiscard]] static DepthDose of(DepthPreset preset);

  static void fields(auto& s, auto&& visit) {
    constexpr Range kDose{0, 100}, kMetres{0, 100};
    const auto dose = [&](auto& member, std::string_view key, std::string_view meaning) {
      visit(member, Field{.key = key, .meaning = meaning, .range = kDose, .dose = true});
    };
    dose(s.axial, "axial", "dose: noise along the view, over the published");
    dose(s.lateral, "lateral", "dose: noise across the view, over the published");
    dose(s.quantisation, "quantisation", "dose: step of the disparity over subpixel_px");
    dose(s.grazing, "grazing", "dose: loss at grazing angles");
    dose(s.shadow, "shadow", "dose: the projector's shadow, baseline over baseline_m");
    dose(s.flying, "flying", "dose: flying pixels at depth edges over flying_share");
    dose(s.range, "range", "dose: chance that what is measured out of range is dropped");
    visit(s.axial_base_m, Field{"axial_base_m", "standard deviation along z at 0.4 m", {0, 1}});
    visit(s.axial_growth_per_m,
          Field{"axial_growth_per_m", "its growth with (z - 0.4 m)^2", {0, 1}});
    visit(s.lateral_px, Field{"lateral_px", "standard deviation across the view", kDose});
    visit(s.baseline_m,
          Field{"baseline_m", "projector to the right of the depth camera", above(0, 1)});
    visit(s.subpixel_px, Field{"subpixel_px", "step of the disparity", above(0, 10)});
    visit(s.grazing_from_deg,
          Field{"grazing_from_deg", "angle of incidence where losses begin", {0, 90}});
    visit(s.grazing_to_deg,
          Field{"grazing_to_deg", "angle of incidence where nothing comes back", {0, 90}});
    visit(s.flying_share,
          Field{"flying_share", "share of the pixels beside a depth edge that fly", {0, 1}});
    visit(s.range_min_m, Field{"range_min_m", "least planar depth that is measured", kMetres});
    visit(s.range_max_m, Field{"range_max_m", "greatest planar depth that is measured", kMetres});
  }
  bool operator==(const DepthDose&) const = default;
};

/// True when every dose is zero.
[[nodiscard]] bool is_zero(const DepthDose& dose);

/// Throws Error naming the key of a number that is out of its range or does not fit another.
void check(const DepthDose& dose);

}  // namespace mapscore::sim
