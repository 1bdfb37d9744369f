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

/// One frame's labelled image, named in `color` as the frame's colour image, against its truth.
ConfusionMatrix frame_confusion(const Recording& recording, int frame, const fs::path& folder,
                                const std::vector<StampedImage>& color, const LabelLegend& legend) {
  constexpr Channels kLabel{.color = false, .label = true, .depth = false, .depth_label = false};
  const RecordingInfo& info = recording.info();
  const cv::Mat1w truth = recording.read(frame, kLabel).label;  // throws when there is no frame
  const fs::path file = folder / fs::path(color[static_cast<std::size_t>(frame)].path).filename();
  const cv::Mat1w labels = read_labels(file, info.calibration.color);
  return label_confusion(truth, labels, info.table, legend, file.string());
}

}  // namespace

LabelLegend class_id_legend(const ClassTable& table) {
  const std::size_t class_count = table.classes.size();
  return [class_count](std::uint16_t id) -> std::optional<ClassId> {
    return id < class_count ? std::optional<ClassId>(id) : std::nullopt;
  };
}

ConfusionMatrix label_confusion(const cv::Mat1w& instances, const cv::Mat1w& labels,
                                const ClassTable& table, const LabelLegend& legend,
                                const std::string& name) {
  if (instances.size() != labels.size()) {
    throw Error(
        fmt::format("{}: image is {} x {}, the truth {} x {}; label images of the size of "
                    "the recording's",
                    name, labels.cols, labels.rows, instances.cols, instances.rows));
  }
  ConfusionMatrix matrix(table.classes.size());
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
      matrix.count(table.class_of(truth[first]), *labelled, u - first);
    }
  }
  return matrix;
}

ConfusionMatrix label_folder_confusion(const Recording& recording, const fs::path& folder,
                                       std::span<const int> frames, const LabelLegend& legend,
                                       int jobs) {
  if (!fs::is_directory(folder)) {
    throw Error(
        fmt::format("{}: no such folder; give the folder of the labelled images", folder.string()));
  }
  const std::vector<StampedImage> color = read_stamp_list(recording.folder() / "color.txt");
  ConfusionMatrix total(recording.info().table.classes.size());
  std::mutex pooling;
  std::vector<std::exception_ptr> errors(frames.size());
  Runs places(frames.size(), 1);
  run_jobs(jobs, [&](int) {
    for (Runs::Run place; places.next(place);) {
      try {
        const ConfusionMatrix one =
            frame_confusion(recording, frames[place.first], folder, color, legend);
        const std::scoped_lock lock(pooling);
        total += one;
      } catch (...) {  // frames before this one are all in work, so the first error is found
        errors[place.first] = std::current_exception();
        return;
      }
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return total;
}

std::vector<Metric> label_metrics(const ConfusionMatrix& matrix) {
  std::vector<std::vector<Metric>> present;
  for (std::size_t c = 0; c < matrix.class_count(); ++c) {
    if (matrix.row_sum(c) > 0)
      present.push_back(label_class_metrics(matrix, static_cast<ClassId>(c)));
  }
  const auto mean = present.empty() ? std::vector<Metric>(2) : mean_over_classes(present);
  return {{"pa", ratio(matrix.trace(), matrix.total())},
          {"mpa", mean[0].value},
          {"miou", mean[1].value}};
}

std::vector<Metric> label_class_metrics(const ConfusionMatrix& matrix, ClassId class_id) {
  const std::int64_t both = matrix.at(class_id, class_id), row = matrix.row_sum(class_id);
  return {{"accuracy", ratio(both, row)},
          {"iou", ratio(both, row + matrix.column_sum(class_id) - both)}};
}

}  // namespace mapscore::eval
