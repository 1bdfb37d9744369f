// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/baseline.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "files/file_bytes.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <tuple>
#include <utility>

namespace mapscore::eval {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 2;  ///< 1 was a CSV of figures
constexpr const char* kNoBaseline =
    "no baseline of this mapscore; write it anew with `mapscore check RESULTS --baseline FILE "
    "--update`";

/// Visits the counts of a class that a baseline keeps, in the order of its columns.
void visit_counts(ClassCounts& counts, auto&& visit) {
  for (const CountField<ClassCounts>& field : ClassCounts::counts())
    visit(std::string(field.name), counts.*field.member);
  for (ToleranceCounts& at : counts.at_tolerance) {
    visit(fmt::format("true_predicted_t{}", at.voxels), at.true_predicted);
    visit(fmt::format("found_t{}", at.voxels), at.found);
  }
  for (const auto& [name, tally] :
       {std::pair{"accuracy", &counts.accuracy}, std::pair{"completeness", &counts.completeness}}) {
    DistanceTally::Parts parts = tally->parts();
    visit(fmt::format("{}_count", name), parts.count);
    visit(fmt::format("{}_unreached", name), parts.unreached);
    visit(fmt::format("{}_sum_nm", name), parts.sum_nm);
    for (std::size_t n = 0; n < parts.limits_m.size(); ++n)
      visit(fmt::format("{}_{}m", name, parts.limits_m[n]), parts.within[n]);
    parts.bins = {parts.count - parts.unreached};  // how far each was is not kept
    *tally = DistanceTally(std::move(parts));
  }
}

ClassCounts empty_counts(const ScoreOptions& scored) {
  ClassCounts counts = zero_counts(1, scored).front();
  counts.accuracy = counts.completeness = DistanceTally(scored.distances_m);
  return counts;
}

/// What of a class's counts is kept.
ClassCounts kept(const ClassCounts& all, const ScoreOptions& scored) {
  ClassCounts counts = empty_counts(scored);
  counts.at_tolerance = all.at_tolerance;
  counts.accuracy += all.accuracy;
  counts.completeness += all.completeness;
  for (const CountField<ClassCounts>& field : ClassCounts::counts())
    counts.*field.member = all.*field.member;
  visit_counts(counts, [](const std::string&, std::int64_t&) {});
  return counts;
}

/// The results of a line for the detected classes alone.
ResultLine kept(const ResultLine& line, const ClassTable& table, const ScoreOptions& scored) {
  ResultLine reduced{line.role, line.method, line.cell, line.seeds, {}, {}};
  for (const TrialResult& result : line.results) {
    Counts counts{empty_counts(scored)};
    for (const SemanticClass& c : table.classes)
      if (c.detect) counts.push_back(kept(result.counts.at(c.id), scored));
    pool_into(reduced.pooled, counts);
    reduced.results.push_back({std::move(counts), {}});
  }
  return reduced;
}

/// Whether a ceiling is the same as another of its method; there is one lattice ceiling for all.
bool repeats(const ResultLine& line, const ResultLine& other) {
  return line.role != Role::trial && other.role == line.role &&
         (line.role == Role::lattice_ceiling || other.method == line.method) &&
         other.seeds == line.seeds &&
         std::ranges::equal(line.results, other.results, {}, &TrialResult::counts,
                            &TrialResult::counts);
}

ClassTable class_table(const std::vector<std::string>& names) {
  ClassTable table;
  for (const std::string& name : names)
    table.classes.push_back({static_cast<ClassId>(table.classes.size()), name, {}, true});
  return table;
}

/// What the trials of a study were counted at.
ScoreOptions scored_in(const StudySummary& summary) {
  const ClassCounts pooled = pool_detected(summary.trials.at(0).pooled, summary.table);
  ScoreOptions scored{{}, pooled.accuracy.limits_m()};
  for (const ToleranceCounts& at : pooled.at_tolerance) scored.tolerances.push_back(at.voxels);
  return scored;
}

std::vector<std::string> columns_of(ClassCounts counts) {
  std::vector<std::string> columns;
  visit_counts(counts, [&](const std::string& name, std::int64_t&) { columns.push_back(name); });
  return columns;
}

Json numbers_of(ClassCounts counts) {
  Json numbers = Json::array();
  visit_counts(counts, [&](const std::string&, std::int64_t& count) { numbers.push_back(count); });
  return numbers;
}

ClassCounts counts_from(const Json& numbers, ClassCounts counts) {
  std::size_t next = 0;
  visit_counts(counts, [&](const std::string& name, std::int64_t& count) {
    constexpr std::int64_t kMost = 1'000'000'000'000'000'000;
    const Json& number = numbers.at(next++);
    if (!number.is_number_integer() || number < 0 || number > kMost)
      throw Error(name + ": is no count");
    count = number;
  });
  return counts;
}

/// Adds a trial to its line, which is the last one or new.
void add_trial(const Json& trial, const ClassCounts& empty, Baseline& baseline) {
  Role role{};
  while (trial.at("role") != name_of(role))
    if (role == Role::lattice_ceiling)
      throw Error("unknown role");
    else
      role = static_cast<Role>(static_cast<int>(role) + 1);
  Cell cell;
  for (const auto& [path, value] : trial.at("doses").items()) cell.doses.emplace_back(path, value);
  const std::string method = trial.at("method");
  if (baseline.lines.empty() || baseline.lines.back().role != role ||
      baseline.lines.back().method != method || baseline.lines.back().cell.doses != cell.doses)
    baseline.lines.push_back({role, method, cell, {}, {}, {}});
  ResultLine& line = baseline.lines.back();
  Counts counts{empty};
  for (const SemanticClass& c : baseline.table.classes)
    if (c.detect) counts.push_back(counts_from(trial.at("counts").at(c.name), empty));
  line.seeds.push_back(trial.at("seed"));
  pool_into(line.pooled, counts);
  line.results.push_back({std::move(counts), {}});
}

Baseline baseline_from(const std::string& text) {
  const Json json = Json::parse(text);
  if (json.at("format") != kFormat) throw Error(kNoBaseline);
  Baseline baseline{json.at("scoring_version"),
                    json.at("recording"),
                    json.at("build"),
                    parse_study(json.at("study"), "study"),
                    class_table(json.at("classes")),
                    {json.at("tolerances"), json.at("distances_m")},
                    {}};
  const ClassCounts empty = empty_counts(baseline.scored);
  if (json.at("columns") != columns_of(empty)) throw Error(kNoBaseline);
  for (const Json& trial : json.at("trials")) add_trial(trial, empty, baseline);
  if (baseline.lines.empty()) throw Error("holds no trial; write it anew with --update");
  return baseline;
}

}  // namespace

std::vector<std::string> voxel_metrics(const Baseline& baseline) {
  std::vector<std::string> names;
  for (const Metric& metric : metrics_of(empty_counts(baseline.scored))) {
    const auto begins = [&](const char* with) { return metric.name.starts_with(with); };
    if (begins("precision") || begins("recall") || begins("f1") || begins("iou") || begins("f_") ||
        metric.name.ends_with("mean_m"))
      names.push_back(metric.name);
  }
  return names;
}

Baseline baseline_of(const StudySummary& summary) {
  if (summary.builds.size() != 1)
    throw Error(fmt::format("the trials were made by {} builds; sweep again with one",
                            summary.builds.size()));
  Baseline baseline{kScoringVersion,
                    summary.recording_hash,
                    *summary.builds.begin(),
                    summary.study,
                    class_table(detected_names(summary.table)),
                    scored_in(summary),
                    {}};
  for (const auto* lines :
       {&summary.trials, &summary.registration_ceilings, &summary.lattice_ceilings})
    for (const ResultLine& line : *lines)
      baseline.lines.push_back(kept(loaded(line), summary.table, baseline.scored));
  return baseline;
}

void write_baseline(const Baseline& baseline, const std::filesystem::path& file) {
  const Json head{{"format", kFormat},
                  {"scoring_version", baseline.scoring_version},
                  {"recording", baseline.recording_hash},
                  {"build", baseline.build},
                  {"study", to_yaml(baseline.study)},
                  {"classes", detected_names(baseline.table)},
                  {"tolerances", baseline.scored.tolerances},
                  {"distances_m", baseline.scored.distances_m},
                  {"columns", columns_of(empty_counts(baseline.scored))}};
  std::string text = "{\n";
  for (const auto& [key, value] : head.items())
    text += fmt::format("\"{}\": {},\n", key, value.dump());
  text += "\"trials\": [\n";
  bool first = true;
  for (auto at = baseline.lines.begin(); at != baseline.lines.end(); ++at) {
    const ResultLine& line = *at;
    if (std::any_of(baseline.lines.begin(), at,
                    [&](const ResultLine& before) { return repeats(line, before); }))
      continue;
    for (std::size_t n = 0; n < line.seeds.size(); ++n) {
      Json trial{{"role", name_of(line.role)}, {"method", line.method}, {"doses", Json::object()}};
      for (const auto& [path, value] : line.cell.doses) trial["doses"][path] = value;
      trial["seed"] = line.seeds[n];
      for (const SemanticClass& c : baseline.table.classes)
        if (c.detect) trial["counts"][c.name] = numbers_of(line.results[n].counts.at(c.id));
      text += (std::exchange(first, false) ? "" : ",\n") + trial.dump();
    }
  }
  write_whole_file(file, text + "\n]}\n");
}

Baseline read_baseline(const std::filesystem::path& file) try {
  if (!std::filesystem::exists(file)) throw Error(kNoBaseline);
  return baseline_from(read_file(file));
} catch (const nlohmann::json::exception&) {
  throw Error(file.string() + ": " + kNoBaseline);
} catch (const Error& error) {
  throw Error(file.string() + ": " + error.what());
}

}  // namespace mapscore::eval
