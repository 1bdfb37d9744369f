// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/sweep/tolerance_search.hpp"

#include "core/error.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/lab/runner.hpp"
#include "eval/report/summary.hpp"
#include "eval/results/searched_trials.hpp"
#include "eval/score/counts.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace mapscore::eval {
namespace {

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
        const std::size_t reference = aim.target ? trial : add_reference(study, row, seed);
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

  /// The least dose of both faults.
  std::size_t add_reference(const Study& study, const ToleranceRow& row, int seed) {
    return add(row, dose_text(study, row.path, row.search, row.search.low),
               row.second ? row.second->least : "", seed);
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

/// Runs trials into the store, and counts them.
class Trials {
 public:
  Trials(const Study& study, const Recording& recording, const ClassTable& table,
         const WorkFlags& work, ResultStore& store, const std::function<bool()>& stop)
      : study_(study),
        recording_(recording),
        table_(table),
        work_(work),
        store_(store),
        stop_(stop) {}

  [[nodiscard]] bool stopped() const { return cost_.stopped; }
  [[nodiscard]] SearchCost cost() const {
    SearchCost cost = cost_;
    cost.reused = asked_ - cost.computed;
    return cost;
  }

  /// Counts of these trials, in their order; none when it was stopped.
  std::vector<Counts> counts_of(const std::vector<TrialSpec>& trials, const std::string& what) {
    const TrialTasks plan = tasks_of_trials(study_, trials, recording_.content_hash());
    note_searched(store_, with_keys(trials, plan));
    run(plan.tasks, what);
    std::vector<Counts> counts;
    if (stopped()) return counts;
    for (const std::size_t position : plan.positions) {
      counts.push_back(counts_at(plan.tasks, position));
      cost_.any_visible = cost_.any_visible || pool_detected(counts.back(), table_).visible > 0;
    }
    return counts;
  }

  /// The lattice ceiling of a method's first seed; none when it was stopped.
  Counts ceiling_of(const std::string& method) {
    Study alone = with_method(study_, method);
    alone.seeds = 1;
    const Plan plan = plan_of(alone, recording_.content_hash());
    run(plan.tasks, "tolerance ceiling");
    return stopped() ? Counts{} : counts_at(plan.tasks, plan.trials[0].lattice_ceiling);
  }

  /// The last trial will be asked for again.
  void ask_again() { --asked_; }

 private:
  void run(const TaskList& tasks, const std::string& what) {
    Progress progress(what, "frame evaluations", work_.quiet);
    RunnerOptions options{work_.jobs, work_.memory_bytes};
    options.progress = [&](std::int64_t done, std::int64_t total) { progress.show(done, total); };
    options.stop = stop_;
    const RunnerOutcome outcome = run_plan({tasks, {}}, recording_, table_, store_, options);
    if (!outcome.failures.empty()) throw Error(outcome.failures.front().reason);
    cost_.computed += outcome.computed;
    cost_.stopped = outcome.stopped;
    asked_ += tasks.size();
  }

  [[nodiscard]] Counts counts_at(const TaskList& tasks, std::size_t position) const {
    return store_.find(tasks.key(position)).value().counts;
  }

  const Study& study_;
  const Recording& recording_;
  const ClassTable& table_;
  const WorkFlags& work_;
  ResultStore& store_;
  const std::function<bool()>& stop_;
  SearchCost cost_;
  std::size_t asked_ = 0;
};

/// Runs searches of one study side by side to their end, or until it is stopped.
void run_stages(const Study& study, const ClassTable& table, const ToleranceAim& aim,
                const std::string& what, Trials& trials, std::vector<ToleranceRow>& rows) {
  for (int number = 1;; ++number) {
    const Stage stage(study, aim, rows);
    if (stage.trials().empty()) break;
    const auto counts = trials.counts_of(stage.trials(), fmt::format("{} stage {}", what, number));
    if (trials.stopped()) return;
    stage.hand_out(counts, table, aim);
  }
  for (ToleranceRow& row : rows) {
    row.tolerance = tolerance_of(row.search, row.trials);
    if (!aim.target && row.most_to_lose <= aim.loss) {
      row.tolerance.verdict = ToleranceVerdict::undefined;
      row.tolerance.dose = row.tolerance.low = row.tolerance.high = std::nullopt;
    }
  }
}

}  // namespace

SearchCost search_tolerances(const Study& of, const Recording& recording, const ClassTable& table,
                             const ToleranceAim& aim, const ToleranceChoice& choice,
                             const WorkFlags& work, ResultStore& store,
                             const std::function<bool()>& stop, std::vector<ToleranceRow>& rows) {
  Study study = of;
  study.sweep.clear();
  Trials trials(study, recording, table, work, store, stop);
  // What has no answer is refused after the first trial, not after the first stage.
  if (aim.target) {
    const Counts ceiling = trials.ceiling_of(rows.front().method);
    if (trials.stopped()) return trials.cost();
    refuse_unreachable(aim, rows, ceiling, table);
  }
  const auto first = trials.counts_of({Stage(study, aim, rows).trials().front()}, "tolerance");
  if (trials.stopped()) return trials.cost();
  static_cast<void>(value_of(metrics_of_group(first.front(), table, kPooled), aim.metric));
  trials.ask_again();
  run_stages(study, table, aim, "tolerance", trials, rows);
  if (trials.stopped()) return trials.cost();
  std::vector<ToleranceRow> frontier = frontier_searches(of, aim, choice, rows);
  run_stages(study, table, aim, "frontier", trials, frontier);
  rows.insert(rows.end(), frontier.begin(), frontier.end());
  return trials.cost();
}

}  // namespace mapscore::eval
