// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/objects/true_objects.hpp"
#include "eval/report/summary.hpp"

#include <cstddef>
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
  std::size_t keys = 1;  ///< columns on the left that say what a row is
};

/// Whom a table is for: a terminal and a paper get a few decimals, a program nine significant
/// digits; a paper gets titles and units where the others get names and paths as in the study.
enum class Reader { terminal, program, paper };

/// A figure as the text of a cell; `format` is one of fmt.
[[nodiscard]] std::string cell_text(const std::optional<double>& value,
                                    std::string_view format = "{:.3f}");

/// A figure for programs, as CSV has it: nine significant digits, `-` where undefined.
[[nodiscard]] std::string nine_digits(const std::optional<double>& value);

/// Scores of every method at every cell for one group of classes ("pooled", "macro" or a class), at
/// tolerance 0 and, where scored, 1, by distance and of instances, with the spread of F1 over the
/// seeds and both ceilings. For programs a further column says what the spread is.
[[nodiscard]] Table score_table(const StudySummary& summary, const std::string& group,
                                Reader reader = Reader::terminal);

/// Scores of an object map: a row for each detected class that has an object in the truth or the
/// map, and one for all. `counts`: by class id.
[[nodiscard]] Table object_table(const std::vector<ObjectCounts>& counts, const ClassTable& table);

/// Throws Error, with the nearest name, unless the group of a study has such a metric, or it is
/// kBestF1 or kBestThreshold.
void check_metric(const StudySummary& summary, const std::string& group, const std::string& metric);

/// "voxels of 5 cm; 6 seeds; each map scored": what every caption of a study says.
[[nodiscard]] std::string scoring_text(const Study& study);

/// Column of a swept path: its last part, or all of it where two end alike.
[[nodiscard]] std::string column_of(const SweepAxis& axis, const std::vector<SweepAxis>& sweep);

// What a reader reads of a study's names.
[[nodiscard]] std::vector<std::string> dose_columns(const Study& study, Reader reader);
[[nodiscard]] std::vector<std::string> dose_texts(const Study& study, const Cell& cell,
                                                  Reader reader);
[[nodiscard]] std::string method_text(const Study& study, const std::string& name, Reader reader);
/// "F1" for f1, "F at 2 cm" for f_2cm; a name that is a word of the field as it is.
[[nodiscard]] std::string metric_text(const std::string& name, Reader reader);

}  // namespace mapscore::eval
