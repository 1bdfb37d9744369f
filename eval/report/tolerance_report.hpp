// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/axes.hpp"
#include "eval/report/tables/table.hpp"
#include "eval/statistics/tolerance.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// What is asked of every method: to keep a score, or to lose little of it.
struct ToleranceAim {
  std::string metric = "f1";
  std::optional<double> target;  ///< score to keep
  double loss = 0.05;            ///< without a target: most that the least dose's score may lose
  int trials = ToleranceSearch{}.trials;

  /// "f1 >= 0.8", "f1 loses at most 0.05 against the least dose".
  [[nodiscard]] std::string text() const;
};

/// A dose of a second fault under which the first is searched.
struct SecondFault {
  std::string path, value;  ///< leaf and canonical value
  FigureAxis axis;          ///< `at` and `values` hold that one value in the unit of figures
  std::string least = {};   ///< canonical value of its least dose, from which losses are counted
};

/// The answer for one fault, method and class group.
struct ToleranceRow {
  std::string path;  ///< of the fault's leaf
  FigureAxis axis;   ///< its name and unit; `at` holds one value, what 1 of the leaf is in `unit`
  std::optional<SecondFault> second;
  std::string method, group;
  ToleranceSearch search;         ///< in the unit of the leaf
  std::vector<DoseTrial> trials;  ///< scores, or without a target their change from the least dose
  Tolerance tolerance;
  double most_to_lose = 0.0;  ///< without a target: greatest score of the least dose
};

/// "7.1 mm [6.4, 7.9]", "> 40 mm", "< 0 mm", "- [18.2, open]": dose and interval in the unit of
/// figures; open is a side that the trials do not bound.
[[nodiscard]] std::string text_of(const ToleranceRow& row);

/// "+7.1 mm [6.4, 7.9]", "> 18 mm", "- [open, 3]": how much larger the first tolerance is, paired
/// by seed.
[[nodiscard]] std::string difference_text(const ToleranceRow& row, const ToleranceRow& from);

/// A row an answer, with its difference from that of the method `reference` for the same fault and
/// group: at the terminal with text_of and difference_text, for a program with path, doses and ends
/// of the intervals in the unit of figures by themselves.
[[nodiscard]] Table tolerance_table(const Study& study, const ToleranceAim& aim,
                                    const std::string& reference,
                                    const std::vector<ToleranceRow>& rows, Reader reader);

/// The same for a paper: a row a fault and group, a column a method, text_of in the cells.
[[nodiscard]] Table tolerance_matrix(const Study& study, const ToleranceAim& aim,
                                     const std::vector<ToleranceRow>& rows);

}  // namespace mapscore::eval
