// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/baseline.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/report/comparable.hpp"
#include "files/file_bytes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

namespace mapscore::eval {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 3;  ///< 1 was a CSV of figures, 2 had no hash
const std::string kWriteAnew =
    "write it anew with `mapscore check RESULTS --baseline FILE --update`";
const std::string kNoBaseline = "no baseline of this mapscore; " + kWriteAnew;

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

Cell cell_of(const Json& doses) {
  Cell cell;
  for (const auto& [path, value] : doses.items()) cell.doses.emplace_back(path, value);
  return cell;
}

Json doses_of(const Cell& cell) {
  Json doses = Json::object();
  for (const auto& [path, value] : cell.doses) doses[path] = value;
  return doses;
}

Json trial_of(const ResultLine& line, std::size_t seed, const ClassTable& table) {
  Json trial{{"role", name_of(line.role)},
             {"method", line.method},
             {"doses", doses_of(line.cell)},
             {"seed", line.seeds[seed]}};
  for (const SemanticClass& c : table.classes)
    if (c.detect) trial["counts"][c.name] = numbers_of(line.results[seed].counts.at(c.id));
  return trial;
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

Json json_of(const TrialYields& yields) {
  Json frames = Json::array();
  for (const auto& classes : yields.frames) {
    Json& frame = frames.emplace_back(Json::object());
    for (const auto& [name, yield] : classes) frame[name] = {yield.found, yield.falses};
  }
  return {{"method", yields.method}, {"doses", doses_of(yields.cell)}, {"frames", frames}};
}

TrialYields yields_from(const Json& json) {
  TrialYields yields{json.at("method"), cell_of(json.at("doses")), {}};
  for (const Json& classes : json.at("frames")) {
    auto& frame = yields.frames.emplace_back();
    for (const auto& [name, yield] : classes.items()) frame[name] = {yield.at(0), yield.at(1)};
  }
  return yields;
}

/// Adds a trial to its line, which is the last one or new.
void add_trial(const Json& trial, const ClassCounts& empty, Baseline& baseline) {
  Role role{};
  while (trial.at("role") != name_of(role))
    if (role == Role::lattice_ceiling)
      throw Error("unknown role");
    else
      role = static_cast<Role>(static_cast<int>(role) + 1);
  const Cell cell = cell_of(trial.at("doses"));
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

/// The first lines of a file, of which all else is `body`.
std::string head_of(std::string_view body) {
  return fmt::format("{{\n\"format\": {},\n\"hash\": \"{}\",\n", kFormat, hash_of(body));
}

Baseline baseline_from(const std::string& text) {
  const Json json = Json::parse(text);
  if (json.at("format") != kFormat) throw Error(kNoBaseline);
  const std::size_t head = std::min(head_of("").size(), text.size());
  if (!text.starts_with(head_of(std::string_view(text).substr(head))))
    throw Error("was edited, merged or cut, so it is no result of any program; " + kWriteAnew);
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
  for (const Json& yields : json.at("frames")) baseline.yields.push_back(yields_from(yields));
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
  check_one_build(summary, "results");
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
  const Json settings{{"scoring_version", baseline.scoring_version},
                      {"recording", baseline.recording_hash},
                      {"build", baseline.build},
                      {"study", to_yaml(baseline.study)},
                      {"classes", detected_names(baseline.table)},
                      {"tolerances", baseline.scored.tolerances},
                      {"distances_m", baseline.scored.distances_m},
                      {"columns", columns_of(empty_counts(baseline.scored))}};
  std::string body;
  for (const auto& [key, value] : settings.items())
    body += fmt::format("\"{}\": {},\n", key, value.dump());
  std::vector<std::string> trials, frames;
  for (auto line = baseline.lines.begin(); line != baseline.lines.end(); ++line)
    if (std::none_of(baseline.lines.begin(), line,
                     [&](const ResultLine& before) { return repeats(*line, before); }))
      for (std::size_t n = 0; n < line->seeds.size(); ++n)
        trials.push_back(trial_of(*line, n, baseline.table).dump());
  for (const TrialYields& yields : baseline.yields) frames.push_back(json_of(yields).dump());
  body += fmt::format("\"trials\": [\n{}\n],\n\"frames\": [\n{}\n]}}\n", fmt::join(trials, ",\n"),
                      fmt::join(frames, ",\n"));
  write_whole_file(file, head_of(body) + body);
}

Baseline read_baseline(const std::filesystem::path& file) try {
  if (!std::filesystem::exists(file))
    throw Error("is not there; make it with `mapscore check RESULTS --baseline FILE --update`");
  return baseline_from(read_file(file));
} catch (const nlohmann::json::exception&) {
  throw Error(file.string() + ": " + kNoBaseline);
} catch (const Error& error) {
  throw Error(file.string() + ": " + error.what());
}

}  // namespace mapscore::eval
