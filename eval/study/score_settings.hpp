// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"
#include "eval/score/counts.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// What is scored: the fused map, or each frame's observation by itself.
enum class ScoreUnit { map, frame };
constexpr auto names_of(ScoreUnit) {
  return std::to_array<std::string_view>({"map", "frame"});
}

/// A number, or `auto` (empty).
struct AutoNumber {
  std::optional<double> value;
  bool operator==(const AutoNumber&) const = default;
};

struct ScoreSettings {
  ScoreUnit unit = ScoreUnit::map;
  std::optional<double> at_s;  ///< empty: nothing moves, or each frame at its own time
  AutoNumber threshold;
  int min_samples = 1;
  double epsilon_m = 0.0005;
  std::vector<int> tolerances{0, 1};
  std::vector<double> distances_m{0.01, 0.02, 0.05, 0.1};
  AskedParts asked;

  static void fields(auto& s, auto&& visit) {
    visit(s.unit,
          Field{"unit", "score the fused map, or each frame's observation against its own truth"});
    visit(s.at_s, Field{"at_s",
                        "with unit map, where the scene moves: the time whose surfaces a map is "
                        "scored against"});
    visit(s.threshold,
          Field{"threshold",
                "least probability of a predicted voxel; auto: half of what a first full hit gives",
                {0, 1}});
    visit(s.min_samples,
          Field{"min_samples", "depth samples that make a voxel visible", {1, 1000000}});
    visit(s.epsilon_m, Field{"epsilon_m", "widening of voxels in the surface test", {0, 0.1}});
    visit(s.tolerances,
          Field{"tolerances", "tolerances of the match, in voxels; 0 is always counted", {0, 5}});
    visit(s.distances_m, Field{"distances_m", "distances of the F-score", above(0, 10)});
    AskedParts::fields(s.asked, visit);
  }
  bool operator==(const ScoreSettings&) const = default;
};

}  // namespace mapscore::eval
