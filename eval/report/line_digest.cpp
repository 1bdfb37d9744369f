// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/line_digest.hpp"

#include "eval/report/best_threshold.hpp"
#include "eval/report/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mapscore::eval {
namespace {

/// Of the best threshold.
constexpr std::size_t kBestMetrics = 2;

double packed(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::optional<double> unpacked(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

/// What the best threshold is read from: of each class the curve, and whether it is seen.
TrialResult curves_of(TrialResult&& result) {
  TrialResult curves;
  for (ClassCounts& counts : result.counts) {
    ClassCounts& kept = curves.counts.emplace_back();
    kept.visible = counts.visible;
    kept.curve = std::move(counts.curve);
  }
  return curves;
}

}  // namespace

LineDigest::LineDigest(ResultLine& line, const ClassTable& table,
                       const std::vector<std::string>& groups)
    : seeds_(line.seeds.size()) {
  std::vector<std::vector<std::vector<double>>> by_group(groups.size());  // by seed, by metric
  ResultLine curves{line.role, line.method, line.cell, line.seeds, {}, {}};
  for (std::size_t seed = 0; seed < seeds_; ++seed) {
    TrialResult result = line.in_store(seed);
    pool_into(line.pooled, result.counts);
    accountings_.push_back(result.accounting);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      std::vector<double>& values = by_group[g].emplace_back();
      for (const Metric& metric : metrics_of_group(result.counts, table, groups[g]))
        values.push_back(packed(metric.value));
    }
    curves.results.push_back(curves_of(std::move(result)));
  }
  curves.pooled = line.pooled;
  for (std::size_t g = 0; g < groups.size(); ++g)
    groups_.push_back(formed(groups[g], metrics_of_group(line.pooled, table, groups[g]),
                             by_group[g], best_threshold(curves, table, groups[g])));
  const ClassCounts all = pool_detected(line.pooled, table);
  add_counts(pooled_, all);
  pooled_.curve = all.curve;
  pooled_.labels = all.labels;
}

LineDigest::Group LineDigest::formed(const std::string& name, const std::vector<Metric>& pooled,
                                     const std::vector<std::vector<double>>& by_seed,
                                     const BestThreshold& best) {
  const std::size_t columns = 1 + by_seed.size();
  Group group{name, {}, {}};
  group.values.resize((pooled.size() + kBestMetrics) * columns,
                      std::numeric_limits<double>::quiet_NaN());
  const auto value = [&](std::size_t metric, std::size_t column) -> double& {
    return group.values[metric * columns + column];
  };
  const auto put_best = [&](std::size_t column, const ChosenScore& chosen) {
    value(pooled.size(), column) = packed(chosen.f1);
    value(pooled.size() + 1, column) = packed(chosen.threshold);
  };
  for (std::size_t m = 0; m < pooled.size(); ++m) {
    group.metrics.push_back(pooled[m].name);
    value(m, 0) = packed(pooled[m].value);
  }
  group.metrics.insert(group.metrics.end(), {kBestF1, kBestThreshold});
  put_best(0, best.pooled);
  for (std::size_t s = 0; s < by_seed.size(); ++s) {
    for (std::size_t m = 0; m < by_seed[s].size(); ++m) value(m, 1 + s) = by_seed[s][m];
    put_best(1 + s, best.by_seed[s]);
  }
  return group;
}

const LineDigest::Group* LineDigest::find(std::string_view group) const {
  const auto found = std::ranges::find(groups_, group, &Group::name);
  return found == groups_.end() ? nullptr : &*found;
}

std::optional<Estimate> LineDigest::estimate(std::string_view group,
                                             const std::string& metric) const {
  const Group* of = find(group);
  if (!of) return std::nullopt;
  const auto name = std::ranges::find(of->metrics, metric);
  std::vector<std::optional<double>> values(seeds_);
  if (name == of->metrics.end()) {
    if (of->metrics.size() > kBestMetrics)
      static_cast<void>(value_of(*pooled_metrics(group), metric));  // throws
    return Estimate{{}, spread_of(metric, values), values};
  }
  const auto first =
      of->values.begin() + (name - of->metrics.begin()) * static_cast<std::ptrdiff_t>(1 + seeds_);
  std::transform(first + 1, first + 1 + static_cast<std::ptrdiff_t>(seeds_), values.begin(),
                 unpacked);
  return Estimate{unpacked(*first), spread_of(metric, values), values};
}

std::optional<std::vector<Metric>> LineDigest::pooled_metrics(std::string_view group) const {
  const Group* of = find(group);
  if (!of) return std::nullopt;
  std::vector<Metric> metrics;
  for (std::size_t m = 0; m + kBestMetrics < of->metrics.size(); ++m)
    metrics.push_back({of->metrics[m], unpacked(of->values[m * (1 + seeds_)])});
  return metrics;
}

}  // namespace mapscore::eval
