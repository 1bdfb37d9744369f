// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/label_images.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "eval/recording/stamp_list.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"

#include <fmt/format.h>

#include <exception>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_id(const std::string& name, std::uint16_t id, int u, int v) {
  throw Error(
      fmt::format("{}: id {} at column {}, row {} means no class; give a legend that names it",
                  name, id, u, v));
}

cv::Mat1w read_labels(const fs::path& file, const CameraModel& camera) {
  if (!fs::is_regular_file(file)) {
    throw Error(
        fmt::format("{}: image is missing; give one labelled image for each of the recording's "
                    "label/, or select the frames that have one",
                    file.string()));
  }
  return decode_id_png(read_file(file), {camera.width_px, camera.height_px}, file.string());
}

/// Where a frame's labelled image lies: it is named as the frame's colour image.
fs::path file_of(const LabelFolder& labels, const StampedImage& color) {
  return labels.folder / fs::path(color.path).filename();
}

std::vector<StampedImage> color_images(const Recording& recording) {
  return read_stamp_list(recording.folder() / "color.txt");
}

LabelComparison frame_comparison(const LabelFolder& labels, int frame,
                                 const std::vector<StampedImage>& color) {
  constexpr Channels kLabel{.color = false, .label = true, .depth = false, .depth_label = false};
  const cv::Mat1w truth = labels.recording.read(frame, kLabel).label;  // throws without a frame
  const fs::path file = file_of(labels, color[static_cast<std::size_t>(frame)]);
  const cv::Mat1w image = read_labels(file, labels.recording.info().calibration.color);
  return compare_labels(truth, image, labels.table, labels.legend, file.string());
}

}  // namespace

LabelLegend class_id_legend(const ClassTable& table) {
  const std::size_t class_count = table.classes.size();
  return [class_count](std::uint16_t id) -> std::optional<ClassId> {
    return id < class_count ? std::optional<ClassId>(id) : std::nullopt;
  };
}

LabelComparison& LabelComparison::operator+=(const LabelComparison& other) {
  pixels += other.pixels;
  edges.resize(std::max(edges.size(), other.edges.size()));
  for (std::size_t c = 0; c < other.edges.size(); ++c) edges[c] += other.edges[c];
  return *this;
}

LabelComparison compare_labels(const cv::Mat1w& instances, const cv::Mat1w& labels,
                               const ClassTable& table, const LabelLegend& legend,
                               const std::string& name) {
  if (instances.size() != labels.size()) {
    throw Error(
        fmt::format("{}: image is {} x {}, the truth {} x {}; label images of the size of "
                    "the recording's",
                    name, labels.cols, labels.rows, instances.cols, instances.rows));
  }
  ConfusionMatrix matrix(table.classes.size());
  cv::Mat1w true_classes(labels.size()), labelled_classes(labels.size());
  std::unordered_map<std::uint16_t, std::optional<ClassId>> answers;  // of the legend
  const auto class_of = [&](std::uint16_t id) {
    const auto [answer, is_new] = answers.try_emplace(id);
    if (is_new) answer->second = legend(id);
    return answer->second;
  };
  for (int v = 0; v < labels.rows; ++v) {
    const std::uint16_t *truth = instances[v], *label = labels[v];
    for (int u = 0; u < labels.cols;) {
      const int first = u++;
      while (u < labels.cols && truth[u] == truth[first] && label[u] == label[first]) ++u;
      const std::optional<ClassId> labelled = class_of(label[first]);
      if (!labelled || *labelled >= matrix.class_count()) refuse_id(name, label[first], first, v);
      const ClassId true_class = table.class_of(truth[first]);
      matrix.count(true_class, *labelled, u - first);
      std::fill_n(true_classes[v] + first, u - first, true_class);
      std::fill_n(labelled_classes[v] + first, u - first, *labelled);
    }
  }
  return {matrix, count_edges(true_classes, labelled_classes, matrix.class_count(),
                              edge_tolerance_px(labels.size()))};
}

LabelFolder with_undetected_as_background(LabelFolder labels) {
  std::vector<bool> detected;
  for (const SemanticClass& c : labels.table.classes) detected.push_back(c.detect);
  for (Instance& instance : labels.table.instances)
    if (!detected[instance.class_id]) instance.class_id = kBackground;
  labels.legend = [detected, legend = std::move(labels.legend)](std::uint16_t id) {
    const std::optional<ClassId> labelled = legend(id);
    const bool is_idle = labelled && *labelled < detected.size() && !detected[*labelled];
    return is_idle ? std::optional(kBackground) : labelled;
  };
  return labels;
}

LabelFolderScore score_label_folder(const LabelFolder& labels, std::span<const int> frames,
                                    int jobs) {
  if (!fs::is_directory(labels.folder)) {
    throw Error(fmt::format("{}: no such folder; give the folder of the labelled images",
                            labels.folder.string()));
  }
  const std::vector<StampedImage> color = color_images(labels.recording);
  LabelFolderScore score;
  score.pixels = ConfusionMatrix(labels.table.classes.size());
  score.edges.resize(labels.table.classes.size());
  score.wrong_px.resize(frames.size());
  std::mutex pooling;
  std::vector<std::exception_ptr> errors(frames.size());
  Runs places(frames.size(), 1);
  run_jobs(jobs, [&](int) {
    for (Runs::Run place; places.next(place);) {
      try {
        const LabelComparison one = frame_comparison(labels, frames[place.first], color);
        score.wrong_px[place.first] = one.pixels.total() - one.pixels.trace();
        const std::scoped_lock lock(pooling);
        score += one;
      } catch (...) {  // frames before this one are all in work, so the first error is found
        errors[place.first] = std::current_exception();
        return;
      }
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return score;
}

cv::Mat1w read_label_image(const LabelFolder& labels, int frame) {
  const StampedImage color = color_images(labels.recording).at(static_cast<std::size_t>(frame));
  return read_labels(file_of(labels, color), labels.recording.info().calibration.color);
}

std::vector<Metric> label_metrics(const LabelComparison& score) {
  const ConfusionMatrix& matrix = score.pixels;
  std::vector<std::vector<Metric>> present;
  std::vector<ClassOverlap> overlaps;
  for (std::size_t c = 0; c < matrix.class_count(); ++c) {
    overlaps.push_back({matrix.at(c, c), matrix.row_sum(c), matrix.column_sum(c)});
    if (matrix.row_sum(c) > 0)
      present.push_back(label_class_metrics(score, static_cast<ClassId>(c)));
  }
  const auto mean = present.empty() ? std::vector<Metric>(3) : mean_over_classes(present);
  return {{"pa", ratio(matrix.trace(), matrix.total())},
          {"mpa", mean[0].value},
          {"miou", mean[1].value},
          {"fwiou", frequency_weighted_iou(overlaps)},
          {"boundary_f", mean[2].value}};
}

std::vector<Metric> label_class_metrics(const LabelComparison& score, ClassId class_id) {
  const ConfusionMatrix& matrix = score.pixels;
  const std::int64_t both = matrix.at(class_id, class_id), row = matrix.row_sum(class_id);
  return {{"accuracy", ratio(both, row)},
          {"iou", ratio(both, row + matrix.column_sum(class_id) - both)},
          {"boundary_f", boundary_f(score.edges.at(class_id))}};
}

}  // namespace mapscore::eval
