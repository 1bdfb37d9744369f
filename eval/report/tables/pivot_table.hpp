// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/selection.hpp"
#include "eval/report/tables/table.hpp"

#include <string>
#include <vector>

namespace mapscore::eval {

/// Which figures stand where. What has several values is a dimension: every swept path, or of
/// points over ranges `point`, all paths together; `method`, `class` and `metric`.
struct PivotQuestion {
  std::vector<std::string> groups = {};   ///< none: pooled, or where class has a place, all of them
  std::vector<std::string> metrics = {};  ///< none: f1, or where metric has a place, four
  std::vector<std::string> rows = {}, columns = {};  ///< dimensions; the last varies fastest
  bool spread = false;                               ///< low and high beside each figure
};

/// Whether a dimension stands in its rows or columns.
[[nodiscard]] bool places(const PivotQuestion& question, const std::string& dimension);

/// Figures pooled over the seeds. Without rows, all dimensions of several values but those of the
/// columns stand there; without columns, those but the rows', or the metric. What has one value is
/// told in the caption. A program gets the spread in any case, and what it is in the last column.
/// Throws Error for an unknown dimension, group or metric, one that stands twice, a dimension of
/// several values without a place, and a path of points over ranges.
[[nodiscard]] Table pivot_table(const StudySummary& summary, const PivotQuestion& question,
                                Reader reader = Reader::terminal);

}  // namespace mapscore::eval
