// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/statistics/tolerance.hpp"

#include <span>
#include <vector>

namespace mapscore::eval {

/// Doses of a second fault that has but a range.
inline constexpr int kFrontierDoses = 6;

/// Doses of a second fault, from `low` on and ascending, at which the tolerance of a first one is
/// searched. `alone`: of each method, the tolerance of the second fault without the first, searched
/// from `low` to `high`. Beyond it the first has none, so each method wants its doses evenly
/// between `low` and there: the doses are at equal shares of what all methods want together. The
/// last is below the greatest of these tolerances, or at `high` where that is not below it.
[[nodiscard]] std::vector<double> frontier_doses(double low, double high,
                                                 std::span<const Tolerance> alone);

}  // namespace mapscore::eval
