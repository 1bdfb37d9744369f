// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/best_threshold.hpp"

#include <cstddef>
#include <iterator>

namespace mapscore::eval {
namespace {

/// What all seeds but one have together, for each of them.
std::vector<ClassCurve> pooled_others(std::span<const ClassCurve> seeds) {
  std::vector<ClassCurve> others(seeds.size());
  ClassCurve before, after;
  for (std::size_t s = 0; s < seeds.size(); ++s) {
    others[s] = before;
    before += seeds[s];
  }
  for (std::size_t s = seeds.size(); s-- > 0;) {
    others[s] += after;
    after += seeds[s];
  }
  return others;
}

/// Mean of one figure over the scores that define it.
std::optional<double> mean_of(const std::vector<ChosenScore>& scores,
                              std::optional<double> ChosenScore::*figure) {
  double sum = 0.0;
  int count = 0;
  for (const ChosenScore& score : scores) {
    sum += (score.*figure).value_or(0.0);
    count += score.*figure ? 1 : 0;
  }
  return count == 0 ? std::nullopt : std::optional(sum / count);
}

ChosenScore mean_of(const std::vector<ChosenScore>& scores) {
  return {mean_of(scores, &ChosenScore::f1), mean_of(scores, &ChosenScore::threshold)};
}

BestThreshold macro_best_threshold(const ResultLine& line, const ClassTable& table) {
  std::vector<std::vector<ChosenScore>> by_seed(line.results.size());
  std::vector<ChosenScore> pooled;
  for (const SemanticClass& semantic : table.classes) {
    if (!semantic.detect) continue;
    const BestThreshold of_class = best_threshold(line, table, semantic.name);
    for (std::size_t s = 0; s < by_seed.size(); ++s)
      if (line.results[s].counts.at(semantic.id).visible > 0)
        by_seed[s].push_back(of_class.by_seed[s]);
    if (line.pooled.at(semantic.id).visible > 0) pooled.push_back(of_class.pooled);
  }
  BestThreshold macro{{}, mean_of(pooled)};
  for (const std::vector<ChosenScore>& scores : by_seed) macro.by_seed.push_back(mean_of(scores));
  return macro;
}

}  // namespace

BestThreshold best_threshold(std::span<const ClassCurve> seeds) {
  BestThreshold best;
  best.by_seed.resize(seeds.size());
  if (std::ssize(seeds) < kSeedsForBest) return best;
  const std::vector<ClassCurve> others = pooled_others(seeds);
  CurvePoint sum;
  ClassCurve all;
  for (std::size_t s = 0; s < seeds.size(); ++s) {
    const std::optional<double> threshold = best_f1_threshold(others[s]);
    const CurvePoint at = point_at(seeds[s], threshold);
    best.by_seed[s] = {at.f1, threshold};
    sum.predicted += at.predicted;
    sum.true_predicted += at.true_predicted;
    sum.found += at.found;
    all += seeds[s];
  }
  best.pooled = {f1(sum.true_predicted, sum.predicted, sum.found, all.visible),
                 best_f1_threshold(all)};
  return best;
}

BestThreshold best_threshold(const ResultLine& line, const ClassTable& table,
                             std::string_view group) {
  if (group == kMacro) return macro_best_threshold(line, table);
  std::vector<ClassCurve> curves;
  for (const TrialResult& result : line.results)
    curves.push_back(counts_of_group(result.counts, table, group).curve);
  return best_threshold(curves);
}

}  // namespace mapscore::eval
