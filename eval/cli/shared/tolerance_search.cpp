// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/tolerance_search.hpp"

#include "core/error.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/lab/runner.hpp"
#include "eval/report/regression.hpp"
#include "eval/report/summary.hpp"
#include "files/suggestion.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

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
std::vector<double> doses_of(const SweepAxis& axis) {
  std::vector<double> doses;
  for (const std::string& value : axis.values) {
    const std::optional<double> number = parse_real(value);
    if (!number)
      throw Error(fmt::format("sweep.{}: {} is no number; a tolerance is that of a dose", axis.path,
                              value));
    doses.push_back(*number);
  }
  std::ranges::sort(doses);
  if (doses.front() == doses.back())
    throw Error(fmt::format("sweep.{}: gives no range of doses; write its least and its greatest",
                            axis.path));
  return doses;
}

/// A dose in a thousandth of the decade of the range, or an end of it as it is, as the study's
/// canonical text has it. Throws Error where the leaf takes whole numbers alone.
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

/// Where the second fault stands: nothing without one.
std::vector<std::optional<SecondFault>> second_faults(const Study& study, const std::string& path) {
  if (path.empty()) return {std::nullopt};
  const SweepAxis& axis = *std::ranges::find(study.sweep, path, &SweepAxis::path);
  std::vector<double> doses = doses_of(axis);
  const ToleranceSearch range{doses.front(), doses.back()};
  if (doses.size() == 2) {
    doses.clear();
    for (int n = 0; n < kFrontierDoses; ++n)
      doses.push_back(range.low + (range.high - range.low) * n / (kFrontierDoses - 1));
  }
  std::vector<std::optional<SecondFault>> faults;
  for (const double dose : doses) {
    const std::string text = dose_text(study, path, range, dose);
    faults.push_back(SecondFault{path, text, figure_axis(field_of(study, path), {text})});
  }
  return faults;
}

/// Throws Error when the study may not have these faults without its other swept ones.
void check_alone(Study study, const std::string& path, const ToleranceSearch& search,
                 const std::vector<std::optional<SecondFault>>& seconds) {
  study.sampling = {};
  study.sweep = {
      {path,
       {dose_text(study, path, search, search.low), dose_text(study, path, search, search.high)}}};
  if (seconds.front())
    study.sweep.push_back({seconds.front()->path, {seconds.front()->value, seconds.back()->value}});
  check(study);
}

/// One score that a stage asks for.
struct Wanted {
  ToleranceRow* row;
  double dose;
  std::size_t trial, reference;  ///< positions in the stage's list of trials
};

/// The trials that the next stage of all searches asks for.
class Stage {
 public:
  Stage(const Study& study, const ToleranceAim& aim, std::vector<ToleranceRow>& rows) {
    for (ToleranceRow& row : rows) {
      int seed = static_cast<int>(row.trials.size());
      for (const double asked : next_doses(row.search, row.trials)) {
        const std::string dose = dose_text(study, row.path, row.search, asked);
        const std::string second = row.second ? row.second->value : "";
        const std::size_t trial = add(row, dose, second, seed);
        const std::size_t reference = aim.target ? trial : add_reference(study, row, rows, seed);
        wanted_.push_back({&row, parse_real(dose).value(), trial, reference});
        ++seed;
      }
    }
  }

  [[nodiscard]] const std::vector<TrialSpec>& trials() const { return trials_; }

  /// Gives the searches what they asked for; `results`: of trials(), in their order.
  void hand_out(const std::vector<Counts>& results, const ClassTable& table,
                const ToleranceAim& aim) const {
    for (const Wanted& wanted : wanted_) {
      const auto score = [&](std::size_t trial) -> std::optional<double> {
        const auto metrics = metrics_of_group(results[trial], table, wanted.row->group);
        return metrics.empty() ? std::nullopt : value_of(metrics, aim.metric);
      };
      std::optional<double> value = score(wanted.trial);
      if (!aim.target) {
        const std::optional<double> reference = score(wanted.reference);
        if (reference) wanted.row->most_to_lose = std::max(wanted.row->most_to_lose, *reference);
        value = value && reference ? std::optional(*value - *reference) : std::nullopt;
      }
      wanted.row->trials.push_back({wanted.dose, value});
    }
  }

 private:
  std::size_t add(const ToleranceRow& row, const std::string& dose, const std::string& second,
                  int seed) {
    TrialSpec spec{0, row.method, {0, {{row.path, dose}}}, seed};
    if (row.second) spec.cell.doses.emplace_back(row.second->path, second);
    trials_.push_back(std::move(spec));
    return trials_.size() - 1;
  }

  /// The least dose of both faults; that of the second stands in the first row.
  std::size_t add_reference(const Study& study, const ToleranceRow& row,
                            const std::vector<ToleranceRow>& rows, int seed) {
    const auto& least = rows.front().second;
    return add(row, dose_text(study, row.path, row.search, row.search.low),
               least ? least->value : "", seed);
  }

  std::vector<TrialSpec> trials_;
  std::vector<Wanted> wanted_;
};

/// Throws Error where not even true labels at the true pose reach the target in any group, by the
/// lattice ceiling of the first seed, or where there is no such metric.
void refuse_unreachable(const ToleranceAim& aim, const std::vector<ToleranceRow>& rows,
                        const Counts& ceiling, const ClassTable& table) {
  std::map<std::string, double> reached;  // by group
  for (const ToleranceRow& row : rows) {
    const auto metrics = metrics_of_group(ceiling, table, row.group);
    if (metrics.empty()) return;
    const double value = value_of(metrics, aim.metric).value_or(*aim.target);
    if (value >= *aim.target) return;
    reached[row.group] = value;
  }
  std::string text;
  for (const auto& [group, value] : reached)
    text += fmt::format("{}{} {:.6g}", text.empty() ? "" : ", ", group, value);
  throw Error(
      fmt::format("--target {}: beyond the lattice ceiling of {}, which true labels at the "
                  "true pose reach: {}; give a lower one",
                  *aim.target, aim.metric, text));
}

}  // namespace

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
  for (const std::string& path : chosen("--fault", choice.faults, paths)) {
    const auto doses = doses_of(*std::ranges::find(study.sweep, path, &SweepAxis::path));
    const ToleranceSearch search{doses.front(), doses.back(), aim.target.value_or(-aim.loss),
                                 aim.trials};
    const FigureAxis axis = figure_axis(field_of(study, path), {"1"});
    const auto seconds = second_faults(study, choice.against);
    check_alone(study, path, search, seconds);
    for (const auto& second : seconds)
      for (const std::string& group : chosen("--group", of_groups, groups))
        for (const std::string& method : chosen("--method", choice.methods, method_names(study)))
          rows.push_back({path, axis, second, method, group, search, {}, {}});
  }
  return rows;
}

SearchCost search_tolerances(const Study& of, const Recording& recording, const ClassTable& table,
                             const ToleranceAim& aim, const WorkFlags& work, ResultStore& store,
                             const std::function<bool()>& stop, std::vector<ToleranceRow>& rows) {
  Study study = of;
  study.sweep.clear();
  SearchCost cost;
  std::size_t asked = 0;
  const auto run = [&](const TaskList& tasks, const std::string& what) {
    Progress progress(what, "frame evaluations", work.quiet);
    RunnerOptions options{work.jobs, work.memory_bytes};
    options.progress = [&](std::int64_t done, std::int64_t total) { progress.show(done, total); };
    options.stop = stop;
    const RunnerOutcome outcome = run_plan({tasks, {}}, recording, table, store, options);
    if (!outcome.failures.empty()) throw Error(outcome.failures.front().reason);
    cost.computed += outcome.computed;
    cost.stopped = outcome.stopped;
    asked += tasks.size();
  };
  const auto counts_at = [&](const TaskList& tasks, std::size_t position) {
    return store.find(tasks.key(position)).value().counts;
  };
  const auto counts_of = [&](const std::vector<TrialSpec>& trials, const std::string& what) {
    const TrialTasks plan = tasks_of_trials(study, trials, recording.content_hash());
    run(plan.tasks, what);
    std::vector<Counts> counts;
    if (cost.stopped) return counts;
    for (const std::size_t position : plan.positions)
      counts.push_back(counts_at(plan.tasks, position));
    return counts;
  };
  // What has no answer is refused after the first trial, not after the first stage.
  if (aim.target) {
    Study alone = with_method(study, rows.front().method);
    alone.seeds = 1;
    const Plan plan = plan_of(alone, recording.content_hash());
    run(plan.tasks, "tolerance ceiling");
    if (cost.stopped) return cost;
    refuse_unreachable(aim, rows, counts_at(plan.tasks, plan.trials[0].lattice_ceiling), table);
  }
  const std::size_t asked_before = asked;
  const auto first = counts_of({Stage(study, aim, rows).trials().front()}, "tolerance");
  if (cost.stopped) return cost;
  static_cast<void>(value_of(metrics_of_group(first.front(), table, kPooled), aim.metric));
  asked = asked_before;
  for (int number = 1;; ++number) {
    const Stage stage(study, aim, rows);
    if (stage.trials().empty()) break;
    const auto counts = counts_of(stage.trials(), fmt::format("tolerance stage {}", number));
    if (cost.stopped) return cost;
    stage.hand_out(counts, table, aim);
  }
  for (ToleranceRow& row : rows) {
    row.tolerance = tolerance_of(row.search, row.trials);
    if (!aim.target && row.most_to_lose <= aim.loss) {
      row.tolerance.verdict = ToleranceVerdict::undefined;
      row.tolerance.dose = row.tolerance.low = row.tolerance.high = std::nullopt;
    }
  }
  cost.reused = asked - cost.computed;
  return cost;
}

}  // namespace mapscore::eval
