// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/scene_counts.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

/// Counts by class, at the places of the classes in a table of `size`.
void reorder(const std::vector<std::size_t>& places, std::size_t size,
             std::vector<std::int64_t>& by_class) {
  std::vector<std::int64_t> ordered(by_class.empty() ? 0 : size);
  for (std::size_t c = 0; c < by_class.size(); ++c) ordered.at(places.at(c)) = by_class[c];
  by_class = std::move(ordered);
}

/// The zero counts of a class that was counted with the options of another.
ClassCounts zero_like(const ClassCounts& counts) {
  ClassCounts zero;
  for (const ToleranceCounts& at : counts.at_tolerance) zero.at_tolerance.push_back({at.voxels});
  zero.accuracy = DistanceTally(counts.accuracy.limits_m());
  zero.completeness = DistanceTally(counts.completeness.limits_m());
  const auto take = [](const auto& of, auto& part) {
    if constexpr (requires { of.has_value(); })
      if (of) part.emplace();
  };
  std::apply([&](const auto&... part) { (take(counts.*part.second, zero.*part.second), ...); },
             ClassCounts::parts());
  return zero;
}

}  // namespace

Counts in_table(const StudyRecord& record, const std::string& scene, Counts counts) {
  if (record.scenes.empty()) return counts;
  const auto of_scene = std::ranges::find(record.scenes, scene, &SceneRecord::name);
  if (of_scene == record.scenes.end())
    throw Error(
        fmt::format("scene '{}': the study's trials are of none of this name; sweep again", scene));
  const std::vector<std::string>& names = of_scene->classes;
  if (names.size() != counts.size())
    throw Error(fmt::format(
        "scene '{}': a trial counts other classes than were stored; sweep again", scene));
  std::vector<std::size_t> places;
  for (const std::string& name : names)
    places.push_back(static_cast<std::size_t>(
        std::ranges::find(record.table.classes, name, &SemanticClass::name) -
        record.table.classes.begin()));
  Counts joined(record.table.classes.size(), zero_like(counts.front()));
  for (std::size_t c = 0; c < counts.size(); ++c) {
    if (counts[c].labels) reorder(places, joined.size(), counts[c].labels->named_as);
    joined.at(places[c]) = std::move(counts[c]);
  }
  return joined;
}

}  // namespace mapscore::eval
