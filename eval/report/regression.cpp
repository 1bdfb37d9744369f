// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/regression.hpp"

#include "core/error.hpp"
#include "eval/report/comparable.hpp"
#include "eval/statistics/paired.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mapscore::eval {
namespace {

constexpr double kSignificant = 0.05;
constexpr double kRounding = 1e-12;

/// Lines of one method and cell, of the seeds that both have.
struct PairedLines {
  ResultLine before, after;
};

/// The results of a line at some of its seeds, in their order.
ResultLine of_seeds(const ResultLine& line, const std::vector<int>& seeds) {
  ResultLine part{line.role, line.method, line.cell, seeds, {}, {}};
  for (const int seed : seeds) {
    const auto place = std::ranges::find(line.seeds, seed) - line.seeds.begin();
    part.results.push_back(line.results.at(static_cast<std::size_t>(place)));
    pool_into(part.pooled, part.results.back().counts);
  }
  return part;
}

PairedLines paired(const ResultLine& before, const ResultLine& after) {
  std::vector<int> seeds = before.seeds;
  std::erase_if(seeds, [&](int seed) { return std::ranges::count(after.seeds, seed) == 0; });
  return {of_seeds(before, seeds), of_seeds(after, seeds)};
}

/// After - before of each seed.
SeedSummary differences(const Estimate& before, const Estimate& after) {
  std::vector<std::optional<double>> differences;
  for (std::size_t n = 0; n < before.by_seed.size(); ++n)
    differences.push_back(before.by_seed[n] && after.by_seed[n]
                              ? std::optional(*after.by_seed[n] - *before.by_seed[n])
                              : std::nullopt);
  return summarise(differences);
}

const ResultLine* counterpart(const ResultLine& line, const Baseline& in) {
  const auto found = std::ranges::find_if(in.lines, [&](const ResultLine& other) {
    return other.role == line.role && other.cell.doses == line.cell.doses &&
           (line.role == Role::lattice_ceiling || other.method == line.method);
  });
  return found == in.lines.end() ? nullptr : &*found;
}

/// Causes of false voxels for precision, of missed ones for recall, of both for others.
std::vector<std::pair<std::string, std::int64_t>> grown_causes(const PairedLines& lines,
                                                               const JudgedFigure& figure,
                                                               const Baseline& before,
                                                               const Baseline& after) {
  const std::string group = figure.group == kMacro ? std::string(kPooled) : figure.group;
  const ClassCounts then = counts_of_group(lines.before.pooled, before.table, group);
  const ClassCounts now = counts_of_group(lines.after.pooled, after.table, group);
  const bool falses = !figure.metric.starts_with("recall") && !figure.metric.starts_with("compl");
  const bool misses = !figure.metric.starts_with("precision") && !figure.metric.starts_with("acc");
  std::vector<std::pair<std::string, std::int64_t>> grown;
  for (const CountField<ClassCounts>& field : ClassCounts::counts()) {
    const bool asked = (falses && field.name.starts_with("false_")) ||
                       (misses && field.name.starts_with("missed_"));
    const std::int64_t growth = now.*field.member - then.*field.member;
    if (asked && growth > 0)
      grown.emplace_back(field.name.substr(field.name.find('_') + 1), growth);
  }
  std::ranges::stable_sort(grown, std::ranges::greater{}, [](const auto& g) { return g.second; });
  return grown;
}

/// One-sided p of a mean gain beyond `limit` downwards, by Student's t; none for one pair.
std::optional<double> p_below(const SeedSummary& gain, double limit) {
  if (gain.seeds < 2) return std::nullopt;
  if (*gain.sd < kRounding) return *gain.mean < limit - kRounding ? 0.0 : 1.0;
  const double t = (*gain.mean - limit) / *gain.sd * std::sqrt(gain.seeds);
  return std::clamp(student_t_cdf(t, gain.seeds - 1), 0.0, 1.0);
}

SeedSummary mirrored(SeedSummary gain) {
  if (gain.mean) gain.mean = -*gain.mean;
  std::swap(gain.low, gain.high);
  if (gain.low) gain.low = -*gain.low;
  if (gain.high) gain.high = -*gain.high;
  return gain;
}

/// The paired differences, turned so that more is better.
SeedSummary gain_of(const JudgedFigure& figure) {
  return higher_is_better(figure.metric) ? figure.difference : mirrored(figure.difference);
}

/// Which gains (or, mirrored, losses) are significantly below -allowed, Holm over all.
std::vector<bool> significantly_below(const std::vector<JudgedFigure>& figures, bool mirror) {
  std::vector<SeedSummary> gains;
  std::vector<std::optional<double>> p;
  for (const JudgedFigure& figure : figures) {
    gains.push_back(mirror ? mirrored(gain_of(figure)) : gain_of(figure));
    p.push_back(p_below(gains.back(), -figure.allowed));
  }
  p = holm_adjusted(p);
  std::vector<bool> below;
  for (std::size_t n = 0; n < figures.size(); ++n)
    below.push_back(gains[n].kind == SpreadKind::interval && p[n] && *p[n] < kSignificant &&
                    *gains[n].high < -figures[n].allowed);
  return below;
}

void give_verdicts(Judgement& judgement) {
  const std::vector<bool> lost = significantly_below(judgement.figures, false);
  const std::vector<bool> won = significantly_below(judgement.figures, true);
  for (std::size_t n = 0; n < judgement.figures.size(); ++n) {
    JudgedFigure& figure = judgement.figures[n];
    if (!figure.after) continue;
    const double gain = figure.gain().value();
    const double limit = figure.allowed + kRounding;
    if (lost[n] || (judgement.same_seeds && gain < -limit))
      figure.verdict = Standing::worse;
    else if (won[n] || (judgement.same_seeds && gain > limit))
      figure.verdict = Standing::better;
    else if (!judgement.same_seeds && figure.difference.kind != SpreadKind::interval)
      figure.verdict = Standing::not_judged;
  }
}

/// One figure of a line of the baseline; none where it is undefined there. `lines.after`: empty
/// where the results lack the line.
std::optional<JudgedFigure> judged_figure(const PairedLines& lines, const Baseline& before,
                                          const Baseline& after, const std::string& group,
                                          const std::string& metric, bool same_seeds) {
  const Estimate then = estimate(lines.before, before.table, group, metric);
  if (!then.pooled) return std::nullopt;
  JudgedFigure figure;
  figure.role = lines.before.role;
  figure.method = lines.before.method;
  figure.cell = lines.before.cell;
  figure.group = group;
  figure.metric = metric;
  figure.before = then.pooled;
  if (!lines.after.results.empty()) {
    const Estimate now = estimate(lines.after, after.table, group, metric);
    figure.after = now.pooled;
    figure.difference = differences(then, now);
    figure.grown = grown_causes(lines, figure, before, after);
  }
  // Other seeds may lack what only some of the baseline's had.
  const bool by_chance = !same_seeds && !lines.after.results.empty() &&
                         std::ranges::any_of(then.by_seed, [](const auto& v) { return !v; });
  if (!figure.after) figure.verdict = by_chance ? Standing::not_judged : Standing::missing;
  return figure;
}

/// Adds the figures of a line of the baseline.
void judge_line(const ResultLine& line, const Baseline& before, const Baseline& after,
                const std::vector<std::string>& metrics, const Tolerances& allowed,
                Judgement& judgement) {
  const ResultLine* now = counterpart(line, after);
  PairedLines lines = paired(line, now ? *now : ResultLine{});
  const std::size_t pairs = lines.after.results.size();
  judgement.seeds = std::max(judgement.seeds, static_cast<int>(pairs));
  judgement.seeds_before = std::max(judgement.seeds_before, static_cast<int>(line.results.size()));
  judgement.trials += pairs;
  for (std::size_t n = 0; n < pairs; ++n)
    if (lines.before.results[n].counts != lines.after.results[n].counts) ++judgement.changed;
  if (pairs == 0) lines.before = line;
  std::vector<std::string> groups = detected_names(before.table);
  groups.insert(groups.begin(), {std::string(kPooled), std::string(kMacro)});
  for (const std::string& group : groups)
    for (const std::string& metric : metrics)
      if (auto figure = judged_figure(lines, before, after, group, metric, judgement.same_seeds)) {
        figure->allowed = allowed.of(group, metric);
        judgement.figures.push_back(std::move(*figure));
      }
}

}  // namespace

double Tolerances::of(const std::string& group, const std::string& metric) const {
  for (const auto& key : {std::pair{group, metric}, {group, ""}, {"", metric}})
    if (const auto found = special.find(key); found != special.end()) return found->second;
  return all;
}

Tolerances parse_tolerances(const std::vector<std::string>& texts) {
  Tolerances tolerances;
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    const std::string name = equals == std::string::npos ? "" : text.substr(0, equals);
    const auto value = parse_number(equals == std::string::npos ? text : text.substr(equals + 1));
    if (!value || *value < 0.0 || *value > 1.0 || equals == 0)
      throw Error(fmt::format(
          "--allow {}: write a number from 0 to 1, METRIC=NUMBER or CLASS/METRIC=NUMBER", text));
    if (name.empty()) {
      tolerances.all = *value;
      continue;
    }
    const std::size_t slash = name.rfind('/');  // no metric holds one
    const std::pair key = slash == std::string::npos
                              ? std::pair(std::string(), name)
                              : std::pair(name.substr(0, slash), name.substr(slash + 1));
    if (!tolerances.special.emplace(key, *value).second)
      throw Error(fmt::format("--allow {}: stands there twice; leave one out", name));
  }
  return tolerances;
}

const char* name_of(Standing verdict) {
  return std::array{"worse", "missing", "better", "held", "not judged"}.at(
      static_cast<std::size_t>(verdict));
}

bool higher_is_better(std::string_view metric) {
  return !is_size_of_error(metric) && metric != "brier" && metric != "ece";
}

std::optional<double> JudgedFigure::gain() const {
  if (!before || !after) return std::nullopt;
  return higher_is_better(metric) ? *after - *before : *before - *after;
}

std::size_t Judgement::count(Standing verdict) const {
  return static_cast<std::size_t>(std::ranges::count(figures, verdict, &JudgedFigure::verdict));
}

bool Judgement::compared() const {
  return count(Standing::missing) + count(Standing::not_judged) < figures.size();
}

const JudgedFigure* Judgement::worst() const {
  const auto found = std::ranges::find_if(figures, [](const JudgedFigure& figure) {
    return figure.verdict == Standing::worse && figure.role == Role::trial;
  });
  return found == figures.end() ? nullptr : &*found;
}

Judgement judge(const Baseline& before, const Baseline& after,
                const std::vector<std::string>& metrics, const Tolerances& allowed,
                bool any_recording) {
  check_comparable(before, after, any_recording);
  Judgement judgement;
  judgement.same_recording = before.recording_hash == after.recording_hash;
  judgement.same_seeds = before.study.seed == after.study.seed;
  for (const ResultLine& line : before.lines)
    judge_line(line, before, after, metrics, allowed, judgement);
  give_verdicts(judgement);
  std::ranges::stable_sort(judgement.figures, [](const JudgedFigure& a, const JudgedFigure& b) {
    const auto beyond = [](const JudgedFigure& f) { return f.gain().value_or(-1.0) + f.allowed; };
    return std::pair(a.verdict, beyond(a)) < std::pair(b.verdict, beyond(b));
  });
  return judgement;
}

}  // namespace mapscore::eval
