// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/store.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace mapscore::eval {
namespace {

using nlohmann::json;

/// Counts that are 0 are left out.
template <class Owner>
json counts_to_json(const Owner& owner) {
  json object = json::object();
  for (const CountField<Owner>& field : Owner::counts())
    if (owner.*field.member != 0) object[field.name] = owner.*field.member;
  return object;
}

/// [n] stands for n zeros.
json runs_to_json(const std::vector<std::int64_t>& counts) {
  json list = json::array();
  for (auto at = counts.begin(); at != counts.end();) {
    const auto end = std::find_if(at, counts.end(), [](std::int64_t count) { return count != 0; });
    if (end - at > 1) list.push_back(json::array({end - at}));
    if (end - at == 1) list.push_back(0);
    at = end;
    if (at != counts.end()) list.push_back(*at++);
  }
  return list;
}

/// Without counts there are no bins.
json tally_to_json(const DistanceTally& tally) {
  const DistanceTally::Parts parts = tally.parts();
  if (parts.count == 0 && parts.bins.empty()) return {{"limits_m", parts.limits_m}};
  return {{"limits_m", parts.limits_m}, {"within", parts.within},
          {"count", parts.count},       {"unreached", parts.unreached},
          {"sum_nm", parts.sum_nm},     {"bins", runs_to_json(parts.bins)}};
}

/// Steps one after the other, since there are many: thousandth, predicted, true_predicted, found,
/// probability sum.
json curve_to_json(const ClassCurve& curve) {
  json object{{"visible", curve.visible}};
  if (curve.squared_error_billionth != 0)
    object["squared_error_billionth"] = curve.squared_error_billionth;
  if (curve.steps.empty()) return object;
  json::array_t steps;
  steps.reserve(5 * curve.steps.size());
  for (const CurveStep& step : curve.steps)
    for (const std::int64_t number :
         {std::int64_t{step.thousandth}, step.predicted, step.true_predicted, step.found,
          step.probability_sum_billionth})
      steps.emplace_back(number);
  object["steps"] = std::move(steps);
  return object;
}

/// Steps as [score, predicted, true_predicted...], a true_predicted for each least IoU.
json counts_to_json(const InstanceCounts& instances) {
  json object = counts_to_json<InstanceCounts>(instances);
  object["steps"] = json::array();
  for (const InstanceStep& step : instances.steps) {
    json row{step.score, step.predicted};
    for (const std::int64_t count : step.true_predicted) row.push_back(count);
    object["steps"].push_back(std::move(row));
  }
  return object;
}

/// Bins one after the other: count, right, confidence_sum_nano.
json bins_to_json(const Reliability& reliability) {
  std::vector<std::int64_t> numbers;
  for (const ConfidenceBin& bin : reliability.bins)
    numbers.insert(numbers.end(), {bin.count, bin.right, bin.confidence_sum_nano});
  return runs_to_json(numbers);
}

json counts_to_json(const LabelCounts& labels) {
  json object = counts_to_json<LabelCounts>(labels);
  if (!labels.named_as.empty()) object["named_as"] = runs_to_json(labels.named_as);
  if (labels.scores != Reliability{}) object["scores"] = bins_to_json(labels.scores);
  if (labels.pixels != Reliability{}) object["pixels"] = bins_to_json(labels.pixels);
  return object;
}

json counts_to_json(const ClassCounts& counts) {
  json object = counts_to_json<ClassCounts>(counts);
  object["at_tolerance"] = json::array();
  for (const ToleranceCounts& at : counts.at_tolerance)
    object["at_tolerance"].push_back({at.voxels, at.true_predicted, at.found});
  object["accuracy"] = tally_to_json(counts.accuracy);
  object["completeness"] = tally_to_json(counts.completeness);
  object["curve"] = curve_to_json(counts.curve);
  for_each_part(counts,
                [&](const char* name, const auto& part) { object[name] = counts_to_json(part); });
  return object;
}

}  // namespace

std::string to_json(const TrialResult& result) {
  json object;
  object["accounting"] = counts_to_json(result.accounting);
  if (const auto& tracking = result.accounting.tracking)
    object["accounting"]["tracking"] = counts_to_json(*tracking);
  if (const auto& calibration = result.accounting.calibration)
    object["accounting"]["calibration"] = counts_to_json(*calibration);
  json& classes = object["classes"] = json::array();
  for (auto counts = result.counts.begin(); counts != result.counts.end(); ++counts) {
    const auto alike = std::find(result.counts.begin(), counts, *counts);
    classes.push_back(alike == counts ? counts_to_json(*counts)
                                      : json(std::distance(result.counts.begin(), alike)));
  }
  return object.dump();
}

}  // namespace mapscore::eval
