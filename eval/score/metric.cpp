// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/metric.hpp"

#include "core/error.hpp"

#include <algorithm>

namespace mapscore::eval {

std::optional<double> ratio(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

std::optional<double> f1(std::int64_t true_predicted, std::int64_t predicted, std::int64_t found,
                         std::int64_t visible) {
  if (predicted == 0 && visible == 0) return std::nullopt;
  const double p = ratio(true_predicted, predicted).value_or(0.0);
  const double r = ratio(found, visible).value_or(0.0);
  return p + r == 0.0 ? 0.0 : 2.0 * p * r / (p + r);
}

std::optional<double> frequency_weighted_iou(const std::vector<ClassOverlap>& classes) {
  std::int64_t all = 0;
  double sum = 0;
  for (const auto& [both, truth, named] : classes) {
    all += truth;
    if (truth > 0)
      sum += static_cast<double>(truth) * static_cast<double>(both) /
             static_cast<double>(truth + named - both);
  }
  return all > 0 ? std::optional(sum / static_cast<double>(all)) : std::nullopt;
}

std::vector<Metric> mean_over_classes(const std::vector<std::vector<Metric>>& classes) {
  std::vector<Metric> mean = classes.front();
  for (std::size_t figure = 0; figure < mean.size(); ++figure) {
    double sum = 0.0;
    int defined = 0;
    for (const std::vector<Metric>& metrics : classes) {
      if (!metrics[figure].value) continue;
      sum += *metrics[figure].value;
      ++defined;
    }
    mean[figure].value = defined == 0 ? std::nullopt : std::optional(sum / defined);
  }
  return mean;
}

bool is_size_of_error(std::string_view name) {
  return name.ends_with("_m") || name.ends_with("_deg") || name == "rpe_percent" ||
         name == "nees_mean" || name == "nees6_mean";
}

std::optional<double> value_of(const std::vector<Metric>& metrics, const std::string& name) {
  const auto metric = std::ranges::find(metrics, name, &Metric::name);
  if (metric == metrics.end()) {
    throw Error("metric '" + name +
                "': there is none of that name; score with the tolerance or distance it needs");
  }
  return metric->value;
}

}  // namespace mapscore::eval
