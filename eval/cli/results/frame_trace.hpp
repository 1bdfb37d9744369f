// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/regression.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace mapscore::eval {

// All throw Error when the recording of the results is not there.

/// Yields of all trials of the first seed of a results folder. Throws Error as yields_of, too.
[[nodiscard]] std::vector<TrialYields> yields_of_store(const std::filesystem::path& results);

/// The frames that lost most since a baseline, of the method and cell of its worst figure, run
/// again by this program with the baseline's seed; none where the baseline does not tell.
[[nodiscard]] std::optional<FrameTrace> trace_frames(const std::filesystem::path& results,
                                                     const Baseline& before,
                                                     const JudgedFigure& worst);

/// Draws the first seed's trial of the worst figure as draw_pictures does, with the classes alone
/// that got worse, and frames.png: the frames that lost most, as contact_sheet shows them. Says on
/// standard error where the pictures are, or why there are none.
void draw_fallen(const std::filesystem::path& results, const JudgedFigure& worst,
                 const std::optional<FrameTrace>& trace, const std::filesystem::path& folder);

}  // namespace mapscore::eval
