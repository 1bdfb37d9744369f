// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/study/lazy_list.hpp"
#include "eval/study/study.hpp"

#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// One point of a sweep's grid.
struct Cell {
  int index = 0;
  /// Path and canonical value, in file order.
  std::vector<std::pair<std::string, std::string>> doses;

  bool operator==(const Cell&) const = default;
};

/// One trial of a study: a method at a cell with a seed. It determines one row of the results.
struct TrialSpec {
  int index = 0;
  std::string method;
  Cell cell;
  int seed_index = 0;

  bool operator==(const TrialSpec&) const = default;
};

/// The product of the swept values, paths in the order of the file, the last path fastest. A study
/// without a sweep has one cell without doses.
[[nodiscard]] std::vector<Cell> cells(const Study& study);

/// Every method at every cell with every seed. Cells vary slowest, methods fastest, so that
/// neighbouring trials have the same faults and share the corrupted frames (Sights).
[[nodiscard]] LazyList<TrialSpec> trials(const Study& study);

/// The study at one cell: its doses set, its sweep empty. Throws Error naming the path when a dose
/// does not fit; never for a cell of a loaded study.
[[nodiscard]] Study resolve(const Study& study, const Cell& cell);

/// "path = value, path = value", for people; empty without doses.
[[nodiscard]] std::string text_of(const Cell& cell);

}  // namespace mapscore::eval
