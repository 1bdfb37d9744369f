// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/results/store.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <string_view>
#include <tuple>
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

/// A stored count. Throws Error where it is no whole number from 0 to 10^18.
std::int64_t count_of(const json& value) {
  constexpr std::int64_t kMost = 1'000'000'000'000'000'000;
  if (!value.is_number_integer() || value > kMost || value < 0)
    throw Error(
        fmt::format("stored result: {} is no count; delete the store and sweep again",
                    value.dump(-1, ' ', true, json::error_handler_t::replace).substr(0, 40)));
  return value;
}

/// The count of a key, 0 where it is left out.
std::int64_t count_of(const json& object, std::string_view key) {
  const auto found = object.find(key);
  return found == object.end() ? 0 : count_of(*found);
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

/// Distances above 10 km have no bin.
std::vector<std::int64_t> counts_of_runs(const json& list) {
  constexpr std::int64_t kMostBins = 10'000'000;
  std::vector<std::int64_t> counts;
  for (const json& value : list) {
    const std::int64_t zeros = value.is_array() ? count_of(value.at(0)) : 0;
    if (static_cast<std::int64_t>(counts.size()) + zeros > kMostBins)
      throw Error("stored result: too many bins; delete the store and sweep again");
    if (value.is_array())
      counts.resize(counts.size() + static_cast<std::size_t>(zeros), 0);
    else
      counts.push_back(count_of(value));
  }
  return counts;
}

std::vector<std::int64_t> counts_of(const json& list) {
  std::vector<std::int64_t> counts;
  for (const json& value : list) counts.push_back(count_of(value));
  return counts;
}

/// A place on a scale of thousandths, 0 to 1000.
int thousandth_of(const json& value) {
  const std::int64_t thousandth = count_of(value);
  if (thousandth > kCurveSteps)
    throw Error(fmt::format("stored result: {} is no thousandth; delete the store and sweep again",
                            thousandth));
  return static_cast<int>(thousandth);
}

template <class Owner>
void counts_from_json(const json& object, Owner& owner) {
  for (const CountField<Owner>& field : Owner::counts())
    owner.*field.member = count_of(object, field.name);
}

/// Without counts there are no bins.
json tally_to_json(const DistanceTally& tally) {
  const DistanceTally::Parts parts = tally.parts();
  if (parts.count == 0 && parts.bins.empty()) return {{"limits_m", parts.limits_m}};
  return {{"limits_m", parts.limits_m}, {"within", parts.within},
          {"count", parts.count},       {"unreached", parts.unreached},
          {"sum_nm", parts.sum_nm},     {"bins", runs_to_json(parts.bins)}};
}

DistanceTally tally_from_json(const json& object) {
  std::vector<double> limits_m = object.at("limits_m");
  if (!object.contains("count")) return DistanceTally(std::move(limits_m));
  return DistanceTally(
      DistanceTally::Parts{std::move(limits_m), counts_of(object.at("within")),
                           count_of(object.at("count")), count_of(object.at("unreached")),
                           count_of(object.at("sum_nm")), counts_of_runs(object.at("bins"))});
}

/// Throws Error unless the steps fall, as pooling takes them to do.
template <class Step>
void check_order(const std::vector<Step>& steps, int Step::*place) {
  if (std::ranges::adjacent_find(steps, std::ranges::less_equal{}, place) != steps.end())
    throw Error("stored result: steps do not fall; delete the store and sweep again");
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

/// Rows from before hold a list for each step.
std::vector<CurveStep> steps_of(const json& list) {
  std::vector<CurveStep> steps;
  const auto add = [&](const json& of, std::size_t first) {
    steps.push_back({thousandth_of(of.at(first)), count_of(of.at(first + 1)),
                     count_of(of.at(first + 2)), count_of(of.at(first + 3)),
                     count_of(of.at(first + 4))});
  };
  const bool is_flat = !list.empty() && !list.front().is_array();
  for (std::size_t n = 0; is_flat && n < list.size(); n += 5) add(list, n);
  for (std::size_t n = 0; !is_flat && n < list.size(); ++n) add(list[n], 0);
  return steps;
}

ClassCurve curve_from_json(const json& object) {
  ClassCurve curve{count_of(object.at("visible")), count_of(object, "squared_error_billionth"), {}};
  if (const auto steps = object.find("steps"); steps != object.end())
    curve.steps = steps_of(*steps);
  check_order(curve.steps, &CurveStep::thousandth);
  return curve;
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

void counts_from_json(const json& object, InstanceCounts& instances) {
  counts_from_json<InstanceCounts>(object, instances);
  for (const json& row : object.at("steps")) {
    InstanceStep step;
    step.score = thousandth_of(row.at(0));
    step.predicted = count_of(row.at(1));
    for (std::size_t t = 0; t < step.true_predicted.size(); ++t)
      step.true_predicted[t] = count_of(row.at(2 + t));
    instances.steps.push_back(step);
  }
  check_order(instances.steps, &InstanceStep::score);
}

template <class Part>
void take_part(const json& object, const char* name, Part& part) {
  counts_from_json(object.at(name), part);
}
template <class Part>
void take_part(const json& object, const char* name, std::optional<Part>& part) {
  if (object.contains(name)) counts_from_json(object.at(name), part.emplace());
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

void counts_from_json(const json& object, ClassCounts& counts) {
  counts_from_json<ClassCounts>(object, counts);
  for (const json& at : object.at("at_tolerance"))
    counts.at_tolerance.push_back(
        {static_cast<int>(count_of(at.at(0))), count_of(at.at(1)), count_of(at.at(2))});
  counts.accuracy = tally_from_json(object.at("accuracy"));
  counts.completeness = tally_from_json(object.at("completeness"));
  counts.curve = curve_from_json(object.at("curve"));
  std::apply(
      [&](const auto&... part) { (take_part(object, part.first, counts.*part.second), ...); },
      ClassCounts::parts());
}

/// The counts of a class before, that those of a class are equal to.
ClassCounts earlier_of(const Counts& counts, std::int64_t place) {
  if (place >= static_cast<std::int64_t>(counts.size()))
    throw Error(
        fmt::format("stored result: there is no class {} before; delete the store and sweep "
                    "again",
                    place));
  return counts[static_cast<std::size_t>(place)];
}

}  // namespace

std::string to_json(const TrialResult& result) {
  json object;
  object["accounting"] = counts_to_json(result.accounting);
  json& classes = object["classes"] = json::array();
  for (auto counts = result.counts.begin(); counts != result.counts.end(); ++counts) {
    const auto alike = std::find(result.counts.begin(), counts, *counts);
    classes.push_back(alike == counts ? counts_to_json(*counts)
                                      : json(std::distance(result.counts.begin(), alike)));
  }
  return object.dump();
}

TrialResult result_from_json(const std::string& text) try {
  const json object = json::parse(text);
  TrialResult result;
  counts_from_json(object.at("accounting"), result.accounting);
  for (const json& counts : object.at("classes")) {
    if (counts.is_number())
      result.counts.push_back(earlier_of(result.counts, count_of(counts)));
    else
      counts_from_json(counts, result.counts.emplace_back());
  }
  return result;
} catch (const json::exception& error) {
  throw Error(std::string("stored result: not readable (") + error.what() +
              "); delete the store and sweep again");
}

}  // namespace mapscore::eval
