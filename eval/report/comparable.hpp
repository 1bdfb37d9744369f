// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/baseline.hpp"

#include <string>
#include <vector>

namespace mapscore::eval {

/// The settings that two studies differ in, as `voxel_m 0.05 -> 0.1`; empty where their results
/// compare. Name and seeds may differ, methods and cells that one alone has, and on the same
/// recording what it was made of.
[[nodiscard]] std::vector<std::string> differing_settings(const Study& before, const Study& after,
                                                          bool same_recording = true);

/// Throws Error naming the `results` that several builds made.
void check_one_build(const StudySummary& summary, const std::string& results);

/// Throws Error naming all that keeps results from being compared: settings, detected classes,
/// scoring version, and the recording unless `any_recording`. Of two recordings that were rendered
/// for the studies, what they were made of must agree.
void check_comparable(const Baseline& before, const Baseline& after, bool any_recording);

}  // namespace mapscore::eval
