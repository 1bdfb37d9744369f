// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/cli/shared/options.hpp"
#include "eval/cli/sweep/tolerance_rows.hpp"
#include "eval/recording/recording.hpp"
#include "eval/results/store.hpp"

#include <cstddef>
#include <functional>
#include <vector>

namespace mapscore::eval {

/// Trials of a search by where they came from.
struct SearchCost {
  std::size_t computed = 0, reused = 0;
  bool stopped = false;      ///< by `stop`; the rows are then without an answer
  bool any_visible = false;  ///< truth voxel of a detected class, in any trial
};

/// Runs all searches side by side, stage by stage, then the frontier_searches that follow, which
/// are added to `rows`. Trial n of each has seed n, so that methods are searched with the same
/// draws; every trial is an ordinary one of the study and goes into the store, and the store's are
/// not made again. Ends early when stop() turns true. Doses are rounded to a thousandth of the
/// decade of the range, but its ends are tried as they are. The same study gives the same rows,
/// whatever the store holds. Throws Error as run_plan, and when there is no such metric.
SearchCost search_tolerances(const Study& study, const Recording& recording,
                             const ClassTable& table, const ToleranceAim& aim,
                             const ToleranceChoice& choice, const WorkFlags& work,
                             ResultStore& store, const std::function<bool()>& stop,
                             std::vector<ToleranceRow>& rows);

}  // namespace mapscore::eval
