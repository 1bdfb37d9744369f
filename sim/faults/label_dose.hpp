// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <vector>

namespace mapscore::sim {

/// Doses of the faults of an instance segmentation, and the numbers that belong to them
/// (docs/methods.md, "Label faults"). 0 is off; every dose but `boundary_px` is 0 or more.
struct LabelDose {
  double boundary_px = 0.0;  ///< masks grown by so much, shrunk below 0
  double ragged_px = 0.0;    ///< standard deviation of the boundary's place
  double miss = 0.0;         ///< chance to miss an instance of no size, up to 1
  double confusion = 0.0;    ///< chance of a wrong class, the same for all, up to 1
  double scores = 0.0;       ///< how much of 1 - score is kept: 0 all scores are 1, 1 as drawn
  double holes = 0.0;        ///< share of a mask that lies in holes, up to 1
  double islands = 0.0;      ///< share of a mask's surroundings that islands cover, up to 1

  /// In place of `confusion`: row by true class, column by the class that is named, over the
  /// detected classes in their order; rows add up to 1.
  std::vector<std::vector<double>> confusion_matrix = {};

  double ragged_length_px = 8.0;  ///< pitch of the boundary's waves
  double miss_area_px = 1024.0;   ///< size at which the chance of a miss is half of `miss`
  double disc_radius_px = 3.0;    ///< of holes and islands
  double island_reach_px = 20.0;  ///< islands lie within a quarter of it and all of it
  /// Of right and wrong classes; none: the share of right ones, so that scores tell it.
  std::optional<double> score_mean = {};
  double score_concentration = 10.0;  ///< of the distribution of scores; more is narrower

  bool operator==(const LabelDose&) const = default;
};

/// True when detections stay as they are.
[[nodiscard]] bool is_zero(const LabelDose& dose);

/// True when masks stay as they are: no miss, boundary, hole or island.
[[nodiscard]] bool keeps_masks(const LabelDose& dose);

/// Throws Error naming the member when a dose is out of its range or not finite, or a number makes
/// no sense.
void check(const LabelDose& dose);

/// Ready-made segmentations.
enum class LabelPreset {
  ideal,   ///< every dose zero
  typical  ///< a usable network, chosen rather than measured
};

[[nodiscard]] LabelDose label_preset(LabelPreset preset);

}  // namespace mapscore::sim
