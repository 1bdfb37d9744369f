// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/lattice_check.hpp"

#include "eval/score/metrics.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mapscore::eval {

void LatticeCheck::add(const Counts& ceiling) {
  const ClassCounts pooled = pool_detected(ceiling, table_);
  least_precision_ = std::min(least_precision_, precision(pooled).value_or(1.0));
  least_recall_ = std::min(least_recall_, recall(pooled).value_or(1.0));
}

std::string LatticeCheck::note() const {
  if (std::min(least_precision_, least_recall_) >= kLeast) return "";
  return fmt::format(
      "the lattice ceiling falls to a precision of {:.3f} and a recall of {:.3f}, so images, poses "
      "and truth of the recording do not fit each other, or the voxels are too fine for its depth; "
      "no score means much before that is mended (docs/ceilings.md)",
      least_precision_, least_recall_);
}

}  // namespace mapscore::eval
