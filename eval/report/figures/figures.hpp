// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/summary.hpp"

#include <filesystem>
#include <vector>

namespace mapscore::eval {

/// Draws the figures of a study with gnuplot, each as NAME.png and NAME.pdf with its script NAME.gp
/// and its numbers NAME.dat beside it; `gnuplot NAME.gp` in the folder draws it anew. The folder is
/// made when it is not there. The first swept axis runs along x, the second over columns of panels,
/// further ones over lines.
///
/// Which figures there are stands beside the function of each, and in docs/figures.md.
///
/// Returns the pictures that were drawn. Throws Error when gnuplot is missing or fails, or the
/// folder cannot be written.
[[nodiscard]] std::vector<std::filesystem::path> draw_figures(const StudySummary& summary,
                                                              const std::filesystem::path& folder);

/// Writes trials.csv (tidy, everything) and table.txt (pooled and macro scores) into the folder.
/// Returns both paths. Throws Error.
[[nodiscard]] std::vector<std::filesystem::path> write_tables(const StudySummary& summary,
                                                              const std::filesystem::path& folder);

}  // namespace mapscore::eval
