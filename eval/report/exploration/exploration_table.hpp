// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/explore/exploration_summary.hpp"
#include "eval/report/tables/table.hpp"

#include <vector>

namespace mapscore::eval {

/// Scores of explorations, a row a group. For programs each figure has columns of its own for its
/// mean, low and high, and each reason to end one with how many ended so.
[[nodiscard]] Table exploration_table(const Study& study,
                                      const std::vector<ExplorationGroup>& groups, Reader reader);

}  // namespace mapscore::eval
