// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/metrics.hpp"

#include "core/error.hpp"
#include "eval/score/box_score.hpp"
#include "eval/score/instance_score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace mapscore::eval {

namespace {

constexpr double kCentimetresPerMetre = 100.0;
constexpr double kPercentile = 0.95;

/// The figures against the voxels of V with many samples, undefined where there are none.
void append_many_samples(const ClassCounts& counts, std::vector<Metric>& metrics) {
  const std::int64_t false_predicted = counts.predicted - counts.true_predicted;
  std::optional<double> f1_4, iou_4;
  if (counts.visible_4 > 0) {
    f1_4 = f1(counts.true_predicted, counts.predicted, counts.found_4, counts.visible_4);
    iou_4 = ratio(counts.found_4, counts.visible_4 + false_predicted);
  }
  metrics.push_back({"recall_4", ratio(counts.found_4, counts.visible_4)});
  metrics.push_back({"f1_4", f1_4});
  metrics.push_back({"iou_4", iou_4});
}

void append_tolerance(const ClassCounts& counts, const ToleranceCounts& at,
                      std::vector<Metric>& metrics) {
  metrics.push_back(
      {fmt::format("precision_t{}", at.voxels), ratio(at.true_predicted, counts.predicted)});
  metrics.push_back({fmt::format("recall_t{}", at.voxels), ratio(at.found, counts.visible)});
  metrics.push_back({fmt::format("f1_t{}", at.voxels),
                     f1(at.true_predicted, counts.predicted, at.found, counts.visible)});
}

void append_limit(const DistanceTally& accuracy, const DistanceTally& completeness,
                  std::size_t limit, std::vector<Metric>& metrics) {
  const std::string tau =
      fmt::format("{:.6g}cm", accuracy.limits_m()[limit] * kCentimetresPerMetre);
  const std::int64_t precise = accuracy.within(limit), complete = completeness.within(limit);
  metrics.push_back({"precision_" + tau, ratio(precise, accuracy.count())});
  metrics.push_back({"recall_" + tau, ratio(complete, completeness.count())});
  metrics.push_back({"f_" + tau, f1(precise, accuracy.count(), complete, completeness.count())});
}

void append_distances(const ClassCounts& counts, std::vector<Metric>& metrics) {
  const DistanceTally &accuracy = counts.accuracy, &completeness = counts.completeness;
  for (std::size_t l = 0; l < accuracy.limits_m().size(); ++l) {
    append_limit(accuracy, completeness, l, metrics);
  }
  if (accuracy.limits_m().empty()) return;
  metrics.push_back({"accuracy_mean_m", accuracy.mean_m()});
  metrics.push_back({"accuracy_p95_m", accuracy.percentile_m(kPercentile)});
  metrics.push_back({"completeness_mean_m", completeness.mean_m()});
  metrics.push_back({"completeness_p95_m", completeness.percentile_m(kPercentile)});
}

void append_thin(const ThinCounts& thin, std::vector<Metric>& metrics) {
  metrics.push_back({"thin_precision", ratio(thin.true_predicted, thin.predicted)});
  metrics.push_back({"thin_recall", ratio(thin.found, thin.visible)});
  metrics.push_back({"thin_f1", f1(thin.true_predicted, thin.predicted, thin.found, thin.visible)});
}

/// The figures of a class as they enter the mean over classes: without those of instances.
std::vector<Metric> metrics_for_mean(ClassCounts counts) {
  counts.instances.reset();
  return metrics_of(counts);
}

/// Means over the classes with visible instances, all undefined where there is none; nothing where
/// instances were not scored.
std::vector<Metric> mean_instance_metrics(const Counts& counts, const ClassTable& table) {
  std::vector<InstanceCounts> instances;
  for (const ClassCounts& of_class : counts) {
    if (!of_class.instances) return {};
    instances.push_back(*of_class.instances);
  }
  std::vector<Metric> macro = macro_instance_metrics(instances, table);
  return macro.empty() ? instance_metrics({}) : macro;
}

}  // namespace

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

std::optional<double> precision(const ClassCounts& counts) {
  return ratio(counts.true_predicted, counts.predicted);
}

std::optional<double> recall(const ClassCounts& counts) {
  return ratio(counts.found, counts.visible);
}

std::optional<double> f1(const ClassCounts& counts) {
  return f1(counts.true_predicted, counts.predicted, counts.found, counts.visible);
}

std::optional<double> iou(const ClassCounts& counts) {
  return ratio(counts.found, counts.visible + counts.predicted - counts.true_predicted);
}

std::vector<Metric> metrics_of(const ClassCounts& counts) {
  std::vector<Metric> metrics{{"precision", precision(counts)},
                              {"recall", recall(counts)},
                              {"f1", f1(counts)},
                              {"iou", iou(counts)}};
  append_many_samples(counts, metrics);
  for (const ToleranceCounts& at : counts.at_tolerance) append_tolerance(counts, at, metrics);
  append_distances(counts, metrics);
  metrics.push_back({"ap", average_precision(counts.curve)});
  metrics.push_back({"brier", brier(counts.curve)});
  metrics.push_back({"ece", expected_calibration_error(counts.curve)});
  for (Metric& metric : box_metrics(counts.boxes)) metrics.push_back(std::move(metric));
  if (counts.thin) append_thin(*counts.thin, metrics);
  if (!counts.instances) return metrics;
  for (Metric& metric : instance_metrics(*counts.instances)) metrics.push_back(std::move(metric));
  return metrics;
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

std::vector<Metric> macro_metrics(const Counts& counts, const ClassTable& table) {
  if (counts.size() != table.classes.size()) {
    throw Error(
        "score: counts and class table differ in size; use the table the map was scored with");
  }
  std::vector<std::vector<Metric>> classes;
  for (const SemanticClass& semantic : table.classes) {
    if (!semantic.detect || counts[semantic.id].visible == 0) continue;
    classes.push_back(metrics_for_mean(counts[semantic.id]));
  }
  if (classes.empty()) return {};
  std::vector<Metric> macro = mean_over_classes(classes);
  for (Metric& metric : mean_instance_metrics(counts, table)) macro.push_back(std::move(metric));
  macro.push_back({"mpa", value_of(macro, "recall")});
  macro.push_back({"miou", value_of(macro, "iou")});
  return macro;
}

std::optional<double> value_of(const std::vector<Metric>& metrics, const std::string& name) {
  const auto metric = std::find_if(metrics.begin(), metrics.end(),
                                   [&name](const Metric& m) { return m.name == name; });
  if (metric == metrics.end()) {
    throw Error("metric '" + name +
                "': there is none of that name; score with the tolerance or distance it needs");
  }
  return metric->value;
}

}  // namespace mapscore::eval
