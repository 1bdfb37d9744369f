// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/figures/layout.hpp"
#include "eval/report/figures/script.hpp"
#include "eval/report/summary.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace mapscore::eval {

/// Draws the figures of a study with gnuplot, each as NAME.png, .pdf and .svg with its script
/// NAME.gp and its numbers NAME.dat beside it; `gnuplot NAME.gp` in the folder draws it anew. The
/// folder is made when it is not there. The first swept axis runs along x, the second over columns
/// of panels, further ones over lines. Points over ranges have one figure, scatter_figure.
///
/// Which figures there are stands below, and in docs/figures.md.
///
/// Returns the pictures that were drawn. Throws Error when gnuplot is missing or fails, or the
/// folder cannot be written.
[[nodiscard]] std::vector<std::filesystem::path> draw_figures(const StudySummary& summary,
                                                              const std::filesystem::path& folder,
                                                              const FigureStyle& style = {});

/// Writes table.txt (pooled and macro scores) into the folder. Returns its path. Throws Error.
[[nodiscard]] std::filesystem::path write_table(const StudySummary& summary,
                                                const std::filesystem::path& folder);

/// Precision, recall and F1 at tolerance 0, and by distance, pooled over the detected classes.
[[nodiscard]] FigureSheet accuracy_figure(const StudySummary& summary, const StudyLayout& layout);

/// poses: ATE, RPE and NEES of the poses that were mapped from, with their spread over the seeds,
/// an axis each, honest values dashed; nothing where poses were not scored. All methods of a cell
/// and seed map from the same poses, so there is no curve a method.
[[nodiscard]] std::optional<FigureSheet> pose_figure(const StudySummary& summary,
                                                     const FigureStyle& style = {});

/// f1_by_two_doses: F1 over the first two swept axes, pooled over the detected classes, in tones
/// with lines of equal F1; a panel a curve. Nothing where one of them has names or a single number.
/// Blocks of the data file for each panel: `x y f1` as measured, `x y f1` on a raster, linear in
/// between, the lines in pieces (`x y dx dy f1`), and their labels.
[[nodiscard]] std::optional<FigureSheet> heat_map_figure(const StudySummary& summary,
                                                         const StudyLayout& layout);

/// Stacked bars: false voxels by cause over the predicted ones, missed voxels by cause over the
/// visible ones, pooled over the detected classes and seeds. A column a curve, two rows a value of
/// the second axis.
[[nodiscard]] FigureSheet causes_figure(const StudySummary& summary, const StudyLayout& layout);

/// by_class_by_NAME: grouped bars of precision, recall and F1 at tolerance 0 by class, a bar each
/// value of the first swept axis that has names instead of numbers, NAME the last part of its path;
/// the other axes at their middle. A column a score, a row a method. Nothing where no such axis is
/// swept, or fewer than two classes occur. A block of the data file is one value in one panel:
/// `place class value low high registration_ceiling lattice_ceiling`, `-` where undefined.
[[nodiscard]] std::optional<FigureSheet> class_bars_figure(const StudySummary& summary,
                                                           const FigureStyle& style = {});

/// F1 of each detected class, a panel each. Nothing for a single class, nor where the first axis
/// has names, for which class_bars_figure is drawn.
[[nodiscard]] std::optional<FigureSheet> class_figure(const StudySummary& summary,
                                                      const StudyLayout& layout);

/// Precision against recall while the threshold falls, a line a curve, with a mark at the threshold
/// that the study works with; pooled over the detected classes and seeds. A panel a value of the
/// first axis (of more than three numbers the least, middle and greatest), at the middle of the
/// second. A block of the data file is one line, `recall precision threshold`, or the mark on it.
[[nodiscard]] FigureSheet precision_recall_figure(const StudySummary& summary,
                                                  const StudyLayout& layout);

/// Reliability diagram: the share of true voxels against their mean probability, by bins of a
/// tenth, with the diagonal; below it the share of voxels in each bin. Panels as above. A block of
/// the data file is one line: `low high voxels share_of_voxels mean_probability share_true`.
[[nodiscard]] FigureSheet reliability_figure(const StudySummary& summary,
                                             const StudyLayout& layout);

/// pixel_reliability: the same of a network's pixels, background too, a line for what is swept from
/// the third axis on; nothing where no network says how sure it is.
[[nodiscard]] std::optional<FigureSheet> pixel_reliability_figure(const StudySummary& summary,
                                                                  const StudyLayout& layout);

}  // namespace mapscore::eval
