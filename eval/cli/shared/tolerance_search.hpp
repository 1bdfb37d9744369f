// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/cli/shared/options.hpp"
#include "eval/recording/recording.hpp"
#include "eval/report/tolerance_report.hpp"
#include "eval/results/store.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Doses of a second fault that has but a range.
inline constexpr int kFrontierDoses = 6;

/// Names of what is searched; none: all of the study's, and of groups "pooled" alone.
struct ToleranceChoice {
  std::vector<std::string> faults;  ///< swept paths
  std::vector<std::string> methods;
  std::vector<std::string> groups;  ///< "all": each of pooled, macro and the detected classes
  std::string against;              ///< swept path of a second fault, or nothing
};

/// The searches of a study, without trials: a fault's range is from its least to its greatest swept
/// value, and each fault is dosed by itself, or beside each dose of the second: its swept values,
/// or, where these are two, kFrontierDoses over the range between them. Throws Error on a name that
/// is not there, on a swept path without two numbers, and when nothing is swept.
[[nodiscard]] std::vector<ToleranceRow> tolerance_searches(const Study& study,
                                                           const ClassTable& table,
                                                           const ToleranceAim& aim,
                                                           const ToleranceChoice& choice);

/// Trials of a search by where they came from.
struct SearchCost {
  std::size_t computed = 0, reused = 0;
  bool stopped = false;  ///< by `stop`; the rows are then without an answer
};

/// Runs all searches side by side, stage by stage. Trial n of each has seed n, so that methods are
/// searched with the same draws; every trial is an ordinary one of the study and goes into the
/// store, and the store's are not made again. Ends early when stop() turns true. Doses are rounded
/// to a thousandth of the decade of the range, but its ends are tried as they are. The same study
/// gives the same rows, whatever the store holds. Throws Error as run_plan, and when there is no
/// such metric.
SearchCost search_tolerances(const Study& study, const Recording& recording,
                             const ClassTable& table, const ToleranceAim& aim,
                             const WorkFlags& work, ResultStore& store,
                             const std::function<bool()>& stop, std::vector<ToleranceRow>& rows);

}  // namespace mapscore::eval
