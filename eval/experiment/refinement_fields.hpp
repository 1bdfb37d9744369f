// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/fields.hpp"
#include "eval/experiment/refinement_settings.hpp"

#include <array>
#include <string_view>

namespace mapscore::eval {

template <>
inline constexpr auto kNames<CrfRest> = std::to_array<std::string_view>({"apart", "label"});
template <>
inline constexpr auto kNames<CrfFilter> = std::to_array<std::string_view>({"neighbours",
                                                                           "lattice"});

void fields(auto&&, Of<NoRefinementSettings> auto&) {}

void fields(auto&& visit, Of<CrfSettings> auto& s) {
  visit(Field{"smoothness_weight", "of the position kernel; 0: off", {0, 1000}},
        s.smoothness_weight);
  visit(Field{"smoothness_sigma_m", "reach of the position kernel", above(0, 10)},
        s.smoothness_sigma_m);
  visit(Field{"appearance_weight", "of the kernel of position and colour; 0: off", {0, 1000}},
        s.appearance_weight);
  visit(Field{"appearance_sigma_m", "reach in space of the kernel with colour", above(0, 10)},
        s.appearance_sigma_m);
  visit(Field{"appearance_sigma_colour", "reach in colour, levels of 0 to 255", above(0, 1000)},
        s.appearance_sigma_colour);
  visit(Field{"iterations", "of the mean field, at most", {1, 1000}}, s.iterations);
  visit(Field{"rest", "what no class claims stays apart, or is a label like any class"}, s.rest);
  visit(Field{"filter", "exact kernels to nearby voxels, or a permutohedral lattice"}, s.filter);
}

}  // namespace mapscore::eval
