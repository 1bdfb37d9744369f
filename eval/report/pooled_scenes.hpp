// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/summary.hpp"

#include <string>
#include <vector>

namespace mapscore::eval {

/// Adds to a study of several scenes, as the last value of their axis (kAllScenes), the lines of
/// all scenes together: of each seed that all of them have the sum of their counts, so that a
/// figure is formed from the pooled counts and a seed is one value. Where a scene has no line yet,
/// or the scenes no seed in common, there is none. Other summaries stay as they are. `groups`:
/// whose figures are formed at once.
void add_pooled_scenes(StudySummary& summary, const std::vector<std::string>& groups);

}  // namespace mapscore::eval
