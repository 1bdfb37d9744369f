// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/lab/trial_run.hpp"
#include "eval/report/summary.hpp"

#include <iosfwd>
#include <span>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// Counts, then figures, of one group of classes: what the tidy CSV holds of it.
[[nodiscard]] std::vector<Metric> tidy_metrics(const Counts& counts, const ClassTable& table,
                                               std::string_view group);

/// Tidy CSV: one row a trial (ceilings included), class and metric, counts among the metrics.
/// Columns: role, method, seed, one a swept path, class, metric, value; `-` is undefined. Same
/// study, same bytes.
void write_tidy_csv(const StudySummary& summary, std::ostream& out);

/// Tidy CSV of the frames of one trial, each scored by itself: columns frame, stamp_s, class
/// (detected ones, then pooled), metric, value. Same frames, same bytes.
void write_frames_csv(std::span<const FrameResult> frames, const ClassTable& table,
                      std::ostream& out);

}  // namespace mapscore::eval
