// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/exploration/exploration_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

/// A figure over the starts, with the format of its text.
struct SpreadColumn {
  const char *name, *format;
  SeedSummary ExplorationGroup::*figure;
};
constexpr SpreadColumn kWayToShare{"metres to 90 %", "{:.1f}", &ExplorationGroup::metres_at_most};
constexpr SpreadColumn kOthers[] = {
    {"area (metres)", "{:.3f}", &ExplorationGroup::area_metres},
    {"area (seconds)", "{:.3f}", &ExplorationGroup::area_seconds},
    {"coverage", "{:.3f}", &ExplorationGroup::coverage},
    {"F1", "{:.3f}", &ExplorationGroup::f1},
    {"driven (m)", "{:.1f}", &ExplorationGroup::driven_m},
    {"views", "{:.0f}", &ExplorationGroup::views},
};

std::string scene_of_row(const ExplorationGroup& group) {
  for (const auto& [path, value] : group.doses)
    if (path == kSceneAxis) return value;
  return "";
}

std::string ends_text(const ExplorationGroup& group) {
  std::string text;
  for (const auto& [end, count] : group.ends)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, end);
  return text;
}

/// Columns and cells of one row, side by side.
class ExplorationRow {
 public:
  ExplorationRow(const ExplorationGroup& group, Reader reader) : group_(group), reader_(reader) {}

  void add(std::string column, std::string cell) {
    columns.push_back(std::move(column));
    cells.push_back(std::move(cell));
  }

  void add(const SpreadColumn& column) {
    const SeedSummary& figure = group_.*column.figure;
    const std::string name = column.name;
    if (reader_ == Reader::program) {
      add(name, nine_digits(figure.mean));
      add(name + " low", nine_digits(figure.low));
      add(name + " high", nine_digits(figure.high));
      return;
    }
    std::string text = cell_text(figure.mean, column.format);
    if (figure.seeds > 1 && figure.low && figure.high)
      text += fmt::format(" [{}, {}]", cell_text(figure.low, column.format),
                          cell_text(figure.high, column.format));
    add(name, text);
  }

  void add_reached() {
    if (reader_ != Reader::program)
      return add("reached", fmt::format("{}/{}", group_.reached, group_.runs.size()));
    add("reached", fmt::format("{}", group_.reached));
    add("starts", fmt::format("{}", group_.runs.size()));
  }

  void add_ends() {
    if (reader_ != Reader::program) return add("ends", ends_text(group_));
    for (const std::string_view end : names_of(ExplorationEnd{})) {
      const auto count = group_.ends.find(std::string(end));
      add(std::string(end), fmt::format("{}", count == group_.ends.end() ? 0 : count->second));
    }
  }

  std::vector<std::string> columns, cells;

 private:
  const ExplorationGroup& group_;
  Reader reader_;
};

/// `first`: of the same scene and method, for which the first planner is the measure.
ExplorationRow exploration_row(const Study& study, const ExplorationGroup& first,
                               const ExplorationGroup& group, Reader reader) {
  ExplorationRow row(group, reader);
  for (const auto& [path, value] : group.doses)
    row.add(path.substr(path.find_last_of('.') + 1), value);
  if (study.methods.size() > 1) row.add("method", group.method);
  row.add(kWayToShare);
  row.add_reached();
  const auto &a = first.metres_at_most.mean, &b = group.metres_at_most.mean;
  const auto ratio = a && b && *b > 0.0 ? std::optional(*a / *b) : std::nullopt;
  row.add("first / this",
          reader == Reader::program ? nine_digits(ratio) : cell_text(ratio, "{:.2f}"));
  for (const SpreadColumn& column : kOthers) row.add(column);
  row.add("bumps", fmt::format("{}", group.bump_contacts));
  row.add_ends();
  return row;
}

std::string exploration_caption(const Study& study, const std::vector<ExplorationGroup>& groups,
                                Reader reader) {
  std::string spread;
  if (!groups.empty() && groups.front().runs.size() > 1)
    spread = fmt::format(
        fmt::runtime(reader == Reader::program ? "; mean; low, high: {}" : "; mean [{}]"),
        name_of(groups.front().metres_at_most.kind));
  return fmt::format(
      "{}: metres to {:.0f} % of the visible surface, budget where it is not reached; area under "
      "the coverage up to the budget{}",
      study.name, 100.0 * kCoveredShare, spread);
}

}  // namespace

Table exploration_table(const Study& study, const std::vector<ExplorationGroup>& groups,
                        Reader reader) {
  Table table;
  table.caption = {exploration_caption(study, groups, reader)};
  for (const ExplorationGroup& group : groups) {
    const auto first = std::ranges::find_if(groups, [&](const ExplorationGroup& other) {
      return scene_of_row(other) == scene_of_row(group) && other.method == group.method;
    });
    ExplorationRow row = exploration_row(study, *first, group, reader);
    table.columns = std::move(row.columns);
    table.rows.push_back(std::move(row.cells));
    table.keys = group.doses.size() + (study.methods.size() > 1 ? 1 : 0);
  }
  return table;
}

}  // namespace mapscore::eval
