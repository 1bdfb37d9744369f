// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/results/store.hpp"
#include "files/text.hpp"

#include <fmt/format.h>
#include <simdjson.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

// The reading half of result_json.cpp: most of the time of tables and figures is spent here.

namespace mapscore::eval {
namespace {

namespace dom = simdjson::dom;

[[noreturn]] void refuse_result(const std::string& what) {
  throw Error("stored result: " + what + "; delete the store and sweep again");
}

/// A stored count. Throws Error where it is no whole number from 0 to 10^18.
std::int64_t count_of(dom::element value) {
  constexpr std::int64_t kMost = 1'000'000'000'000'000'000;
  std::int64_t count = 0;
  if (value.get(count) != simdjson::SUCCESS || count > kMost || count < 0)
    refuse_result(shown(simdjson::minify(value).substr(0, 40)) + " is no count");
  return count;
}

/// The count of a key, 0 where it is left out.
std::int64_t count_of(dom::object object, std::string_view key) {
  dom::element value;
  return object.at_key(key).get(value) == simdjson::SUCCESS ? count_of(value) : 0;
}

/// Of a list, no fewer than `least`.
std::vector<std::int64_t> counts_of(dom::array list, std::size_t least = 0) {
  std::vector<std::int64_t> counts;
  counts.reserve(list.size());
  for (const dom::element value : list) counts.push_back(count_of(value));
  if (counts.size() < least) refuse_result("a list is too short");
  return counts;
}

/// [n] stands for n zeros. Distances above 10 km have no bin.
std::vector<std::int64_t> counts_of_runs(dom::array list) {
  constexpr std::int64_t kMostBins = 10'000'000;
  std::vector<std::int64_t> counts;
  for (const dom::element value : list) {
    const std::int64_t zeros = value.is_array() ? count_of(value.at(0)) : 0;
    if (static_cast<std::int64_t>(counts.size()) + zeros > kMostBins)
      refuse_result("too many bins");
    if (value.is_array())
      counts.resize(counts.size() + static_cast<std::size_t>(zeros), 0);
    else
      counts.push_back(count_of(value));
  }
  return counts;
}

/// A place on a scale of thousandths, 0 to 1000.
int checked_thousandth(std::int64_t place) {
  if (place > kCurveSteps) refuse_result(fmt::format("{} is no thousandth", place));
  return static_cast<int>(place);
}

/// Throws Error unless the steps fall, as pooling takes them to do.
template <class Step>
void check_order(const std::vector<Step>& steps, int Step::*place) {
  if (std::ranges::adjacent_find(steps, std::ranges::less_equal{}, place) != steps.end())
    refuse_result("steps do not fall");
}

template <class Owner>
void take_counts(dom::object object, Owner& owner) {
  for (const CountField<Owner>& field : Owner::counts())
    owner.*field.member = count_of(object, field.name);
}

DistanceTally tally_of(dom::object object) {
  std::vector<double> limits_m;
  for (const dom::element limit : dom::array(object["limits_m"])) limits_m.push_back(limit);
  dom::element count;
  if (object.at_key("count").get(count) != simdjson::SUCCESS)
    return DistanceTally(std::move(limits_m));
  return DistanceTally(DistanceTally::Parts{
      std::move(limits_m), counts_of(object["within"]), count_of(count),
      count_of(object["unreached"]), count_of(object["sum_nm"]), counts_of_runs(object["bins"])});
}

/// The numbers of a step one after the other; rows from before hold a list for each step.
std::vector<CurveStep> curve_steps_of(dom::array list) {
  constexpr std::size_t kNumbers = 5;
  std::vector<CurveStep> steps;
  std::vector<std::int64_t> numbers;
  for (const dom::element value : list) {
    if (value.is_array())
      numbers = counts_of(value, kNumbers);
    else
      numbers.push_back(count_of(value));
    if (numbers.size() < kNumbers) continue;
    steps.push_back(
        {checked_thousandth(numbers[0]), numbers[1], numbers[2], numbers[3], numbers[4]});
    numbers.clear();
  }
  if (!numbers.empty()) refuse_result("a curve ends within a step");
  check_order(steps, &CurveStep::thousandth);
  return steps;
}

ClassCurve curve_of(dom::object object) {
  ClassCurve curve{count_of(object["visible"]), count_of(object, "squared_error_billionth"), {}};
  dom::element steps;
  if (object.at_key("steps").get(steps) == simdjson::SUCCESS) curve.steps = curve_steps_of(steps);
  return curve;
}

void take_counts(dom::object object, InstanceCounts& instances) {
  take_counts<InstanceCounts>(object, instances);
  for (const dom::element row : dom::array(object["steps"])) {
    InstanceStep step;
    const auto numbers = counts_of(row, 2 + step.true_predicted.size());
    step.score = checked_thousandth(numbers[0]);
    step.predicted = numbers[1];
    std::copy_n(numbers.begin() + 2, step.true_predicted.size(), step.true_predicted.begin());
    instances.steps.push_back(step);
  }
  check_order(instances.steps, &InstanceStep::score);
}

/// The numbers of a key, none where it is left out.
std::vector<std::int64_t> numbers_at(dom::object object, std::string_view key) {
  dom::element list;
  return object.at_key(key).get(list) == simdjson::SUCCESS ? counts_of_runs(list)
                                                           : std::vector<std::int64_t>();
}

/// Bins one after the other: count, right, confidence_sum_nano.
Reliability reliability_at(dom::object object, std::string_view key) {
  Reliability reliability;
  const std::vector<std::int64_t> numbers = numbers_at(object, key);
  if (numbers.empty()) return reliability;
  if (numbers.size() != 3 * reliability.bins.size()) refuse_result("bins are missing");
  for (std::size_t n = 0; n < reliability.bins.size(); ++n)
    reliability.bins[n] = {numbers[3 * n], numbers[3 * n + 1], numbers[3 * n + 2]};
  return reliability;
}

void take_counts(dom::object object, LabelCounts& labels) {
  take_counts<LabelCounts>(object, labels);
  labels.named_as = numbers_at(object, "named_as");
  labels.scores = reliability_at(object, "scores");
  labels.pixels = reliability_at(object, "pixels");
}

template <class Part>
void take_part(dom::object object, const char* name, Part& part) {
  take_counts(object[name], part);
}
template <class Part>
void take_part(dom::object object, const char* name, std::optional<Part>& part) {
  dom::element there;
  if (object.at_key(name).get(there) == simdjson::SUCCESS) take_counts(there, part.emplace());
}

void take_counts(dom::object object, Accounting& accounting) {
  take_counts<Accounting>(object, accounting);
  take_part(object, "tracking", accounting.tracking);
  take_part(object, "calibration", accounting.calibration);
}

void take_counts(dom::object object, ClassCounts& counts) {
  take_counts<ClassCounts>(object, counts);
  for (const dom::element at : dom::array(object["at_tolerance"])) {
    const auto numbers = counts_of(at, 3);
    counts.at_tolerance.push_back({static_cast<int>(numbers[0]), numbers[1], numbers[2]});
  }
  counts.accuracy = tally_of(object["accuracy"]);
  counts.completeness = tally_of(object["completeness"]);
  counts.curve = curve_of(object["curve"]);
  std::apply(
      [&](const auto&... part) { (take_part(object, part.first, counts.*part.second), ...); },
      ClassCounts::parts());
}

/// The counts of a class before, that those of a class are equal to.
ClassCounts earlier_of(const Counts& counts, std::int64_t place) {
  if (place >= static_cast<std::int64_t>(counts.size()))
    refuse_result(fmt::format("there is no class {} before", place));
  return counts[static_cast<std::size_t>(place)];
}

}  // namespace

TrialResult result_from_json(const std::string& text) try {
  dom::parser parser;
  const dom::object object = parser.parse(text);
  TrialResult result;
  take_counts(object["accounting"], result.accounting);
  for (const dom::element counts : dom::array(object["classes"])) {
    if (counts.is_object())
      take_counts(counts, result.counts.emplace_back());
    else
      result.counts.push_back(earlier_of(result.counts, count_of(counts)));
  }
  return result;
} catch (const simdjson::simdjson_error& error) {
  refuse_result(std::string("not readable (") + error.what() + ")");
}

}  // namespace mapscore::eval
