// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/edge_aligned/matched_edges.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"

#include <vector>

namespace mapscore {

/// A correction that a fit starts from, and what its first stages may change.
struct AlignmentStart : OutlineAlignment {
  enum class Family { none, turn, shift } family = Family::none;
};

/// How far from the image's middle the outlines' pixels lie, root mean square, as far as this tells
/// a roll, and a focal length, from turns, the masks' size and the other of the two.
struct Levers {
  float roll_px = 0, focal_px = 0;
};
[[nodiscard]] Levers levers_of(const OutlineField& field, const Projection& project);

/// What corrections cost, as a share of the outlines: they need evidence, and a short outline holds
/// little, since it fits somewhere by chance.
class CorrectionCost {
 public:
  CorrectionCost(const Projection& project, int outline_px)
      : project_(project), outline_px_(static_cast<float>(outline_px)) {}

  [[nodiscard]] float operator()(const OutlineAlignment& a) const;

  /// How much more an offset of all outlines, roll and focal length must be shown where edges
  /// explain less than half of them: most of the others, as between flush fronts, would show it if
  /// they were steps. `share`: of the outlines.
  [[nodiscard]] static float unexplained(float share);

  static constexpr float kShort_px = 150.0F;  ///< outlines of this length cost twice as much

 private:
  Projection project_;
  float outline_px_;
};

/// The corrections that a fit starts from: none, which is believed unless something better is
/// found; none from farther away, with offsets; the best turns up to `search_px` and shifts, and
/// `with_roll` those of rolled images, by their fit at quarter size less their cost: the best by
/// `few_edges` are compared by `edges`.
[[nodiscard]] std::vector<AlignmentStart> alignment_starts(
    const EdgeColumns& few_edges, const EdgeColumns& edges, const OutlineField& field,
    const Projection& project, const CorrectionCost& cost, float search_px, bool with_roll);

/// No correction, of masks that are right, too small and too large.
[[nodiscard]] std::vector<AlignmentStart> mask_size_starts(AlignmentStart::Family family);

}  // namespace mapscore
