// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/sweep/tolerance_rows.hpp"

#include "core/error.hpp"
#include "eval/report/regression.hpp"
#include "eval/report/selection.hpp"
#include "eval/report/summary.hpp"
#include "eval/statistics/frontier.hpp"
#include "files/suggestion.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace mapscore::eval {
namespace {

/// The chosen names, or all where none is chosen. Throws Error on one that is not there.
std::vector<std::string> chosen(const char* flag, const std::vector<std::string>& names,
                                const std::vector<std::string>& known) {
  for (const std::string& name : names)
    require_one_of(known, name, fmt::format("{} {}: not in this study", flag, name));
  return names.empty() ? known : names;
}

/// The doses of a swept path, ascending.
std::vector<double> doses_of(const Study& study, const std::string& path) {
  std::vector<double> doses;
  for (const std::string& value : std::ranges::find(study.sweep, path, &SweepAxis::path)->values) {
    const std::optional<double> number = parse_real(value);
    if (!number)
      throw Error(
          fmt::format("sweep.{}: {} is no number; a tolerance is that of a dose", path, value));
    doses.push_back(*number);
  }
  std::ranges::sort(doses);
  if (doses.front() == doses.back())
    throw Error(
        fmt::format("sweep.{}: gives no range of doses; write its least and its greatest", path));
  return doses;
}

/// A search of a swept path, without trials.
ToleranceRow row_of(const Study& study, const ToleranceAim& aim, const std::string& path,
                    const std::optional<SecondFault>& second, const std::string& group,
                    const std::string& method) {
  const std::vector<double> doses = doses_of(study, path);
  const ToleranceSearch search{doses.front(), doses.back(), aim.target.value_or(-aim.loss),
                               aim.trials};
  const FigureAxis axis = figure_axis(field_of(study, path), {"1"});
  return {path, axis, second, method, group, search, {}, {}};
}

/// A fault at each of these doses, ascending, the first being the least of its `range`; those that
/// one text stands for are one.
std::vector<std::optional<SecondFault>> second_faults(const Study& study, const std::string& path,
                                                      const std::vector<double>& doses,
                                                      const ToleranceSearch& range) {
  std::vector<std::optional<SecondFault>> faults;
  for (const double dose : doses) {
    const std::string text = dose_text(study, path, range, dose);
    if (!faults.empty() && faults.back()->value == text) continue;
    const std::string least = faults.empty() ? text : faults.front()->value;
    faults.push_back(SecondFault{path, text, figure_axis(field_of(study, path), {text}), least});
  }
  return faults;
}

/// Throws Error when the study may not have these faults without its other swept ones.
void check_alone(Study study, const std::string& path, const std::string& against) {
  const std::vector<SweepAxis> sweep = std::move(study.sweep);
  study.sampling = {};
  study.sweep.clear();
  for (const SweepAxis& axis : sweep)
    if (axis.path == path || axis.path == against) study.sweep.push_back(axis);
  check(study);
}

}  // namespace

ToleranceChoice with_whole_paths(const Study& study, ToleranceChoice choice) {
  const auto complete = [&](std::string& name) {
    if (const auto axis = swept_axis(study, name)) name = study.sweep[*axis].path;
  };
  std::ranges::for_each(choice.faults, complete);
  complete(choice.against);
  return choice;
}

std::vector<ToleranceRow> tolerance_searches(const Study& study, const ClassTable& table,
                                             const ToleranceAim& aim,
                                             const ToleranceChoice& choice) {
  if (study.sweep.empty())
    throw Error(
        "sweep: is empty, so no fault has a range of doses; write one into the study, or --set "
        "sweep.faults.misregistration.magnitude_m=[0,0.04]");
  std::vector<std::string> paths, groups{std::string(kPooled), std::string(kMacro)};
  for (const SweepAxis& axis : study.sweep)
    if (axis.path != choice.against) paths.push_back(axis.path);
  if (!choice.against.empty() && paths.size() == study.sweep.size())
    static_cast<void>(chosen("--against", {choice.against}, paths));
  if (paths.empty() || std::ranges::count(choice.faults, choice.against) > 0)
    throw Error(fmt::format("--against {}: is the fault that is searched; sweep another beside it",
                            choice.against));
  if (!higher_is_better(aim.metric))
    throw Error(
        fmt::format("--metric {}: rises with the dose; take one that falls, as f1", aim.metric));
  for (const std::string& name : detected_names(table)) groups.push_back(name);
  std::vector<std::string> of_groups = choice.groups;
  if (of_groups.empty()) of_groups = {std::string(kPooled)};
  if (of_groups == std::vector<std::string>{"all"}) of_groups.clear();

  std::vector<ToleranceRow> rows;
  const std::string& against = choice.against;
  std::vector<double> of_against;
  if (!against.empty()) of_against = doses_of(study, against);
  const bool of_second = of_against.size() == 2;
  for (const std::string& path : chosen("--fault", choice.faults, paths)) {
    const std::vector<double> doses = doses_of(study, path);
    check_alone(study, path, against);
    std::vector<std::optional<SecondFault>> seconds{std::nullopt};
    if (of_second)
      seconds = second_faults(study, path, {doses.front()}, {doses.front(), doses.back()});
    else if (!against.empty())
      seconds = second_faults(study, against, of_against, {of_against.front(), of_against.back()});
    for (const auto& second : seconds)
      for (const std::string& group : chosen("--group", of_groups, groups))
        for (const std::string& method : chosen("--method", choice.methods, method_names(study)))
          rows.push_back(row_of(study, aim, of_second ? against : path, second, group, method));
  }
  return rows;
}

std::vector<ToleranceRow> frontier_searches(const Study& study, const ToleranceAim& aim,
                                            const ToleranceChoice& choice,
                                            const std::vector<ToleranceRow>& done) {
  std::vector<ToleranceRow> rows;
  if (choice.against.empty() || doses_of(study, choice.against).size() > 2) return rows;
  for (auto first = done.begin(); first != done.end();) {
    const auto last = std::find_if(first, done.end(), [&](const ToleranceRow& row) {
      return row.group != first->group || row.second->path != first->second->path;
    });
    std::vector<Tolerance> alone;
    for (auto row = first; row != last; ++row) alone.push_back(row->tolerance);
    const auto [low, high] = std::pair(first->search.low, first->search.high);
    const std::vector<double> doses = frontier_doses(low, high, alone);
    // Within the range, so that none but its own ends keep all their digits.
    const ToleranceSearch range{low, doses.back() < high ? 2.0 * doses.back() - low : high};
    for (const auto& second : second_faults(study, choice.against, doses, range))
      for (auto row = first; row != last; ++row)
        rows.push_back(row_of(study, aim, row->second->path, second, row->group, row->method));
    first = last;
  }
  return rows;
}

std::string dose_text(Study study, const std::string& path, const ToleranceSearch& search,
                      double dose) {
  const int decade = static_cast<int>(std::floor(std::log10(search.high - search.low)));
  const double step = std::pow(10.0, decade - 3);
  constexpr int kMostDigits = 17;
  double rounded = std::clamp(std::round(dose / step) * step, search.low, search.high);
  int digits = std::clamp(3 - decade, 0, kMostDigits);
  for (const double end : {search.low, search.high})
    if (std::abs(dose - end) < 0.5 * step) {
      rounded = end;
      digits = kMostDigits;
    }
  set_leaf(study, path, fmt::format("{:.{}f}", rounded, digits));
  return leaf_text(study, path);
}

}  // namespace mapscore::eval
