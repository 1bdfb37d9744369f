// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/recording/recording.hpp"
#include "eval/study/study.hpp"
#include "eval/truth/truth_cost.hpp"

#include <CLI/CLI.hpp>

#include <cstddef>

namespace mapscore::eval {

/// `--yes`: a truth is made however much memory it takes.
void add_yes_flag(CLI::App& verb, bool& yes);

/// Throws Error, stating the cost, when a truth would take too much memory (refuse_too_large);
/// never with `yes`.
void check_truth_size(const TruthCost& cost, double edge_m, bool yes);

/// The same of the finest truth of a study. `trials`: how many it scores, which say how many
/// lattices are held at once.
void check_truth_size(const Study& study, const Recording& recording, std::size_t trials, bool yes);

}  // namespace mapscore::eval
