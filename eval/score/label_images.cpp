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
#include <limits>
#include <mutex>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// Answers of a legend, each asked for once.
class LegendTable {
 public:
  LegendTable(const LabelLegend& legend, std::size_t class_count)
      : legend_(legend), class_count_(class_count), classes_(1 << 16, kUnasked) {}

  /// Nothing when the id means no class of the table.
  [[nodiscard]] std::optional<ClassId> find(std::uint16_t id) {
    if (classes_[id] == kUnasked) {
      const std::optional<ClassId> answer = legend_(id);
      classes_[id] = answer && *answer < class_count_ ? std::int32_t{*answer} : kNoClass;
    }
    if (classes_[id] == kNoClass) return std::nullopt;
    return static_cast<ClassId>(classes_[id]);
  }

 private:
  static constexpr std::int32_t kUnasked = -1, kNoClass = -2;

  const LabelLegend& legend_;
  std::size_t class_count_;
  std::vector<std::int32_t> classes_;
};

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

/// The labelled images of a recording's frames.
class LabelFolder {
 public:
  LabelFolder(const Recording& recording, const fs::path& folder, const LabelLegend& legend)
      : recording_(recording),
        folder_(folder),
        legend_(legend),
        color_(read_stamp_list(recording.folder() / "color.txt")) {}

  [[nodiscard]] ConfusionMatrix confusion(int frame) const {
    constexpr Channels kLabel{.color = false, .label = true, .depth = false, .depth_label = false};
    const RecordingInfo& info = recording_.info();
    const cv::Mat1w truth = recording_.read(frame, kLabel).label;  // throws when there is no frame
    const fs::path name = fs::path(color_[static_cast<std::size_t>(frame)].path).filename();
    const fs::path file = folder_ / name;
    const cv::Mat1w labels = read_labels(file, info.calibration.color);
    return label_confusion(truth, labels, info.table, legend_, file.string());
  }

 private:
  const Recording& recording_;
  const fs::path& folder_;
  const LabelLegend& legend_;
  std::vector<StampedImage> color_;
};

/// The error of the lowest place, whichever thread met one first.
class FirstError {
 public:
  void note(std::size_t place, std::exception_ptr error) {
    const std::scoped_lock lock(mutex_);
    if (place >= place_) return;
    place_ = place;
    error_ = std::move(error);
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::size_t place_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr error_;
};

/// Mean of a figure over the classes with pixels in the truth.
std::optional<double> mean_over_present(const ConfusionMatrix& matrix, std::size_t figure) {
  double sum = 0.0;
  int present = 0;
  for (std::size_t c = 0; c < matrix.class_count(); ++c) {
    if (matrix.row_sum(c) == 0) continue;
    sum += label_class_metrics(matrix, static_cast<ClassId>(c))[figure].value.value();
    ++present;
  }
  return present == 0 ? std::nullopt : std::optional(sum / present);
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
  LegendTable classes(legend, table.classes.size());
  for (int v = 0; v < labels.rows; ++v) {
    const std::uint16_t *truth = instances[v], *label = labels[v];
    for (int u = 0; u < labels.cols;) {
      const int first = u++;
      while (u < labels.cols && truth[u] == truth[first] && label[u] == label[first]) ++u;
      const std::optional<ClassId> labelled = classes.find(label[first]);
      if (!labelled) refuse_id(name, label[first], first, v);
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
  const LabelFolder labels(recording, folder, legend);
  ConfusionMatrix total(recording.info().table.classes.size());
  std::mutex pooling;
  FirstError error;
  Runs places(frames.size(), 1);
  run_jobs(jobs, [&](int) {
    for (Runs::Run place; places.next(place);) {
      try {
        const ConfusionMatrix one = labels.confusion(frames[place.first]);
        const std::scoped_lock lock(pooling);
        total += one;
      } catch (...) {  // frames before this one are all in work, so the first error is found
        error.note(place.first, std::current_exception());
        return;
      }
    }
  });
  error.rethrow();
  return total;
}

std::vector<Metric> label_metrics(const ConfusionMatrix& matrix) {
  constexpr std::size_t kAccuracy = 0, kIoU = 1;
  return {{"pa", ratio(matrix.trace(), matrix.total())},
          {"mpa", mean_over_present(matrix, kAccuracy)},
          {"miou", mean_over_present(matrix, kIoU)}};
}

std::vector<Metric> label_class_metrics(const ConfusionMatrix& matrix, ClassId class_id) {
  const std::int64_t both = matrix.at(class_id, class_id), row = matrix.row_sum(class_id);
  return {{"accuracy", ratio(both, row)},
          {"iou", ratio(both, row + matrix.column_sum(class_id) - both)}};
}

}  // namespace mapscore::eval
