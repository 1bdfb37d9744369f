// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/best_threshold.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <cstddef>

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

/// Mean of the figures that are defined.
class DefinedMean {
 public:
  void add(const std::optional<double>& value) {
    if (!value) return;
    sum_ += *value;
    ++count_;
  }
  [[nodiscard]] std::optional<double> value() const {
    return count_ == 0 ? std::nullopt : std::optional(sum_ / count_);
  }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

struct MeanScore {
  DefinedMean f1, threshold;

  void add(const ChosenScore& score) {
    f1.add(score.f1);
    threshold.add(score.threshold);
  }
  [[nodiscard]] ChosenScore value() const { return {f1.value(), threshold.value()}; }
};

/// A class's curve at each seed.
std::vector<ClassCurve> curves_of_class(const ResultLine& line, ClassId class_id) {
  std::vector<ClassCurve> curves;
  for (const TrialResult& result : line.results) curves.push_back(result.counts.at(class_id).curve);
  return curves;
}

BestThreshold macro_best_threshold(const ResultLine& line, const ClassTable& table) {
  std::vector<MeanScore> by_seed(line.results.size());
  MeanScore pooled;
  for (const SemanticClass& semantic : table.classes) {
    if (!semantic.detect) continue;
    const BestThreshold of_class = best_threshold(curves_of_class(line, semantic.id));
    for (std::size_t s = 0; s < by_seed.size(); ++s)
      if (line.results[s].counts.at(semantic.id).visible > 0) by_seed[s].add(of_class.by_seed[s]);
    if (line.pooled.at(semantic.id).visible > 0) pooled.add(of_class.pooled);
  }
  BestThreshold macro;
  for (const MeanScore& mean : by_seed) macro.by_seed.push_back(mean.value());
  macro.pooled = pooled.value();
  return macro;
}

}  // namespace

BestThreshold best_threshold(std::span<const ClassCurve> seeds) {
  BestThreshold best;
  best.by_seed.resize(seeds.size());
  if (seeds.size() < 2) return best;
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
  if (group == kPooled) {
    std::vector<ClassCurve> curves;
    for (const TrialResult& result : line.results)
      curves.push_back(pool_detected(result.counts, table).curve);
    return best_threshold(curves);
  }
  for (const SemanticClass& semantic : table.classes)
    if (semantic.name == group) return best_threshold(curves_of_class(line, semantic.id));
  throw Error(fmt::format("class '{}': not in the class table", group));
}

}  // namespace mapscore::eval
