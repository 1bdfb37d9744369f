// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/metrics.hpp"

#include "core/error.hpp"
#include "eval/score/instances/instance_score.hpp"

#include <fmt/format.h>

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

/// Means over the classes with visible instances, all undefined where there is none; nothing where
/// instances were not scored.
std::vector<Metric> mean_instance_metrics(const Counts& counts, const ClassTable& table) {
  std::vector<InstanceCounts> instances;
  for (const ClassCounts& of_class : counts) {
    if (!of_class.instances) return {};
    instances.push_back(*of_class.instances);
  }
  std::vector<Metric> macro = macro_instance_metrics(instances, table);
  return macro.empty() ? InstanceCounts{}.metrics() : macro;
}

/// IoUs of the classes, each by its share of the true pixels.
std::optional<double> frequency_weighted_iou(const Counts& counts) {
  std::vector<ClassOverlap> classes;
  for (const ClassCounts& c : counts)
    classes.push_back({c.labels->right_px, c.labels->true_px, c.labels->named_px});
  return frequency_weighted_iou(classes);
}

/// Means over all classes with pixels in the truth, background included, as of label images, and
/// label_fwiou; all undefined where there is none; nothing where detections were not scored in the
/// image.
std::vector<Metric> mean_label_metrics(const Counts& counts) {
  std::vector<std::vector<Metric>> present;
  for (const ClassCounts& of_class : counts) {
    if (!of_class.labels) return {};
    if (of_class.labels->true_px > 0) present.push_back(of_class.labels->metrics());
  }
  std::vector<Metric> means =
      present.empty() ? LabelCounts{}.metrics() : mean_over_classes(present);
  means.push_back({"label_fwiou", frequency_weighted_iou(counts)});
  return means;
}

}  // namespace

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
  for_each_part(counts, [&](const char*, const auto& part) {
    for (Metric& metric : part.metrics()) metrics.push_back(std::move(metric));
  });
  return metrics;
}

std::vector<Metric> macro_metrics(const Counts& counts, const ClassTable& table) {
  if (counts.size() != table.classes.size()) {
    throw Error(
        "score: counts and class table differ in size; use the table the map was scored with");
  }
  std::vector<std::vector<Metric>> classes;
  for (const SemanticClass& semantic : table.classes) {
    if (!semantic.detect || counts[semantic.id].visible == 0) continue;
    ClassCounts of_class = counts[semantic.id];
    of_class.instances.reset();  // which have means of their own
    of_class.labels.reset();
    of_class.poses.reset();  // of no class
    classes.push_back(metrics_of(of_class));
  }
  if (classes.empty()) return {};
  std::vector<Metric> macro = mean_over_classes(classes);
  for (Metric& metric : mean_instance_metrics(counts, table)) macro.push_back(std::move(metric));
  for (Metric& metric : mean_label_metrics(counts)) macro.push_back(std::move(metric));
  if (const auto& poses = counts[kBackground].poses)
    for (Metric& metric : poses->metrics()) macro.push_back(std::move(metric));
  macro.push_back({"mpa", value_of(macro, "recall")});
  macro.push_back({"miou", value_of(macro, "iou")});
  return macro;
}

}  // namespace mapscore::eval
