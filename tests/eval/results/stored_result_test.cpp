// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/store.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

// The reader of stored results against a plain one, by another library, on random results.

namespace mapscore::eval {
namespace {

using nlohmann::json;

template <class Owner>
void plain_counts(const json& object, Owner& owner) {
  for (const CountField<Owner>& field : Owner::counts())
    owner.*field.member = object.value(std::string(field.name), std::int64_t{0});
}

DistanceTally plain_tally(const json& object) {
  if (!object.contains("count"))
    return DistanceTally(object["limits_m"].get<std::vector<double>>());
  DistanceTally::Parts parts{object["limits_m"],  object["within"], object["count"],
                             object["unreached"], object["sum_nm"], {}};
  for (const json& bin : object["bins"])
    if (bin.is_array())
      for (int n = 0; n < bin[0]; ++n) parts.bins.push_back(0);
    else
      parts.bins.push_back(bin);
  return DistanceTally(std::move(parts));
}

ClassCurve plain_curve(const json& object) {
  ClassCurve curve{object["visible"], object.value("squared_error_billionth", std::int64_t{0}), {}};
  std::vector<std::int64_t> numbers;
  for (const json& row : object.value("steps", json::array()))  // older rows hold lists
    if (row.is_array())
      for (const json& number : row) numbers.push_back(number);
    else
      numbers.push_back(row);
  for (auto at = numbers.begin(); at != numbers.end(); at += 5)
    curve.steps.push_back({static_cast<int>(at[0]), at[1], at[2], at[3], at[4]});
  return curve;
}

ClassCounts plain_class(const json& object) {
  ClassCounts counts;
  plain_counts(object, counts);
  for (const json& at : object["at_tolerance"])
    counts.at_tolerance.push_back({at[0], at[1], at[2]});
  counts.accuracy = plain_tally(object["accuracy"]);
  counts.completeness = plain_tally(object["completeness"]);
  counts.curve = plain_curve(object["curve"]);
  plain_counts(object["boxes"], counts.boxes);
  if (object.contains("thin")) plain_counts(object["thin"], counts.thin.emplace());
  if (object.contains("instances")) {
    plain_counts(object["instances"], counts.instances.emplace());
    for (const json& row : object["instances"]["steps"]) {
      InstanceStep& step = counts.instances->steps.emplace_back();
      step.score = row[0];
      step.predicted = row[1];
      for (std::size_t n = 2; n < row.size(); ++n) step.true_predicted.at(n - 2) = row[n];
    }
  }
  return counts;
}

TrialResult plain_result(const std::string& text) {
  const json object = json::parse(text);
  TrialResult result;
  plain_counts(object["accounting"], result.accounting);
  for (const json& counts : object["classes"])
    result.counts.push_back(counts.is_number() ? result.counts.at(counts.get<std::size_t>())
                                               : plain_class(counts));
  return result;
}

/// Results with every field, many of them 0.
class RandomResults {
 public:
  TrialResult result() {
    TrialResult result;
    fill(result.accounting);
    for (std::size_t n = up_to(6) + 1; n > 0; --n) result.counts.push_back(counts());
    if (up_to(1)) result.counts.push_back(result.counts.front());
    if (up_to(1)) result.counts.push_back(zero_counts(1, {{}, {0.1, 0.3}, {}}).front());
    return result;
  }

 private:
  std::size_t up_to(std::size_t most) {
    return std::uniform_int_distribution<std::size_t>(0, most)(random_);
  }
  std::int64_t count() {
    static constexpr std::int64_t kTypical[]{0, 0, 1, 7, 40'000, 1'000'000'000'000'000'000};
    return kTypical[up_to(5)];
  }
  template <class Owner>
  void fill(Owner& owner) {
    for (const CountField<Owner>& field : Owner::counts()) owner.*field.member = count();
  }
  DistanceTally tally() {
    DistanceTally tally({0.01, 0.02, 0.1 * static_cast<double>(1 + up_to(7)) / 3.0 + 1.0});
    for (std::size_t n = up_to(5); n > 0; --n)
      tally.add(up_to(5) ? 0.0007 * static_cast<double>(up_to(3000)) : kUnreached,
                static_cast<std::int64_t>(up_to(9)));
    return tally;
  }
  ClassCurve curve() {
    ClassCurve curve{count(), count(), {}};
    for (std::size_t at = up_to(kCurveSteps); at > 0; at /= 2)
      curve.steps.push_back({static_cast<int>(at), count(), count(), count(), count()});
    return curve;
  }
  InstanceCounts instances() {
    InstanceCounts instances;
    fill(instances);
    for (std::size_t score = up_to(kCurveSteps); score > 0; score /= 2) {
      InstanceStep& step = instances.steps.emplace_back();
      step.score = static_cast<int>(score);
      step.predicted = count();
      for (std::int64_t& found : step.true_predicted) found = count();
    }
    return instances;
  }
  ClassCounts counts() {
    ClassCounts counts;
    fill(counts);
    for (int voxels = 1; voxels <= static_cast<int>(up_to(3)); ++voxels)
      counts.at_tolerance.push_back({voxels, count(), count()});
    counts.accuracy = tally();
    counts.completeness = tally();
    counts.curve = curve();
    fill(counts.boxes);
    if (up_to(1)) fill(counts.thin.emplace());
    if (up_to(1)) counts.instances = instances();
    return counts;
  }

  std::mt19937_64 random_{7};
};

void expect_equal(const TrialResult& a, const TrialResult& b, const std::string& text) {
  EXPECT_TRUE(a.counts == b.counts) << text;
  EXPECT_TRUE(a.accounting == b.accounting) << text;
}

TEST(StoredResult, IsReadAsPlainly) {
  RandomResults random;
  for (int n = 0; n < 500; ++n) {
    const TrialResult result = random.result();
    const std::string text = to_json(result);
    expect_equal(result_from_json(text), plain_result(text), text);
    expect_equal(result_from_json(text), result, text);
  }
}

TEST(StoredResult, RowsFromBeforeAreReadAsPlainly) {
  RandomResults random;
  for (int n = 0; n < 100; ++n) {
    const TrialResult result = random.result();
    json object = json::parse(to_json(result));
    for (json& counts : object["classes"]) {
      if (!counts.is_object() || !counts["curve"].contains("steps")) continue;
      json lists = json::array();
      const json flat = counts["curve"]["steps"];
      for (std::size_t at = 0; at < flat.size(); at += 5)
        lists.push_back(
            json::array({flat[at], flat[at + 1], flat[at + 2], flat[at + 3], flat[at + 4]}));
      counts["curve"]["steps"] = lists;
    }
    const std::string text = object.dump();
    expect_equal(result_from_json(text), plain_result(text), text);
    expect_equal(result_from_json(text), result, text);
  }
}

}  // namespace
}  // namespace mapscore::eval
