// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/instances/instance_score.hpp"

#include "core/error.hpp"
#include "eval/score/instances/instance_match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <tuple>

namespace mapscore::eval {
namespace {

std::int64_t nano(const InstancePair& pair) {
  return (2 * pair.hits * kBillion + pair.whole) / (2 * pair.whole);
}

/// The instances of one class: pairs, and predictions by falling score, void ones left out.
struct OneClass {
  std::vector<InstancePair> pairs;
  std::vector<std::uint32_t> predictions;
};

/// Best first: greater score, more voxels, lower least key (which is the order of the indices).
void rank(const std::vector<PredictedInstance>& instances, std::vector<std::uint32_t>& order) {
  std::sort(order.begin(), order.end(), [&](std::uint32_t m, std::uint32_t n) {
    const PredictedInstance &a = instances[m], &b = instances[n];
    return std::tuple(-a.score, -a.voxels, m) < std::tuple(-b.score, -b.voxels, n);
  });
}

void count_matches(const OneClass& one, InstanceCounts& counts) {
  const std::vector<std::size_t> matched = match_by_iou(one.pairs);
  const auto matches = static_cast<std::int64_t>(matched.size());
  counts.true_positive += matches;
  counts.false_positive += static_cast<std::int64_t>(one.predictions.size()) - matches;
  counts.false_negative -= matches;
  for (const std::size_t n : matched) counts.iou_sum_nano += nano(one.pairs[n]);
}

void count_steps(const OneClass& one, const std::vector<PredictedInstance>& instances,
                 InstanceCounts& counts) {
  std::vector<InstanceStep> steps;
  for (const std::uint32_t p : one.predictions) steps.push_back({instances[p].score, 1, {}});
  for (std::size_t t = 0; t < kInstancePercents.size(); ++t) {
    const std::vector<bool> found =
        match_by_score(one.pairs, one.predictions, kInstancePercents[t]);
    for (std::size_t n = 0; n < found.size(); ++n) steps[n].true_predicted[t] = found[n];
  }
  pool_steps(counts.steps, steps, &InstanceStep::score);
}

void check_size(const std::vector<InstanceCounts>& counts, const ClassTable& table) {
  if (counts.size() == table.classes.size()) return;
  throw Error(
      "score: instance counts and class table differ in size; use the table the map was scored "
      "with");
}

}  // namespace

InstanceStep& InstanceStep::operator+=(const InstanceStep& other) {
  predicted += other.predicted;
  std::ranges::transform(true_predicted, other.true_predicted, true_predicted.begin(), std::plus{});
  return *this;
}

InstanceCounts& InstanceCounts::operator+=(const InstanceCounts& other) {
  add_counts(*this, other);
  pool_steps(steps, other.steps, &InstanceStep::score);
  return *this;
}

std::vector<InstanceCounts> score_instances(const PredictedInstances& predicted,
                                            const SurfaceTruth& surface,
                                            const VisibleTruth& visible, const ClassTable& table) {
  const InstanceOverlap overlap = overlap_of(predicted, surface, visible, table);
  std::vector<InstanceCounts> counts(table.classes.size());
  std::vector<OneClass> classes(table.classes.size());
  for (const InstancePair& pair : overlap.pairs) {
    classes[predicted.instances[pair.prediction].class_id].pairs.push_back(pair);
  }
  for (std::uint32_t p = 0; p < predicted.instances.size(); ++p) {
    const ClassId class_id = predicted.instances[p].class_id;
    if (!table.detected(class_id)) continue;
    if (overlap.is_void[p]) {
      ++counts[class_id].void_predicted;
    } else {
      classes[class_id].predictions.push_back(p);
    }
  }
  for (const Instance& instance : table.instances) {
    if (table.detected(instance.class_id) && overlap.visible[instance.id] > 0)
      ++counts[instance.class_id].false_negative;
  }
  for (ClassId c = 0; c < classes.size(); ++c) {
    if (!table.detected(c)) continue;
    rank(predicted.instances, classes[c].predictions);
    count_matches(classes[c], counts[c]);
    count_steps(classes[c], predicted.instances, counts[c]);
  }
  return counts;
}

std::optional<double> instance_ap(const InstanceCounts& counts, std::size_t threshold) {
  if (counts.visible() == 0) return std::nullopt;
  double area = 0.0, recall_before = 0.0;
  std::int64_t predicted = 0, found = 0;
  for (const InstanceStep& step : counts.steps) {
    predicted += step.predicted;
    found += step.true_predicted[threshold];
    const double recall = *ratio(found, counts.visible());
    area += (recall - recall_before) * *ratio(found, predicted);
    recall_before = recall;
  }
  return area;
}

std::vector<Metric> InstanceCounts::metrics() const {
  const std::int64_t twice = 2 * true_positive + false_positive + false_negative;
  std::vector<Metric> figures{{"pq", ratio(2 * iou_sum_nano, twice * kBillion)},
                              {"sq", ratio(iou_sum_nano, true_positive * kBillion)},
                              {"rq", ratio(2 * true_positive, twice)}};
  std::optional<double> sum;
  for (std::size_t t = 0; t < kInstancePercents.size(); ++t) {
    const int percent = kInstancePercents[t];
    const std::optional<double> ap = instance_ap(*this, t);
    if (percent == 25 || percent == 50 || percent == 75) {
      figures.push_back({fmt::format("ap_{}", percent), ap});
    }
    if (ap && t > 0) sum = sum.value_or(0.0) + *ap;
  }
  if (sum) *sum /= static_cast<double>(kInstancePercents.size() - 1);
  figures.push_back({"ap_mean", sum});
  return figures;
}

InstanceCounts pool_detected_instances(const std::vector<InstanceCounts>& counts,
                                       const ClassTable& table) {
  check_size(counts, table);
  InstanceCounts pooled;
  for (const SemanticClass& semantic : table.classes) {
    if (semantic.detect) pooled += counts[semantic.id];
  }
  return pooled;
}

std::vector<Metric> macro_instance_metrics(const std::vector<InstanceCounts>& counts,
                                           const ClassTable& table) {
  check_size(counts, table);
  std::vector<std::vector<Metric>> classes;
  for (const SemanticClass& semantic : table.classes) {
    if (!semantic.detect || counts[semantic.id].visible() == 0) continue;
    classes.push_back(counts[semantic.id].metrics());
  }
  if (classes.empty()) return {};
  return mean_over_classes(classes);
}

}  // namespace mapscore::eval
