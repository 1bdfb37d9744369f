// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/fields.hpp"
#include "eval/experiment/fusion_settings.hpp"

#include <array>
#include <string_view>

namespace mapscore::eval {

template <>
inline constexpr auto kNames<NoiseAt> = std::to_array<std::string_view>({"base", "odom"});
template <>
inline constexpr auto kNames<CovarianceUse> = std::to_array<std::string_view>({"diagonal", "full"});
template <>
inline constexpr auto kNames<Decay> = std::to_array<std::string_view>({"hit", "view"});

void draw_fields(auto&& visit, auto& s) {
  visit(Field{"N", "draws from the pose belief for an observation", {1, 100000}}, s.N);
  visit(Field{"noise_at", "draw about the robot (base) or the odom origin (as the paper)"},
        s.noise_at);
  visit(Field{"covariance", "part of the pose covariance that is drawn from"}, s.covariance);
}

void doubt_field(auto&& visit, auto& s) {
  visit(Field{"doubt",
              "scores count as at least this and at most 1 - this",
              {.low = 0, .high = 0.5, .open_low = true, .open_high = true}},
        s.doubt);
}

void fields(auto&& visit, Of<BlendSettings> auto& s) {
  visit(Field{"K", "weight of what the map held before", {.low = 0, .high = 1, .open_high = true}},
        s.K);
  draw_fields(visit, s);
  visit(Field{.key = "decay",
              .meaning = "voxels whose old value decays: those that a draw hit, or all in view",
              .unkeyed = "hit"},
        s.decay);
}

void fields(auto&& visit, Of<MaxConfidenceSettings> auto& s) {
  draw_fields(visit, s);
}

void fields(auto&& visit, Of<VoteSettings> auto& s) {
  draw_fields(visit, s);
}

void fields(auto&& visit, Of<BayesSettings> auto& s) {
  draw_fields(visit, s);
  doubt_field(visit, s);
  visit(Field{"priors",
              "of each detected class in the order of ids, adding up to less than 1; the other "
              "classes share what is left; default: all classes equal",
              {.low = 0, .high = 1, .open_low = true, .open_high = true}},
        s.priors);
}

void fields(auto&& visit, Of<Top3Settings> auto& s) {
  draw_fields(visit, s);
  doubt_field(visit, s);
  visit(Field{"lambda",
              "share of the rest that a class split off it gets",
              {.low = 0, .high = 1, .open_low = true, .open_high = true}},
        s.lambda);
}

void fields(auto&&, Of<StudyFusionSettings> auto&) {}

}  // namespace mapscore::eval
