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

}  // namespace

LineDigest::LineDigest(const ResultLine& line, const ClassTable& table,
                       const std::vector<std::string>& groups)
    : seeds_(line.results.size()) {
  const ClassCounts all = pool_detected(line.pooled, table);
  add_counts(pooled_, all);
  for (const std::string& name : groups) {
    Group group{name, {}, {}};
    const std::vector<Metric> pooled = metrics_of_group(line.pooled, table, name);
    const BestThreshold best = best_threshold(line, table, name);
    group.values.resize((pooled.size() + kBestMetrics) * (1 + seeds_),
                        std::numeric_limits<double>::quiet_NaN());
    const auto put = [&](std::size_t column, const std::vector<Metric>& metrics,
                         const ChosenScore& chosen) {
      const auto value = [&](std::size_t m) -> double& {
        return group.values[m * (1 + seeds_) + column];
      };
      for (std::size_t m = 0; m < metrics.size(); ++m) value(m) = packed(metrics[m].value);
      value(pooled.size()) = packed(chosen.f1);
      value(pooled.size() + 1) = packed(chosen.threshold);
    };
    for (const Metric& metric : pooled) group.metrics.push_back(metric.name);
    group.metrics.insert(group.metrics.end(), {kBestF1, kBestThreshold});
    put(0, pooled, best.pooled);
    for (std::size_t s = 0; s < seeds_; ++s)
      put(1 + s, metrics_of_group(line.results[s].counts, table, name), best.by_seed[s]);
    groups_.push_back(std::move(group));
  }
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
    return Estimate{{}, summarise(values), values};
  }
  const auto first =
      of->values.begin() + (name - of->metrics.begin()) * static_cast<std::ptrdiff_t>(1 + seeds_);
  std::transform(first + 1, first + 1 + static_cast<std::ptrdiff_t>(seeds_), values.begin(),
                 unpacked);
  return Estimate{unpacked(*first), summarise(values), values};
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
