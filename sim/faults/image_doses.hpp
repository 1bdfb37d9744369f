// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

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
  static constexpr Field kScale{.key = "scale",
                                .meaning = "multiplies every dose",
                                .range = {0, 100},
                                .figure = "depth errors (× the preset's)",
                                .later = true};

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

/// Ready-made segmentations.
enum class LabelPreset {
  ideal,   ///< every dose zero
  typical  ///< a usable network, chosen rather than measured
};
constexpr auto names_of(LabelPreset) {
  return std::to_array<std::string_view>({"ideal", "typical"});
}

/// Doses of the faults of an instance segmentation, and the numbers that belong to them
/// (docs/methods.md, "Label faults"). 0 is off; every dose but `boundary_px` is 0 or more.
struct LabelDose {
  using Preset = LabelPreset;
  static constexpr Field kPreset{.key = "preset",
                                 .meaning =
                                     "segmentation that the other keys start from; ideal: "
                                     "no fault",
                                 .figure = "2D segmentation",
                                 .later = true};
  static constexpr Field kScale{.key = "scale",
                                .meaning = "multiplies every dose",
                                .range = {0, 100},
                                .figure = "label errors (× the preset's)",
                                .later = true};

  double boundary_px = 0, ragged_px = 0, miss = 0, confusion = 0, scores = 0, holes = 0,
         islands = 0;
  std::vector<std::vector<double>> confusion_matrix = {};
  double ragged_length_px = 8, miss_area_px = 1024, disc_radius_px = 3, island_reach_px = 20;
  std::optional<double> score_mean = {};  ///< empty: the chance of a right class
  double score_concentration = 10;        ///< more is narrower

  [[nodiscard]] static LabelDose of(LabelPreset preset);
  /// A confusion matrix takes the place of `confusion` and is scaled off its diagonal, which takes
  /// the rest of 1.
  void scale_by(double factor);

  static void fields(auto& s, auto&& visit) {
    constexpr Range kShare{0, 1}, kPixels{1, 1000};
    const auto dose = [&](auto& member, std::string_view key, std::string_view meaning,
                          Range range = {0, 1}, std::string_view figure = {}) {
      visit(member,
            Field{.key = key, .meaning = meaning, .range = range, .figure = figure, .dose = true});
    };
    dose(s.boundary_px, "boundary_px", "dose: masks grown, or shrunk below 0", {-1000, 1000},
         "label boundary off by (px)");
    dose(s.ragged_px, "ragged_px", "dose: standard deviation of the boundary's place", {0, 1000});
    dose(s.miss, "miss", "dose: chance to miss an instance of no size", {0, 1},
         "chance to miss an instance");
    dose(s.confusion, "confusion", "dose: chance of a wrong class, even over the detected ones");
    dose(s.scores, "scores", "dose: how much of 1 - score is kept; 0: every score is 1");
    dose(s.holes, "holes", "dose: share of a mask that lies in holes");
    dose(s.islands, "islands", "dose: share of a mask's surroundings that islands cover");
    visit(s.confusion_matrix,
          Field{"confusion_matrix",
                "in place of confusion: row by true class, column by named class, over the "
                "detected classes in their order; rows add up to 1",
                kShare});
    visit(s.ragged_length_px, Field{"ragged_length_px", "pitch of the boundary's waves", kPixels});
    visit(s.miss_area_px,
          Field{"miss_area_px", "pixels of an instance at which its chance is half of miss",
                above(0, 1e9)});
    visit(s.disc_radius_px, Field{"disc_radius_px", "radius of holes and islands", kPixels});
    visit(s.island_reach_px,
          Field{"island_reach_px", "islands lie within a quarter of it and all of it", kPixels});
    visit(s.score_mean,
          Field{"score_mean",
                "mean of the scores of right and wrong classes together, at dose 1; default: the "
                "chance of a right class, with which scores are calibrated",
                kShare});
    visit(s.score_concentration,
          Field{"score_concentration", "of the Beta distribution of scores", above(0, 1e6)});
  }
  bool operator==(const LabelDose&) const = default;
};

/// True when detections stay as they are.
[[nodiscard]] bool is_zero(const LabelDose& dose);

/// True when masks stay as they are: no miss, boundary, hole or island.
[[nodiscard]] bool keeps_masks(const LabelDose& dose);

/// The dose without wrong classes and scores, which images of instance ids cannot express.
[[nodiscard]] LabelDose masks_alone(LabelDose dose);

/// Throws Error naming the key of a number that is out of its range or does not fit another. A
/// scaled share may be above 1, and counts as 1.
void check(const LabelDose& dose);

}  // namespace mapscore::sim
