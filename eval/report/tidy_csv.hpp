// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/summary.hpp"

#include <iosfwd>

namespace mapscore::eval {

/// Counts, then figures, of one group of classes: what the tidy CSV holds of it.
[[nodiscard]] std::vector<Metric> tidy_metrics(const Counts& counts, const ClassTable& table,
                                               std::string_view group);

/// Tidy CSV: one row a trial (ceilings included), class and metric, counts among the metrics.
/// Columns: role, method, seed, one a swept path, class, metric, value; `-` is undefined. Same
/// study, same bytes.
void write_tidy_csv(const StudySummary& summary, std::ostream& out);

}  // namespace mapscore::eval
