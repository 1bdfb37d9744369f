// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/tolerance_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace mapscore::eval {
namespace {

using Row = const ToleranceRow&;

std::optional<double> in_unit(const ToleranceRow& row, const std::optional<double>& dose) {
  return dose ? std::optional(*dose * row.axis.at.front()) : std::nullopt;
}

/// Three digits, or all before the point: 7.12, 1000; `sign`: "+" or none.
std::string dose_text(const ToleranceRow& row, const std::optional<double>& dose,
                      const std::string& sign = "") {
  const std::optional<double> shown = in_unit(row, dose);
  const bool large = shown && std::abs(*shown) >= 999.5;
  return cell_text(shown, "{:" + sign + (large ? ".0f}" : ".3g}"));
}

/// Dose, with the sign as above, and interval.
std::string text_of(const ToleranceRow& row, const Crossing& of, const std::string& sign = "") {
  const std::string unit = row.axis.unit.empty() ? "" : " " + row.axis.unit;
  const auto end = [&](const std::optional<double>& dose) {
    return dose ? dose_text(row, dose) : "open";
  };
  return fmt::format("{}{} [{}, {}]", dose_text(row, of.dose, sign), of.dose ? unit : "",
                     end(of.low), end(of.high));
}

/// The row of the method `reference` for the same fault and group; none where it is this row.
const ToleranceRow* reference_of(const ToleranceRow& row, const std::string& reference,
                                 const std::vector<ToleranceRow>& rows) {
  const auto second = [](const ToleranceRow& of) { return of.second ? of.second->value : ""; };
  const auto at = std::ranges::find_if(rows, [&](const ToleranceRow& other) {
    return other.method == reference && other.path == row.path && other.group == row.group &&
           second(other) == second(row);
  });
  return row.method == reference || at == rows.end() ? nullptr : &*at;
}

std::string caption_of(const Study& study, const ToleranceAim& aim) {
  return fmt::format("{}: largest dose at which {}, with its 95 % interval; voxels of {} m",
                     study.name, aim.text(), study.voxel_m);
}

}  // namespace

std::string ToleranceAim::text() const {
  return target ? fmt::format("{} >= {}", metric, *target)
                : fmt::format("{} loses at most {} against the least dose", metric, loss);
}

std::string text_of(const ToleranceRow& row) {
  const Tolerance& of = row.tolerance;
  const std::string unit = row.axis.unit.empty() ? "" : " " + row.axis.unit;
  const auto end = [&](double dose) { return dose_text(row, dose) + unit; };
  if (of.verdict == ToleranceVerdict::above) return "> " + end(row.search.high);
  if (of.verdict == ToleranceVerdict::below) return "< " + end(row.search.low);
  if (of.verdict == ToleranceVerdict::not_monotone || of.verdict == ToleranceVerdict::undefined)
    return "-";
  return text_of(row, Crossing{of.dose, of.low, of.high});
}

std::string difference_text(const ToleranceRow& row, const ToleranceRow& from) {
  const Crossing of = difference_of(row.tolerance, from.tolerance);
  if (!of.dose && !of.low && !of.high) return "-";
  return text_of(row, of, "+");
}

Table tolerance_table(const Study& study, const ToleranceAim& aim, const std::string& reference,
                      const std::vector<ToleranceRow>& rows, Reader reader) {
  const auto from = [&](const ToleranceRow& row) { return reference_of(row, reference, rows); };
  const auto number = [](const ToleranceRow& row, const std::optional<double>& dose) {
    return nine_digits(in_unit(row, dose));
  };
  const auto difference = [&](const ToleranceRow& row) {
    return from(row) ? difference_of(row.tolerance, from(row)->tolerance) : Crossing{};
  };
  const bool has_second = !rows.empty() && rows.front().second.has_value();
  const bool has_difference = std::ranges::any_of(rows, from);

  std::vector<std::pair<std::string, std::function<std::string(Row)>>> columns;
  columns.emplace_back("fault", [](Row row) { return row.axis.name; });
  if (has_second) columns.emplace_back("at", [](Row row) { return row.second->axis.text(0); });
  columns.emplace_back("method", [](Row row) { return row.method; });
  columns.emplace_back("group", [](Row row) { return row.group; });
  if (reader != Reader::program) {
    columns.emplace_back("tolerance", [](Row row) { return text_of(row); });
    if (has_difference)
      columns.emplace_back("less " + reference, [&](Row row) {
        return from(row) ? difference_text(row, *from(row)) : "";
      });
  } else {
    columns.emplace_back("path", [](Row row) { return row.path; });
    columns.emplace_back("unit", [](Row row) { return row.axis.unit; });
    columns.emplace_back("dose", [&](Row row) { return number(row, row.tolerance.dose); });
    columns.emplace_back("low", [&](Row row) { return number(row, row.tolerance.low); });
    columns.emplace_back("high", [&](Row row) { return number(row, row.tolerance.high); });
    columns.emplace_back("reference", [&](Row row) { return from(row) ? reference : ""; });
    columns.emplace_back("difference", [&](Row row) { return number(row, difference(row).dose); });
    columns.emplace_back("difference_low",
                         [&](Row row) { return number(row, difference(row).low); });
    columns.emplace_back("difference_high",
                         [&](Row row) { return number(row, difference(row).high); });
  }
  columns.emplace_back("verdict",
                       [](Row row) { return std::string(name_of(row.tolerance.verdict)); });
  columns.emplace_back("trials", [](Row row) { return std::to_string(row.tolerance.trials); });
  columns.emplace_back("undefined",
                       [](Row row) { return std::to_string(row.tolerance.undefined); });

  Table table;
  table.caption = {
      caption_of(study, aim),
      "found: crosses within the range; above, below: keeps it, misses it over the whole range; "
      "open: the trials do not tell where; not monotone: crosses it more than once; undefined: "
      "too few scores, or none to lose"};
  table.keys = has_second ? 4 : 3;
  for (const auto& [name, text] : columns) table.columns.push_back(name);
  for (Row row : rows) {
    auto& cells = table.rows.emplace_back();
    for (const auto& [name, text] : columns) cells.push_back(text(row));
  }
  return table;
}

Table tolerance_matrix(const Study& study, const ToleranceAim& aim,
                       const std::vector<ToleranceRow>& rows) {
  const auto differs = [&](const auto& value_of) {
    return std::ranges::any_of(
        rows, [&](const ToleranceRow& row) { return value_of(row) != value_of(rows.front()); });
  };
  const auto second_of = [](const ToleranceRow& row) {
    return row.second ? row.second->axis.text(0) : "";
  };
  const bool seconds = differs(second_of), groups = differs([](Row row) { return row.group; });
  Table table;
  table.caption = {
      caption_of(study, aim),
      "open: this side is not bounded by the trials; - alone: crosses it more than once, or "
      "too few scores, or none to lose"};
  table.columns = {"fault"};
  if (seconds) table.columns.emplace_back("at");
  if (groups) table.columns.emplace_back("group");
  std::vector<std::string> last;
  for (const ToleranceRow& row : rows) {
    std::vector<std::string> cells{row.axis.name};
    if (seconds) cells.push_back(second_of(row));
    if (groups) cells.push_back(class_title(study, row.group));
    if (cells != std::exchange(last, cells)) table.rows.push_back(cells);
    if (table.rows.size() == 1) table.columns.push_back(method_title(study, row.method));
    table.rows.back().push_back(text_of(row));
  }
  return table;
}

}  // namespace mapscore::eval
