// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/summary.hpp"

#include <iosfwd>

namespace mapscore::eval {

/// Tidy CSV: one row a trial (ceilings included), class and metric, counts among the metrics.
/// Columns: role, method, seed, one a swept path, class, metric, value; `-` is undefined. Same
/// study, same bytes.
void write_tidy_csv(const StudySummary& summary, std::ostream& out);

}  // namespace mapscore::eval
