// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/lab/bench.hpp"
#include "eval/report/pictures/pictures.hpp"

#include <vector>

namespace mapscore::eval {

/// Throws Error when a study has no such trial.
void check_choice(const Study& study, const PictureChoice& choice);

/// Runs the chosen trials of a study and judges the maps that they end with (of the fullest frame
/// where each is scored by itself). Throws Error when there is no such trial.
[[nodiscard]] std::vector<JudgedMap> map_trials(const Study& study, Bench& bench,
                                                const PictureChoice& choice);

}  // namespace mapscore::eval
