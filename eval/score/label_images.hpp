// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/recording/recording.hpp"
#include "eval/score/confusion.hpp"
#include "eval/score/label_edges.hpp"
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

/// What labelled images say against the truth: integers that add over images.
struct LabelComparison {
  ConfusionMatrix pixels;         ///< row true class, column labelled class
  std::vector<EdgeCounts> edges;  ///< by class

  /// Pools. Throws Error when the class tables differ in size.
  LabelComparison& operator+=(const LabelComparison& other);
};

/// Compares one labelled image with the truth. `instances`: the truth, an instance id per pixel, as
/// a recording's label image; `labels`: ids that `legend` turns into classes. `name` opens the
/// message of the Error that is thrown when the sizes differ or an id means no class of the table;
/// it names the id and its first pixel in row-major order.
[[nodiscard]] LabelComparison compare_labels(const cv::Mat1w& instances, const cv::Mat1w& labels,
                                             const ClassTable& table, const LabelLegend& legend,
                                             const std::string& name);

/// A folder of labelled images, and how they are compared with a recording's label images.
struct LabelFolder {
  const Recording& recording;
  /// Holds an image for each of the recording's colour images, under the same name: ids in 1- to
  /// 16-bit grey or palette PNGs (png.hpp).
  std::filesystem::path folder;
  ClassTable table;    ///< of the truth
  LabelLegend legend;  ///< of the labels
};

/// Reads classes that the table does not detect as background, in the truth and in the labels.
[[nodiscard]] LabelFolder with_undetected_as_background(LabelFolder labels);

/// What a folder's images say, pooled over the frames.
struct LabelFolderScore : LabelComparison {
  std::vector<std::int64_t> wrong_px;  ///< of each frame, in the order asked for
};

/// Compares the images of the frames `frames` with the truth. Works on `jobs` threads, on which the
/// result does not depend. Throws Error naming the file that is missing, damaged, of another size,
/// in colour, or that holds an id without a class.
[[nodiscard]] LabelFolderScore score_label_folder(const LabelFolder& labels,
                                                  std::span<const int> frames, int jobs);

/// A frame's labelled image. Throws Error naming the file, as score_label_folder does, but leaves
/// ids unread.
[[nodiscard]] cv::Mat1w read_label_image(const LabelFolder& labels, int frame);

/// pa = trace / all; mpa, miou and boundary_f: the means of accuracy, IoU and boundary F over the
/// classes with pixels in the truth, background included; fwiou: the IoUs weighted by their pixels.
[[nodiscard]] std::vector<Metric> label_metrics(const LabelComparison& score);

/// accuracy = M_cc / row_c, iou = M_cc / (row_c + column_c - M_cc) and boundary_f of one class.
[[nodiscard]] std::vector<Metric> label_class_metrics(const LabelComparison& score,
                                                      ClassId class_id);

}  // namespace mapscore::eval
