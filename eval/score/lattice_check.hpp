// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/score/counts.hpp"

#include <string>
#include <string_view>

namespace mapscore::eval {

/// Checks by a study's lattice ceilings that its recording and truth belong together: true labels
/// at the true pose must then give an almost perfect map (docs/ceilings.md). A visible voxel that
/// another class got is not missed here: surfaces of both lie in it.
class LatticeCheck {
 public:
  /// Neither the precision of a sound recording nor its mapped share is below this.
  static constexpr double kLeast = 0.98;

  /// What to tell where no trial sees a truth voxel of a detected class.
  static constexpr std::string_view kNothingVisible =
      "no truth voxel of a detected class was visible in any trial, so every score is undefined; "
      "detect classes that the drive sees, or drive where they stand";

  /// The table is kept by reference.
  explicit LatticeCheck(const ClassTable& table) : table_(table) {}

  void add(const Counts& ceiling) { add(pool_detected(ceiling, table_)); }
  /// Its counts over the detected classes.
  void add(const ClassCounts& pooled);
  /// What to tell the reader of the scores; empty where all is well.
  [[nodiscard]] std::string note() const;

 private:
  const ClassTable& table_;
  double least_precision_ = 1.0, least_mapped_ = 1.0;
  bool any_ = false, any_visible_ = false;  ///< truth voxels of detected classes
};

}  // namespace mapscore::eval
