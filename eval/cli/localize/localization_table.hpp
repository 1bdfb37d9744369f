// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/localization/localization_score.hpp"
#include "eval/report/summary.hpp"
#include "eval/report/tables/table.hpp"
#include "eval/study/study.hpp"

#include <span>
#include <string>
#include <vector>

namespace mapscore::eval {

/// How one pose source did on one recording.
struct SourceScores {
  std::string source;
  std::vector<LocalizationScore> seeds;  ///< one a repetition, at least one
};

/// Errors by frame: localization.csv.
[[nodiscard]] std::string frame_errors_csv(std::span<const SourceScores> sources);

/// ATE, RPE and NEES of all frames, a row a source and seed: localization_scores.csv. Numbers are
/// the shortest texts that read back the same.
[[nodiscard]] std::string scores_csv(std::span<const SourceScores> sources);

/// Errors from convergence on, a row a source and seed.
[[nodiscard]] std::string converged_rows(std::span<const SourceScores> sources);

/// The sources as trials of a study that sweeps over them, with poses alone; what
/// trajectory_scores_table and pose_figure read. `study`: what was localised.
[[nodiscard]] StudySummary pose_summary(const Study& study, std::span<const SourceScores> sources);

/// ATE with its spread over the seeds, RPE and NEES of all frames, a row a source.
[[nodiscard]] Table trajectory_scores_table(const StudySummary& summary);

}  // namespace mapscore::eval
