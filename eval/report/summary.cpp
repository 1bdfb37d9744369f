// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/summary.hpp"

#include "core/error.hpp"
#include "eval/lab/runner.hpp"
#include "eval/report/best_threshold.hpp"
#include "eval/report/failed_tasks.hpp"
#include "eval/report/pooled_scenes.hpp"
#include "eval/report/trial_list.hpp"
#include "eval/results/scene_counts.hpp"
#include "eval/score/lattice_check.hpp"
#include "files/suggestion.hpp"
#include "files/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <unordered_set>
#include <utility>

namespace mapscore::eval {
namespace {

/// A store and the tasks of its study, shared by the lines that read their results from it.
struct Source {
  ResultStore store;
  StudyRecord record;
  Plan plan;
};

/// `scene`: whose trial it is.
TrialResult read_result(const Source& source, std::size_t task, const std::string& scene) {
  const std::string key = source.plan.tasks.key(task);
  auto result = source.store.find(key);
  if (!result) throw Error("trial " + key + ": gone from the store; sweep again");
  result->counts = in_table(source.record, scene, std::move(result->counts));
  return std::move(*result);
}

/// ", the first: ..." with how to list them.
std::string reason_text(const std::vector<FailedTask>& failed,
                        const std::filesystem::path& results) {
  return fmt::format(", the first: {} (`mapscore trials {} --state failed` lists them)",
                     shown(failed.front().reason), shell_word(results.native()));
}

/// "; 2 of them failed, the first: ..."; empty where none did.
std::string failed_text(const Source& source, const std::filesystem::path& results) {
  const auto failed = failed_tasks(source.store, source.plan.tasks);
  return failed.empty()
             ? ""
             : fmt::format("; {} of them failed{}", failed.size(), reason_text(failed, results));
}

/// The seeds of a line, and the tasks of each and of its ceilings.
struct LineTasks {
  TrialSpec spec;  ///< of the first seed
  std::vector<int> seeds;
  std::vector<std::size_t> trial, registration_ceiling, lattice_ceiling;
};

/// Those of the seeds whose three tasks are there; lines without any are left out.
std::vector<LineTasks> lines_of(const Plan& plan, const Study& study, const auto& is_there) {
  const std::size_t methods = study.methods.size();
  const auto seeds = static_cast<std::size_t>(study.seeds);
  std::vector<LineTasks> lines;
  for (std::size_t first = 0; first < plan.trials.size(); first += methods * seeds) {  // a cell
    for (std::size_t method = 0; method < methods; ++method) {
      LineTasks line{plan.trials[first + method].spec, {}, {}, {}, {}};
      for (std::size_t seed = 0; seed < seeds; ++seed) {
        const PlannedTrial trial = plan.trials[first + seed * methods + method];
        if (!is_there(trial.task) || !is_there(trial.registration_ceiling) ||
            !is_there(trial.lattice_ceiling))
          continue;
        line.seeds.push_back(trial.spec.seed_index);
        line.trial.push_back(trial.task);
        line.registration_ceiling.push_back(trial.registration_ceiling);
        line.lattice_ceiling.push_back(trial.lattice_ceiling);
      }
      if (!line.seeds.empty()) lines.push_back(std::move(line));
    }
  }
  return lines;
}

/// Forms the lines of a summary one after the other; those of the same tasks share their figures.
class LineReader {
 public:
  LineReader(std::shared_ptr<const Source> source, const ClassTable& table,
             std::vector<std::string> groups)
      : source_(std::move(source)), table_(table), groups_(std::move(groups)) {}

  /// `tasks`: those of the role.
  [[nodiscard]] ResultLine line(Role role, const LineTasks& of,
                                const std::vector<std::size_t>& tasks) {
    ResultLine line{role, of.spec.method, of.spec.cell, of.seeds, {}, {}};
    line.in_store = [source = source_, tasks,
                     scene = scene_of(source_->record.study, of.spec.cell)](std::size_t seed) {
      return read_result(*source, tasks.at(seed), scene);
    };
    std::shared_ptr<const LineDigest>& digest = digests_[tasks];
    if (!digest) {
      digest = std::make_shared<const LineDigest>(line, table_, groups_);
      if (digests_.size() > 1) line.pooled.clear();  // the first line's are kept
    }
    line.digest = digest;
    return line;
  }

 private:
  std::shared_ptr<const Source> source_;
  const ClassTable& table_;
  std::vector<std::string> groups_;
  std::map<std::vector<std::size_t>, std::shared_ptr<const LineDigest>> digests_;
};

/// Throws Error when trials of the plan are not held.
void check_all_there(const HeldTasks& held, const Source& source,
                     const std::filesystem::path& results) {
  const TaskList& tasks = source.plan.tasks;
  const std::size_t missing = tasks.size() - held.all;
  if (missing == 0) return;
  const bool commands = !failed_commands(source.store, tasks).empty();
  throw Error(fmt::format(
      "{}: {} of {} trials are not there yet{}; run `mapscore sweep STUDY -o {}{}` again, "
      "it goes on where it stopped{}",
      results.string(), missing, tasks.size(), failed_text(source, results), results.string(),
      commands ? " --retry_failed" : "", commands ? " and tries failed commands again" : ""));
}

/// How much of an unfinished sweep is there.
std::string interim_note(const HeldTasks& held, const TaskList& tasks) {
  return fmt::format("INTERIM: {} of {} trials and ceilings are there; figures will change",
                     held.all, tasks.size());
}

/// How many trials and ceilings of each method failed and why, where all that is not there are
/// commands that did; empty where others are missing.
std::string only_failed_text(const HeldTasks& held, const Source& source,
                             const std::filesystem::path& results) {
  const Plan& plan = source.plan;
  const std::size_t commands = failed_commands(source.store, plan.tasks).size();
  if (commands == 0 || held.all + commands < plan.tasks.size()) return "";
  const auto failed = failed_tasks(source.store, plan.tasks);
  std::map<std::string, int> by_method;
  visit_tasks(plan, [&](const ListedTask& task) {
    if (std::ranges::binary_search(failed, task.task, {}, &FailedTask::task))
      ++by_method[task.spec.method];
    return true;
  });
  std::vector<std::string> counts;
  for (const auto& [method, count] : by_method)
    counts.push_back(fmt::format("{} failed of {}", count, method));
  return fmt::format("FAILED: {}{}", fmt::join(counts, ", "), reason_text(failed, results));
}

Estimate estimate(const BestThreshold& best, std::optional<double> ChosenScore::*figure) {
  std::vector<std::optional<double>> values;
  for (const ChosenScore& score : best.by_seed) values.push_back(score.*figure);
  return {best.pooled.*figure, spread_of("", values), values};
}

}  // namespace

SeedSummary spread_of(std::string_view metric, const std::vector<std::optional<double>>& by_seed) {
  ValueLimits limits{.low = 0.0};
  if (!is_size_of_error(metric)) limits.high = 1.0;
  return summarise(by_seed, limits);
}

std::vector<std::string> StudySummary::groups() const {
  std::vector<std::string> groups = detected_names(table);
  groups.insert(groups.begin(), {std::string(kPooled), std::string(kMacro)});
  return groups;
}

bool StudySummary::has_metric(std::string_view metric) const {
  return !trials.empty() &&
         std::ranges::count(metrics_of_group(trials.front().pooled, table, kPooled), metric,
                            &Metric::name) > 0;
}

std::string StudySummary::lattice_note() const {
  LatticeCheck check(table);
  for (const ResultLine& line : lattice_ceilings) check.add(pooled_counts(line, table));
  return check.note();
}

std::vector<std::string> detected_names(const ClassTable& table) {
  std::vector<std::string> names;
  for (const SemanticClass& c : table.classes)
    if (c.detect) names.push_back(c.name);
  return names;
}

std::vector<std::string> detected_titles(const Study& study, const ClassTable& table) {
  std::vector<std::string> titles = detected_names(table);
  for (std::string& name : titles) name = class_title(study, name);
  return titles;
}

StudySummary summarise_store(const std::filesystem::path& results, const SummaryOptions& options) {
  const std::filesystem::path file = store_file(results);
  ResultStore store = ResultStore::open_existing(file);
  const StudyRecord record = read_study(store, file.parent_path());
  const auto source =
      std::make_shared<const Source>(Source{std::move(store), record, plan_of(record)});
  const TaskList& tasks = source->plan.tasks;
  const HeldTasks held = held_tasks(source->store, tasks);
  StudySummary summary{record.study, record.table, record.recording_hash, held.builds, {}, {}, {}};
  for (const std::string& group : options.groups)
    require_one_of(summary.groups(), group,
                   fmt::format("class '{}': not scored in this study", group));
  std::unordered_set<std::string> keys;
  const std::string failed = options.failed_commands && held.all < tasks.size()
                                 ? only_failed_text(held, *source, results)
                                 : "";
  if ((options.interim || !failed.empty()) && held.all < tasks.size()) {
    keys = source->store.keys();
    summary.is_finished = !failed.empty();
    summary.interim =
        summary.is_finished ? failed : interim_note(held, tasks) + failed_text(*source, results);
  } else {
    check_all_there(held, *source, results);
  }
  const std::vector<std::string> groups =
      options.groups.empty() ? summary.groups() : options.groups;
  LineReader reader(source, summary.table, groups);
  for (const LineTasks& line : lines_of(source->plan, record.study, [&](std::size_t task) {
         return summary.interim.empty() || keys.contains(tasks.key(task));
       })) {
    summary.trials.push_back(reader.line(Role::trial, line, line.trial));
    summary.registration_ceilings.push_back(
        reader.line(Role::registration_ceiling, line, line.registration_ceiling));
    summary.lattice_ceilings.push_back(
        reader.line(Role::lattice_ceiling, line, line.lattice_ceiling));
  }
  if (options.pool_scenes) add_pooled_scenes(summary, groups);
  if (!summary.interim.empty() && !summary.trials.empty()) {
    const auto count = [](const ResultLine& line) { return line.seeds.size(); };
    const auto [least, most] = std::ranges::minmax(summary.trials, {}, count);
    summary.interim +=
        fmt::format("; each has {}{} of {} seeds",
                    count(least) < count(most) ? fmt::format("{} to ", count(least)) : "",
                    count(most), summary.study.seeds);
    summary.study.seeds = static_cast<int>(count(most));
  }
  if (summary.trials.empty())
    throw Error(fmt::format("{}: no trial is there with both of its ceilings yet{}; wait, or go on",
                            results.string(), failed_text(*source, results)));
  return summary;
}

ResultLine loaded(const ResultLine& line) {
  ResultLine full = line;
  if (!line.in_store) return full;
  full.pooled.clear();
  for (std::size_t seed = 0; seed < line.seeds.size(); ++seed)
    pool_into(full.pooled, full.results.emplace_back(line.in_store(seed)).counts);
  full.digest.reset();
  full.in_store = nullptr;
  return full;
}

ClassCounts pooled_counts(const ResultLine& line, const ClassTable& table) {
  return line.digest ? line.digest->pooled() : pool_detected(line.pooled, table);
}

ClassCounts counts_of_group(const Counts& counts, const ClassTable& table, std::string_view group) {
  if (group == kPooled) return pool_detected(counts, table);
  const auto named = std::ranges::find(table.classes, group, &SemanticClass::name);
  if (named == table.classes.end())
    throw Error(fmt::format("class '{}': not in the class table", group));
  ClassCounts of_class = counts.at(named->id);
  of_class.poses = counts.at(kBackground).poses;  // the same whatever the class
  return of_class;
}

std::vector<Metric> metrics_of_group(const Counts& counts, const ClassTable& table,
                                     std::string_view group) {
  return group == kMacro ? macro_metrics(counts, table)
                         : metrics_of(counts_of_group(counts, table, group));
}

std::vector<Metric> pooled_metrics(const ResultLine& line, const ClassTable& table,
                                   std::string_view group) {
  if (line.digest)
    if (auto metrics = line.digest->pooled_metrics(group)) return *metrics;
  return metrics_of_group(line.in_store ? loaded(line).pooled : line.pooled, table, group);
}

Estimate estimate(const ResultLine& line, const ClassTable& table, std::string_view group,
                  const std::string& metric) {
  if (line.digest)
    if (auto formed = line.digest->estimate(group, metric)) return *formed;
  if (line.in_store) return estimate(loaded(line), table, group, metric);
  if (metric == kBestF1) return estimate(best_threshold(line, table, group), &ChosenScore::f1);
  if (metric == kBestThreshold)
    return estimate(best_threshold(line, table, group), &ChosenScore::threshold);
  const auto value = [&](const Counts& counts) -> std::optional<double> {
    const std::vector<Metric> metrics = metrics_of_group(counts, table, group);
    return metrics.empty() ? std::nullopt : value_of(metrics, metric);
  };
  std::vector<std::optional<double>> values;
  for (const TrialResult& result : line.results) values.push_back(value(result.counts));
  return {value(line.pooled), spread_of(metric, values), values};
}

}  // namespace mapscore::eval
