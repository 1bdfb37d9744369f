// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/figures/script.hpp"
#include "eval/report/summary.hpp"

#include <optional>

namespace mapscore::eval {

/// by_class_by_NAME: grouped bars of precision, recall and F1 at tolerance 0 by class, a bar each
/// value of the first swept axis that has names instead of numbers, NAME the last part of its path;
/// the other axes at their middle. A column a score, a row a method. Nothing where no such axis is
/// swept, or fewer than two classes occur. A block of the data file is one value in one panel:
/// `place class value low high registration_ceiling lattice_ceiling`, `-` where undefined.
[[nodiscard]] std::optional<FigureSheet> class_bars_figure(const StudySummary& summary);

}  // namespace mapscore::eval
