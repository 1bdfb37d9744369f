// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/recording/recording.hpp"
#include "eval/score/confusion.hpp"
#include "eval/score/metrics.hpp"

#include <opencv2/core.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mapscore::eval {

/// The class that an id of a labelled image stands for, if any. Asked once for each id that occurs
/// in an image; may be called from several threads.
using LabelLegend = std::function<std::optional<ClassId>(std::uint16_t)>;

/// Ids that are the table's class ids.
[[nodiscard]] LabelLegend class_id_legend(const ClassTable& table);

/// Counts the pixels of one labelled image: row true class, column labelled class. `instances`: the
/// truth, an instance id per pixel, as a recording's label image; `labels`: ids that `legend` turns
/// into classes. `name` opens the message of the Error that is thrown when the sizes differ or an
/// id means no class of the table; it names the id and its first pixel in row-major order.
[[nodiscard]] ConfusionMatrix label_confusion(const cv::Mat1w& instances, const cv::Mat1w& labels,
                                              const ClassTable& table, const LabelLegend& legend,
                                              const std::string& name);

/// The labelled images of `folder`, named as the recording's label images (`000000.png`), against
/// the recording's; of the frames `frames` only, pooled. Ids in 1- to 16-bit grey or palette PNGs
/// (png.hpp). Works on `jobs` threads, on which the result does not depend. Throws Error naming the
/// file that is missing, damaged, of another size, in colour, or that holds an id without a class.
[[nodiscard]] ConfusionMatrix label_folder_confusion(const Recording& recording,
                                                     const std::filesystem::path& folder,
                                                     std::span<const int> frames,
                                                     const LabelLegend& legend, int jobs);

/// pa = trace / all; mpa and miou: the means of accuracy and IoU over the classes with pixels in
/// the truth, background included.
[[nodiscard]] std::vector<Metric> label_metrics(const ConfusionMatrix& matrix);

/// accuracy = M_cc / row_c and iou = M_cc / (row_c + column_c - M_cc) of one class.
[[nodiscard]] std::vector<Metric> label_class_metrics(const ConfusionMatrix& matrix,
                                                      ClassId class_id);

}  // namespace mapscore::eval
