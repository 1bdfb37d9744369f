// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/lattice_check.hpp"

#include "eval/score/metrics.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mapscore::eval {

void LatticeCheck::add(const ClassCounts& pooled) {
  ClassCounts mapped = pooled;
  mapped.found += mapped.missed_mislabelled;
  least_precision_ = std::min(least_precision_, precision(pooled).value_or(1.0));
  least_mapped_ = std::min(least_mapped_, recall(mapped).value_or(1.0));
  any_ = true;
  any_visible_ = any_visible_ || pooled.visible > 0;
}

std::string LatticeCheck::note() const {
  if (any_ && !any_visible_) return std::string(kNothingVisible);
  if (std::min(least_precision_, least_mapped_) >= kLeast) return "";
  return fmt::format(
      "the lattice ceiling falls to a precision of {:.3f} and maps {:.3f} of the visible voxels, "
      "so images, poses and truth of the recording do not fit each other, or the voxels are too "
      "fine for its depth; no score means much before that is mended (docs/ceilings.md)",
      least_precision_, least_mapped_);
}

}  // namespace mapscore::eval
