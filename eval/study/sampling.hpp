// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

namespace mapscore::eval {

// Which points of its swept paths a study tries.

struct FullGrid : NoFields {
  static constexpr std::string_view kKind = "grid";
  static constexpr std::string_view kMeaning = "every combination of the swept values";
};

/// Points over ranges: a swept path with numbers has two, [LOW, HIGH]; one with names a list.
struct PointsOverRanges {
  int points = 64;

  static void fields(auto& s, auto&& visit) {
    visit(s.points, Field{"points", "of all swept paths together", {1, 1000000}});
  }
  bool operator==(const PointsOverRanges&) const = default;
};

/// McKay, Beckman and Conover, A comparison of three methods for selecting values of input
/// variables in the analysis of output from a computer code (1979).
struct LatinHypercube : PointsOverRanges {
  static constexpr std::string_view kKind = "latin_hypercube";
  static constexpr std::string_view kMeaning =
      "of as many equal parts of each range as points, each holds one; drawn by the study's seed";
};

/// With the direction numbers of Joe and Kuo, Constructing Sobol sequences with better
/// two-dimensional projections (2008), from the origin on.
struct Sobol : PointsOverRanges {
  static constexpr std::string_view kKind = "sobol";
  static constexpr std::string_view kMeaning =
      "Sobol's sequence, the same for every seed: a power of two fills the ranges most evenly, and "
      "more points keep the earlier ones";
};

using Sampling = std::variant<FullGrid, LatinHypercube, Sobol>;

/// How many points over ranges; 0 for the full grid.
[[nodiscard]] int points_of(const Sampling& sampling);

/// Points in [0, 1)^dimensions, one after the other; none for the full grid. Sobol's
/// are of 1 to 1000 dimensions, else throws Error.
[[nodiscard]] std::vector<std::vector<double>> unit_points(const Sampling& sampling,
                                                           std::size_t dimensions,
                                                           std::uint64_t seed);

}  // namespace mapscore::eval
