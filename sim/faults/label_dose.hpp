// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace mapscore::sim {

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
    dose(s.miss, "miss", "dose: chance to miss an instance of no size");
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
          Field{"score_mean", "mean score; default: the chance of a right class", kShare});
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
