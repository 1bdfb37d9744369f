// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/lab/frame_yields.hpp"
#include "eval/report/summary.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Results that later ones are held against: counts by method, cell, seed and class, from which
/// figures are formed when they are compared.
struct Baseline {
  int scoring_version = kScoringVersion;
  std::string recording_hash;
  std::string build;  ///< that made the results
  Study study;
  ClassTable table;     ///< the background and the detected classes
  ScoreOptions scored;  ///< tolerances and distances that were counted at
  /// Trials, registration and lattice ceilings; of one that was read, each ceiling once, under the
  /// doses of the first cell it belongs to. Of a count those that voxel_metrics need; no curves,
  /// boxes, bins of distances nor accounting.
  std::vector<ResultLine> lines;
  std::vector<TrialYields> yields = {};  ///< of the trials of the first seed; empty: not kept
};

/// The metrics of metrics_of that a baseline can tell: all of precision, recall, F1 and IoU, at
/// tolerances and by distances too, and mean distances.
[[nodiscard]] std::vector<std::string> voxel_metrics(const Baseline& baseline);

/// Throws Error when several builds made the results.
[[nodiscard]] Baseline baseline_of(const StudySummary& summary);

/// JSON, one line a trial (docs/formats.md). Written aside, then renamed.
void write_baseline(const Baseline& baseline, const std::filesystem::path& file);
/// Throws Error naming the file when it is missing, holds no baseline, or was edited.
[[nodiscard]] Baseline read_baseline(const std::filesystem::path& file);

}  // namespace mapscore::eval
