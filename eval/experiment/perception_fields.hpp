// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/fields.hpp"
#include "eval/experiment/perception_settings.hpp"

#include <array>
#include <string_view>

namespace mapscore::eval {

template <>
inline constexpr auto kNames<PerceivedBoxes> = std::to_array<std::string_view>({"instances",
                                                                                "surfaces"});

void fields(auto&&, Of<LabelPerceptionSettings> auto&) {}

void fields(auto&& visit, Of<SimulatedPerceptionSettings> auto& s) {
  visit(Field{"objects",
              "object map (YAML) whose boxes are perceived, from the study file's folder; default: "
              "the recording's truth"},
        s.objects);
  visit(Field{"boxes",
              "of the truth: one about each instance, along the axes of the scene's world, or one "
              "about each of its drawn surfaces, along the surface's"},
        s.boxes);
  visit(Field{"tolerance_m", "widening of the boxes on each side", {0, 1}}, s.tolerance_m);
  visit(Field{"min_pixels", "depth pixels that make an object seen", {1, 1000000}}, s.min_pixels);
}

}  // namespace mapscore::eval
