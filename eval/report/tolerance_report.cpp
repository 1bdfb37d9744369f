// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/tolerance_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mapscore::eval {
namespace {

std::string in_unit(const ToleranceRow& row, const std::optional<double>& dose,
                    std::string (*text)(const std::optional<double>&)) {
  return text(dose ? std::optional(*dose * row.axis.at.front()) : std::nullopt);
}

std::string three_digits(const std::optional<double>& value) {
  return cell_text(value, "{:.3g}");
}

}  // namespace

std::string ToleranceAim::text() const {
  return target ? fmt::format("{} >= {}", metric, *target)
                : fmt::format("{} loses at most {}", metric, loss);
}

std::string text_of(const ToleranceRow& row) {
  const Tolerance& of = row.tolerance;
  const std::string unit = row.axis.unit.empty() ? "" : " " + row.axis.unit;
  const auto end = [&](const std::optional<double>& dose) {
    return dose ? in_unit(row, dose, three_digits) : "open";
  };
  if (of.verdict == ToleranceVerdict::above) return "> " + end(row.search.high) + unit;
  if (of.verdict == ToleranceVerdict::below) return "< " + end(row.search.low) + unit;
  if (of.verdict == ToleranceVerdict::not_monotone || of.verdict == ToleranceVerdict::undefined)
    return "-";
  return fmt::format("{}{} [{}, {}]", in_unit(row, of.dose, three_digits), of.dose ? unit : "",
                     end(of.low), end(of.high));
}

Table tolerance_table(const Study& study, const ToleranceAim& aim,
                      const std::vector<ToleranceRow>& rows, bool for_people) {
  Table table;
  table.caption = {
      fmt::format("{}: largest dose at which {}, with its 95 % interval; voxels of {} m",
                  study.name, aim.text(), study.voxel_m),
      "found: crosses within the range; above, below: keeps it, misses it over the whole range; "
      "open: the trials do not tell where; not monotone: crosses it more than once"};
  table.columns = {"fault", "method", "group"};
  if (for_people)
    table.columns.push_back("tolerance");
  else
    table.columns.insert(table.columns.end(), {"path", "unit", "dose", "low", "high"});
  table.columns.insert(table.columns.end(), {"verdict", "trials", "undefined"});
  for (const ToleranceRow& row : rows) {
    const Tolerance& of = row.tolerance;
    std::vector<std::string> cells{row.axis.name, row.method, row.group};
    if (for_people)
      cells.push_back(text_of(row));
    else
      cells.insert(cells.end(),
                   {row.path, row.axis.unit, in_unit(row, of.dose, nine_digits),
                    in_unit(row, of.low, nine_digits), in_unit(row, of.high, nine_digits)});
    cells.insert(cells.end(), {std::string(name_of(of.verdict)), std::to_string(of.trials),
                               std::to_string(of.undefined)});
    table.rows.push_back(std::move(cells));
  }
  return table;
}

}  // namespace mapscore::eval
