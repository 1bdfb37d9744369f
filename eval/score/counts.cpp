// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/counts.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace mapscore::eval {

namespace {

constexpr int kToleranceMax = 5;

template <typename T>
bool strictly_ascending(const std::vector<T>& values) {
  return std::ranges::adjacent_find(values, std::not_fn(std::less{})) == values.end();
}

void pool_tolerances(std::vector<ToleranceCounts>& total,
                     const std::vector<ToleranceCounts>& other) {
  constexpr auto kVoxels = &ToleranceCounts::voxels;
  if (!std::ranges::equal(total, other, {}, kVoxels, kVoxels)) {
    throw Error(
        "score: counts with different tolerances cannot be pooled; score both with the same list");
  }
  for (std::size_t t = 0; t < total.size(); ++t) {
    total[t].true_predicted += other[t].true_predicted;
    total[t].found += other[t].found;
  }
}

template <class Part>
void pool(const char*, Part& total, const Part& other) {
  total += other;
}

template <class Part>
void pool(const char* name, std::optional<Part>& total, const std::optional<Part>& other) {
  if (total.has_value() != other.has_value())
    throw Error(
        fmt::format("score: counts with and without {0} cannot be pooled; score both with the same "
                    "score.{0}",
                    name));
  if (total) *total += *other;
}

}  // namespace

void check(const ScoreOptions& options) {
  const std::vector<int>& tolerances = options.tolerances;
  if (!strictly_ascending(tolerances) ||
      (!tolerances.empty() && (tolerances.front() < 1 || tolerances.back() > kToleranceMax))) {
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
  std::apply(
      [&](const auto&... part) { (pool(part.first, this->*part.second, other.*part.second), ...); },
      parts());
  add_counts(*this, other);
  accuracy += other.accuracy;
  completeness += other.completeness;
  curve += other.curve;
  return *this;
}

Counts zero_counts(std::size_t class_count, const ScoreOptions& options) {
  ClassCounts zero;
  for (const int tolerance : options.tolerances) zero.at_tolerance.push_back({tolerance, 0, 0});
  AskedParts::fields(options.asked, [&](bool asked, const Field& field) {
    const auto take = [&](std::string_view name, auto& part) {
      if constexpr (requires { part.emplace(); })
        if (asked && name == field.key) part.emplace();
    };
    std::apply([&](const auto&... part) { (take(part.first, zero.*part.second), ...); },
               ClassCounts::parts());
  });
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
  Counts pooled;
  for (const SemanticClass& semantic : table.classes) {
    if (semantic.detect) pool_into(pooled, {counts[semantic.id]});
  }
  if (pooled.empty()) return {};
  pool("labels", pooled.front().labels, counts[kBackground].labels);
  pooled.front().poses = counts[kBackground].poses;
  return std::move(pooled.front());
}

}  // namespace mapscore::eval
