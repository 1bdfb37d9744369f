// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/summary.hpp"
#include "eval/results/store.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// What tables tell of the accounting of trials: its counts, those of tracking and of estimated
/// calibrations, and frames_mapped, the frames that were not left out.
[[nodiscard]] std::vector<std::string> accounting_names();

/// One of these names of a trial; nothing of tracking where no pose comes from depth images, of a
/// calibration where none is estimated, and of another name.
[[nodiscard]] std::optional<double> accounting_figure(const Accounting& accounting,
                                                      std::string_view name);

/// The same of a line: the mean over its seeds, and their spread.
[[nodiscard]] Estimate accounting_estimate(const ResultLine& line, std::string_view name);

/// For captions: how many poses of the trials are guessed, and how many calibrations were refused;
/// empty where none is.
[[nodiscard]] std::vector<std::string> accounting_notes(const StudySummary& summary);

}  // namespace mapscore::eval
