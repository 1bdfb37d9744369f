// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/selection.hpp"

#include "core/error.hpp"
#include "eval/report/tables/table.hpp"
#include "files/suggestion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace mapscore::eval {
namespace {

/// Values of a swept path that cells have: the listed ones, or those of points over its range.
std::vector<std::string> values_of(const Study& study, std::size_t axis) {
  if (points_of(study.sampling) == 0) return study.sweep[axis].values;
  std::set<std::string> values;
  for (const Cell& cell : cells(study)) values.insert(cell.doses[axis].second);
  return {values.begin(), values.end()};
}

/// Values that are wanted of each swept path; one that is not asked for has none.
std::vector<std::set<std::string>> wanted_values(const Study& study,
                                                 const std::vector<std::string>& where) {
  std::vector<std::set<std::string>> wanted(study.sweep.size());
  for (const std::string& text : where) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos)
      throw Error(fmt::format(
          "--where {}: must be path=value, e.g. faults.misregistration.magnitude_m=0.02", text));
    const std::string path = text.substr(0, equals);
    const auto axis = swept_axis(study, path);
    if (!axis)
      throw Error(fmt::format("--where {}: '{}' is not swept; {}", text, path,
                              suggestion(path, swept_names(study))));
    const SweepAxis& swept = study.sweep[*axis];
    const std::string value = canonical_value(study, swept.path, text.substr(equals + 1));
    const std::vector<std::string> values = values_of(study, *axis);
    if (std::ranges::count(values, value) == 0)
      throw Error(fmt::format("--where {}: {} has no such value; there are: {}", text, swept.path,
                              fmt::join(values, ", ")));
    wanted[*axis].insert(value);
  }
  return wanted;
}

}  // namespace

std::optional<std::size_t> swept_axis(const Study& study, const std::string& name) {
  std::vector<std::string> paths;
  for (const SweepAxis& axis : study.sweep) paths.push_back(axis.path);
  const auto path = path_named(name, paths);
  if (!path) return std::nullopt;
  return static_cast<std::size_t>(std::ranges::find(paths, *path) - paths.begin());
}

std::string canonical_value(Study study, const std::string& path, const std::string& value) {
  set_leaf(study, path, value);
  return leaf_text(study, path);
}

std::vector<std::string> swept_names(const Study& study) {
  std::vector<std::string> names;
  for (const SweepAxis& axis : study.sweep) names.push_back(axis.path);
  for (const SweepAxis& axis : study.sweep)
    if (column_of(axis, study.sweep) != axis.path) names.push_back(column_of(axis, study.sweep));
  return names;
}

StudySummary selected(StudySummary summary, const Selection& selection) {
  const std::vector<std::set<std::string>> wanted = wanted_values(summary.study, selection.where);
  for (const std::string& method : selection.methods)
    require_one_of(method_names(summary.study), method,
                   fmt::format("no method '{}' in this study", method));
  const auto is_wanted = [&](const ResultLine& line) {
    for (std::size_t axis = 0; axis < wanted.size(); ++axis)
      if (!wanted[axis].empty() && !wanted[axis].contains(line.cell.doses[axis].second))
        return false;
    return selection.methods.empty() || std::ranges::count(selection.methods, line.method) > 0;
  };
  for (auto* lines : {&summary.trials, &summary.registration_ceilings, &summary.lattice_ceilings})
    std::erase_if(*lines, [&](const ResultLine& line) { return !is_wanted(line); });
  if (summary.trials.empty()) throw Error("no trial of these is there yet; wait, or ask for more");
  ResultLine& first = summary.trials.front();  // which tells what there is
  if (first.pooled.empty()) first.pooled = loaded(first).pooled;
  return summary;
}

}  // namespace mapscore::eval
