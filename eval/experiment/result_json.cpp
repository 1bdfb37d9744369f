// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/result_json.hpp"

#include "core/error.hpp"
#include "eval/experiment/result_fields.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <utility>

namespace mapscore::eval {
namespace {

using nlohmann::json;

template <class Owner, std::size_t N>
json fields_to_json(const Owner& owner, const std::array<CountField<Owner>, N>& fields) {
  json object;
  for (const auto& [name, member] : fields) object[name] = owner.*member;
  return object;
}

template <class Owner, std::size_t N>
void fields_from_json(const json& object, Owner& owner,
                      const std::array<CountField<Owner>, N>& fields) {
  for (const auto& [name, member] : fields) owner.*member = object.at(name);
}

json tally_to_json(const DistanceTally& tally) {
  const DistanceTally::Parts parts = tally.parts();
  return {{"limits_m", parts.limits_m},   {"within", parts.within}, {"count", parts.count},
          {"unreached", parts.unreached}, {"sum_nm", parts.sum_nm}, {"bins", parts.bins}};
}

DistanceTally tally_from_json(const json& object) {
  return DistanceTally(DistanceTally::Parts{object.at("limits_m"), object.at("within"),
                                            object.at("count"), object.at("unreached"),
                                            object.at("sum_nm"), object.at("bins")});
}

/// Steps as [thousandth, predicted, true_predicted, found, probability sum], since there are many.
json curve_to_json(const ClassCurve& curve) {
  json steps = json::array();
  for (const CurveStep& step : curve.steps)
    steps.push_back({step.thousandth, step.predicted, step.true_predicted, step.found,
                     step.probability_sum_billionth});
  return {{"visible", curve.visible},
          {"squared_error_billionth", curve.squared_error_billionth},
          {"steps", std::move(steps)}};
}

ClassCurve curve_from_json(const json& object) {
  ClassCurve curve{object.at("visible"), object.at("squared_error_billionth"), {}};
  for (const json& step : object.at("steps"))
    curve.steps.push_back({step.at(0), step.at(1), step.at(2), step.at(3), step.at(4)});
  return curve;
}

/// Steps as [score, predicted, true_predicted...], a true_predicted for each least IoU.
json instances_to_json(const InstanceCounts& instances) {
  json object = fields_to_json(instances, kInstanceCountFields);
  object["steps"] = json::array();
  for (const InstanceStep& step : instances.steps) {
    json row{step.score, step.predicted};
    for (const std::int64_t count : step.true_predicted) row.push_back(count);
    object["steps"].push_back(std::move(row));
  }
  return object;
}

InstanceCounts instances_from_json(const json& object) {
  InstanceCounts instances;
  fields_from_json(object, instances, kInstanceCountFields);
  for (const json& row : object.at("steps")) {
    InstanceStep step;
    step.score = row.at(0);
    step.predicted = row.at(1);
    for (std::size_t t = 0; t < step.true_predicted.size(); ++t)
      step.true_predicted[t] = row.at(2 + t);
    instances.steps.push_back(step);
  }
  return instances;
}

json counts_to_json(const ClassCounts& counts) {
  json object = fields_to_json(counts, kClassCountFields);
  object["at_tolerance"] = json::array();
  for (const ToleranceCounts& at : counts.at_tolerance)
    object["at_tolerance"].push_back({at.voxels, at.true_predicted, at.found});
  object["accuracy"] = tally_to_json(counts.accuracy);
  object["completeness"] = tally_to_json(counts.completeness);
  object["curve"] = curve_to_json(counts.curve);
  object["boxes"] = fields_to_json(counts.boxes, kBoxCountFields);
  if (counts.instances) object["instances"] = instances_to_json(*counts.instances);
  if (counts.thin) object["thin"] = fields_to_json(*counts.thin, kThinCountFields);
  return object;
}

ClassCounts counts_from_json(const json& object) {
  ClassCounts counts;
  fields_from_json(object, counts, kClassCountFields);
  for (const json& at : object.at("at_tolerance"))
    counts.at_tolerance.push_back({at.at(0), at.at(1), at.at(2)});
  counts.accuracy = tally_from_json(object.at("accuracy"));
  counts.completeness = tally_from_json(object.at("completeness"));
  counts.curve = curve_from_json(object.at("curve"));
  fields_from_json(object.at("boxes"), counts.boxes, kBoxCountFields);
  if (object.contains("instances")) counts.instances = instances_from_json(object.at("instances"));
  if (object.contains("thin"))
    fields_from_json(object.at("thin"), counts.thin.emplace(), kThinCountFields);
  return counts;
}

}  // namespace

std::string to_json(const TrialResult& result) {
  json object;
  object["accounting"] = fields_to_json(result.accounting, kAccountingFields);
  object["classes"] = json::array();
  for (const ClassCounts& counts : result.counts)
    object["classes"].push_back(counts_to_json(counts));
  return object.dump();
}

TrialResult result_from_json(const std::string& text) try {
  const json object = json::parse(text);
  TrialResult result;
  fields_from_json(object.at("accounting"), result.accounting, kAccountingFields);
  for (const json& counts : object.at("classes")) result.counts.push_back(counts_from_json(counts));
  return result;
} catch (const json::exception& error) {
  throw Error(std::string("stored result: not readable (") + error.what() +
              "); delete the store and sweep again");
}

}  // namespace mapscore::eval
