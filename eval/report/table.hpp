// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/objects/true_objects.hpp"
#include "eval/report/summary.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// A table for people: a caption of what it stands on, column names, cells as text (`-` is
/// undefined).
struct Table {
  std::vector<std::string> caption;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// A figure as the text of a cell; `format` is one of fmt.
[[nodiscard]] std::string cell_text(const std::optional<double>& value,
                                    std::string_view format = "{:.3f}");

/// A figure for programs, as CSV has it: nine significant digits, `-` where undefined.
[[nodiscard]] std::string nine_digits(const std::optional<double>& value);

/// Scores of every method at every cell for one group of classes ("pooled", "macro" or a class), at
/// tolerance 0 and, where scored, 1, by distance and of instances, with both ceilings.
[[nodiscard]] Table score_table(const StudySummary& summary, const std::string& group);

/// Scores of an object map: a row for each detected class that has an object in the truth or the
/// map, and one for all. `counts`: by class id.
[[nodiscard]] Table object_table(const std::vector<ObjectCounts>& counts, const ClassTable& table);

/// Column of a swept path: its last part, or all of it where two end alike.
[[nodiscard]] std::string column_of(const SweepAxis& axis, const std::vector<SweepAxis>& sweep);

[[nodiscard]] std::string to_text(const Table& table);
[[nodiscard]] std::string to_csv(const Table& table);
[[nodiscard]] std::string to_json(const Table& table);
/// A table of GitHub's Markdown; the caption above it, a line each.
[[nodiscard]] std::string to_markdown(const Table& table);
/// A tabular of LaTeX with booktabs' rules; the caption above it as comments.
[[nodiscard]] std::string to_tex(const Table& table);
/// Several tables as one list.
[[nodiscard]] std::string to_json(const std::vector<Table>& tables);

}  // namespace mapscore::eval
