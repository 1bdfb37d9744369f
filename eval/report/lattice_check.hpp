// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/score/counts.hpp"

#include <string>

namespace mapscore::eval {

/// Checks by a study's lattice ceilings that its recording and truth belong together: true labels
/// at the true pose must then give an almost perfect map (docs/ceilings.md).
class LatticeCheck {
 public:
  /// Neither precision nor recall of a sound recording is below this.
  static constexpr double kLeast = 0.98;

  /// The table is kept by reference.
  explicit LatticeCheck(const ClassTable& table) : table_(table) {}

  void add(const Counts& ceiling);
  /// What to tell the reader of the scores; empty where all is well.
  [[nodiscard]] std::string note() const;

 private:
  const ClassTable& table_;
  double least_precision_ = 1.0, least_recall_ = 1.0;
};

}  // namespace mapscore::eval
