// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/tolerance_report.hpp"

#include <string>
#include <vector>

namespace mapscore::eval {

/// Names of what is searched; none: all of the study's, and of groups "pooled" alone.
struct ToleranceChoice {
  std::vector<std::string> faults;  ///< swept paths
  std::vector<std::string> methods;
  std::vector<std::string> groups;  ///< "all": each of pooled, macro and the detected classes
  std::string against;              ///< swept path of a second fault, or nothing
};

/// The choice with swept paths in the place of their unique ends; names that stand for none stay.
[[nodiscard]] ToleranceChoice with_whole_paths(const Study& study, ToleranceChoice choice);

/// The searches of a study, without trials: a fault's range is from its least to its greatest swept
/// value, and each fault is dosed by itself, or beside each swept value of the second. Of a second
/// one with two values, a range, the searches are those of the second itself, at the least dose of
/// each fault; frontier_searches gives the others. Throws Error on a name that is not there, on a
/// swept path without two numbers, and when nothing is swept.
[[nodiscard]] std::vector<ToleranceRow> tolerance_searches(const Study& study,
                                                           const ClassTable& table,
                                                           const ToleranceAim& aim,
                                                           const ToleranceChoice& choice);

/// What is searched after `done`: each fault at the frontier_doses of a second one that has but a
/// range; nothing otherwise.
[[nodiscard]] std::vector<ToleranceRow> frontier_searches(const Study& study,
                                                          const ToleranceAim& aim,
                                                          const ToleranceChoice& choice,
                                                          const std::vector<ToleranceRow>& done);

/// A dose in a thousandth of the decade of the range, or an end of it as it is, as the study's
/// canonical text has it. Throws Error where the leaf takes whole numbers alone.
[[nodiscard]] std::string dose_text(Study study, const std::string& path,
                                    const ToleranceSearch& search, double dose);

}  // namespace mapscore::eval
