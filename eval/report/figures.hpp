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
/// - accuracy_by_dose (accuracy_by_NAME where the first axis has names instead of numbers, NAME the
///   last part of its path; accuracy_by_method without a sweep): precision, recall and F1 at
///   tolerance 0 and, where scored, at a distance of 2 cm, pooled over the detected classes, with
///   both ceilings.
/// - causes_by_dose: why voxels are false, as shares of the predicted ones, and missed, as shares
///   of the visible ones.
/// - by_class_by_NAME: precision, recall and F1 of each detected class over the first axis with
///   names, see class_bars_figure.
/// - by_class_by_dose: F1 of each detected class, where the first axis has numbers; both only where
///   there are several classes.
/// - precision_recall: both over the threshold, with the working threshold marked.
/// - reliability: how true voxels are against how probable the map has them.
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
