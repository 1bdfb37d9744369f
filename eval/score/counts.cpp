// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/counts.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore::eval {

namespace {

constexpr int kToleranceMax = 5;

template <typename T>
bool strictly_ascending(const std::vector<T>& values) {
  return std::adjacent_find(values.begin(), values.end(), [](T a, T b) { return !(a < b); }) ==
         values.end();
}

void pool_tolerances(std::vector<ToleranceCounts>& total,
                     const std::vector<ToleranceCounts>& other) {
  const auto same = [](const ToleranceCounts& a, const ToleranceCounts& b) {
    return a.voxels == b.voxels;
  };
  if (!std::equal(total.begin(), total.end(), other.begin(), other.end(), same)) {
    throw Error(
        "score: counts with different tolerances cannot be pooled; score both with the same list");
  }
  for (std::size_t t = 0; t < total.size(); ++t) {
    total[t].true_predicted += other[t].true_predicted;
    total[t].found += other[t].found;
  }
}

void pool_instances(std::optional<InstanceCounts>& total,
                    const std::optional<InstanceCounts>& other) {
  if (total.has_value() != other.has_value()) {
    throw Error(
        "score: counts with and without instances cannot be pooled; score both with the same "
        "score.instances");
  }
  if (total) *total += *other;
}

void pool_thin(std::optional<ThinCounts>& total, const std::optional<ThinCounts>& other) {
  if (total.has_value() != other.has_value()) {
    throw Error(
        "score: counts with and without thin parts cannot be pooled; score both with the same "
        "score.thin");
  }
  if (!total) return;
  total->predicted += other->predicted;
  total->true_predicted += other->true_predicted;
  total->visible += other->visible;
  total->found += other->found;
}

}  // namespace

void check(const ScoreOptions& options) {
  if (!strictly_ascending(options.tolerances) ||
      std::any_of(options.tolerances.begin(), options.tolerances.end(),
                  [](int t) { return t < 1 || t > kToleranceMax; })) {
    throw Error("score.tolerances: must be ascending whole voxels from 1 to 5");
  }
  if (!strictly_ascending(options.distances_m) ||
      std::any_of(options.distances_m.begin(), options.distances_m.end(),
                  [](double tau) { return !std::isfinite(tau) || tau <= 0; })) {
    throw Error("score.distances_m: must be ascending metres above 0");
  }
}

ClassCounts& ClassCounts::operator+=(const ClassCounts& other) {
  pool_tolerances(at_tolerance, other.at_tolerance);
  pool_instances(instances, other.instances);
  pool_thin(thin, other.thin);
  predicted += other.predicted;
  true_predicted += other.true_predicted;
  visible += other.visible;
  found += other.found;
  false_near += other.false_near;
  false_leak += other.false_leak;
  false_floating += other.false_floating;
  missed_mislabelled += other.missed_mislabelled;
  missed_unlabelled += other.missed_unlabelled;
  missed_unmapped += other.missed_unmapped;
  visible_4 += other.visible_4;
  found_4 += other.found_4;
  accuracy += other.accuracy;
  completeness += other.completeness;
  curve += other.curve;
  boxes += other.boxes;
  return *this;
}

Counts zero_counts(std::size_t class_count, const ScoreOptions& options) {
  ClassCounts zero;
  for (const int tolerance : options.tolerances) zero.at_tolerance.push_back({tolerance, 0, 0});
  if (options.thin) zero.thin.emplace();
  return Counts(class_count, zero);
}

void pool_into(Counts& total, const Counts& counts) {
  if (total.empty()) {
    total = counts;
    return;
  }
  if (total.size() != counts.size()) {
    throw Error(
        "score: counts of different class tables cannot be pooled; score against one scene");
  }
  for (std::size_t c = 0; c < total.size(); ++c) total[c] += counts[c];
}

ClassCounts pool_detected(const Counts& counts, const ClassTable& table) {
  if (counts.size() != table.classes.size()) {
    throw Error(
        "score: counts and class table differ in size; use the table the map was scored with");
  }
  std::optional<ClassCounts> pooled;
  for (const SemanticClass& semantic : table.classes) {
    if (!semantic.detect) continue;
    if (pooled) {
      *pooled += counts[semantic.id];
    } else {
      pooled = counts[semantic.id];
    }
  }
  return pooled.value_or(ClassCounts{});
}

}  // namespace mapscore::eval
