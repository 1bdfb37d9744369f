// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/networks/inferred_images.hpp"

#include "core/parallel.hpp"
#include "core/segmentation/registered_cloud.hpp"
#include "eval/networks/segmentation_network.hpp"
#include "files/file_bytes.hpp"
#include "files/folder_lock.hpp"
#include "files/png.hpp"
#include "files/refusal.hpp"
#include "files/text.hpp"
#include "files/whole_folder.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <mutex>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// Raised when the files that are kept, or what they hold, change.
constexpr int kInferredVersion = 1;

constexpr const char *kClassFile = "classes.yaml", *kScoreFile = "scores.csv",
                     *kConfidenceFolder = "confidence", *kDescription = "network.txt";

/// OpenCV works on one core while it exists: the frames are shared out instead.
class OneCore {
 public:
  OneCore() { cv::setNumThreads(1); }
  ~OneCore() { cv::setNumThreads(before_); }
  OneCore(const OneCore&) = delete;
  OneCore& operator=(const OneCore&) = delete;

 private:
  int before_ = cv::getNumThreads();
};

cv::Size image_size(const Recording& recording) {
  const CameraModel& camera = recording.info().calibration.color;
  return {camera.width_px, camera.height_px};
}

/// The classes of a network with `channels` of them, of which each has one of its own.
LabelClasses classes_of(const NetworkModel& network, int channels) {
  LabelClasses classes = read_label_classes(network.classes, ClassMasks::components);
  const std::string output = fmt::format("the output of {} has {} channels, 0 to {}",
                                         network.model.filename().string(), channels, channels - 1);
  if (classes.has_instances)
    refuse(network.classes, "lists instances, and {}, each a class; leave `instances` out", output);
  const std::vector<ClassId>& named = classes.class_of_pixel;
  if (named.size() > static_cast<std::size_t>(channels))
    refuse(network.classes, "names label {}, and {}; give one class for each", named.size() - 1,
           output);
  std::vector<int> missing;
  for (int channel = 1; channel < channels; ++channel)
    if (const auto at = static_cast<std::size_t>(channel);
        at >= named.size() || named[at] == kBackground)
      missing.push_back(channel);
  if (!missing.empty())
    refuse(network.classes,
           "names no class of label {}, and {}; name them all, what is to be background as {{name: "
           "other, label: [...], detect: false}}",
           fmt::join(missing, ", "), output);
  return classes;
}

bool has_depth(const Recording& recording) {
  for (int depth = 0; depth < recording.depth_count(); ++depth) {
    Frame frame;
    recording.read_depth(depth, {.color = false, .label = false, .depth = true}, frame);
    if (cv::countNonZero(frame.depth) > 0) return true;
  }
  return false;
}

void check_depth(const NetworkModel& network, const Recording& recording) {
  if (!has_depth(recording))
    refuse(network.model,
           "takes depth as its fourth channel, and no depth image of {} has any; give a network of "
           "3 channels",
           recording.folder().string());
}

/// Metres along the colour camera's axis at its pixels, 0 where there is none.
cv::Mat1f depth_in_color(const cv::Mat1w& depth, const Calibration& calibration) {
  const RegisteredCloud cloud = register_depth(depth, calibration);
  cv::Mat1f depth_m = cv::Mat1f::zeros(cloud.height_px(), cloud.width_px());
  for (int v = 0; v < depth_m.rows; ++v)
    for (int u = 0; u < depth_m.cols; ++u)
      if (const int source = cloud.source(u, v); source != RegisteredCloud::kNone)
        depth_m(v, u) = static_cast<float>((calibration.T_color_depth * cloud.point(source)).z());
  return depth_m;
}

std::string image_name(int frame) {
  return fmt::format("{:06}.png", frame);
}

/// A row for each connected component of a class: its first pixel, and the mean probability.
std::string score_rows(const Segmented& segmented, const LabelClasses& classes,
                       const std::string& image) {
  const LabelledImage cut = instances_of(segmented.label, classes, ClassMasks::components);
  struct Component {
    int u = -1, v = -1;
    std::int64_t pixels = 0;
    double sum = 0;
  };
  std::vector<Component> components(cut.table.instances.size());
  for (int v = 0; v < cut.instances.rows; ++v)
    for (int u = 0; u < cut.instances.cols; ++u) {
      Component& at = components[cut.instances(v, u)];
      if (at.pixels++ == 0) at.u = u, at.v = v;
      at.sum += static_cast<double>(segmented.probability(v, u));
    }
  std::string rows;
  for (std::size_t id = classes.table.instances.size(); id < components.size(); ++id) {
    const Component& of = components[id];
    const double mean = std::clamp(of.sum / static_cast<double>(of.pixels), 0.0, 1.0);
    rows += fmt::format("{},{},{},{:.6f}\n", image, of.u, of.v, mean);
  }
  return rows;
}

/// Infers the frames of a recording into a folder.
class Inference {
 public:
  Inference(const NetworkModel& network, const Recording& recording, const fs::path& folder)
      : network_(network), recording_(recording), folder_(folder) {}

  void run(int jobs, const std::function<void(int, int)>& progress) {
    const OneCore one_core;
    const int all = recording_.frame_count();
    rows_.resize(static_cast<std::size_t>(all));
    make_folder(folder_ / kConfidenceFolder);
    Runs frames(rows_.size(), 1);
    int done = 0;
    std::vector<std::exception_ptr> errors(rows_.size());
    run_jobs(std::clamp(jobs, 1, all), [&](int) {
      SegmentationNetwork net(network_, image_size(recording_));
      const LabelClasses classes = classes_of(network_, net.class_count());
      for (Runs::Run run; frames.next(run);) try {
          const auto frame = static_cast<int>(run.first);
          const Segmented segmented = segment(net, frame);
          write_images(segmented, frame);
          rows_[run.first] = score_rows(segmented, classes, image_name(frame));
          const std::scoped_lock lock(mutex_);
          if (++done, progress) progress(done, all);
        } catch (...) {  // frames before this one are all in work, so the first error is found
          errors[run.first] = std::current_exception();
          frames.stop();
        }
    });
    for (const std::exception_ptr& error : errors)
      if (error) std::rethrow_exception(error);
    write_lists();
  }

 private:
  [[nodiscard]] Segmented segment(SegmentationNetwork& net, int index) const {
    Frame frame;
    recording_.read_color(index, {.color = true, .label = false, .depth = false}, frame);
    cv::Mat1f depth_m;
    if (net.needs_depth()) {
      recording_.read_depth(recording_.depth_of(index),
                            {.color = false, .label = false, .depth = true}, frame);
      depth_m = depth_in_color(frame.depth, recording_.info().calibration);
    }
    return net.segment(frame.color, depth_m,
                       (recording_.folder() / recording_.color_path(index)).string());
  }

  void write_images(const Segmented& segmented, int frame) const {
    constexpr double kThousand = 1000;
    cv::Mat1w thousandths;
    segmented.probability.convertTo(thousandths, CV_16U, kThousand);  // rounded to the nearest
    write_file(folder_ / image_name(frame), encode_png(segmented.label));
    write_file(folder_ / kConfidenceFolder / image_name(frame), encode_png(thousandths));
  }

  void write_lists() const {
    std::string stamps, scores = "image,u,v,score\n";
    for (int frame = 0; frame < recording_.frame_count(); ++frame) {
      stamps += fmt::format("{} {}\n", recording_.color_stamp_s(frame), image_name(frame));
      scores += rows_[static_cast<std::size_t>(frame)];
    }
    write_file(folder_ / "label.txt", stamps);
    write_file(folder_ / kScoreFile, scores);
    write_file(folder_ / kClassFile, read_file(network_.classes));
  }

  const NetworkModel& network_;
  const Recording& recording_;
  const fs::path& folder_;
  std::mutex mutex_;
  std::vector<std::string> rows_;  ///< of scores, by frame
};

/// What decides the label images, in words.
std::string decided_by(const NetworkModel& network, const Recording& recording) {
  return fmt::format("inferred {}\n{}{}\nrecording {}\nOpenCV {}\n", kInferredVersion,
                     content_of(network), settings_text(network), recording.content_hash(),
                     CV_VERSION);
}

/// Where the label images of a network and a recording are kept.
NetworkImages kept_images(const NetworkModel& network, const Recording& recording,
                          const fs::path& results) {
  const fs::path folder = results / kNetworksFolder / hash_of(decided_by(network, recording));
  return {folder, folder / kClassFile, ClassMasks::components, folder / kScoreFile,
          folder / kConfidenceFolder};
}

/// Names the network, what decided its images, and a hash of all that are kept.
std::string description_of(const NetworkModel& network, const Recording& recording,
                           const NetworkImages& images) {
  return fmt::format("{}\n{}images {}\n", shown(network.model.filename()),
                     decided_by(network, recording), hash_of(content_of(images)));
}

bool are_whole(const NetworkModel& network, const Recording& recording,
               const NetworkImages& images) {
  try {
    const std::string text = read_file(images.folder / kDescription);
    return text.substr(text.find('\n')) ==
           description_of(network, recording, images).substr(text.find('\n'));
  } catch (const std::exception&) {  // a file is missing or unreadable
    return false;
  }
}

}  // namespace

void check_network(const NetworkModel& network, const Recording& recording) {
  const OneCore one_core;
  const SegmentationNetwork net(network, image_size(recording));
  static_cast<void>(classes_of_values(classes_of(network, net.class_count()), network.classes,
                                      ClassMasks::components, recording.info().table));
  if (net.needs_depth()) check_depth(network, recording);
}

NetworkImages inferred_images(const NetworkModel& network, const Recording& recording,
                              const fs::path& results, int jobs,
                              const std::function<void(int, int)>& progress) {
  if (results.empty())
    refuse(network.model, "no folder of results is known to keep its label images in; sweep first");
  const NetworkImages images = kept_images(network, recording, results);
  if (fs::exists(images.folder)) return images;
  const FolderLock lock(results / kNetworksFolder);  // of several one infers, the others wait
  if (fs::exists(images.folder)) return images;
  check_network(network, recording);
  WholeFolder whole(images.folder);
  const fs::path& partial = whole.partial();
  Inference(network, recording, partial).run(jobs, progress);
  const NetworkImages written{partial, partial / kClassFile, ClassMasks::components,
                              partial / kScoreFile, partial / kConfidenceFolder};
  write_file(partial / kDescription, description_of(network, recording, written));
  whole.finish();
  return images;
}

void remove_damaged_images(const NetworkModel& network, const Recording& recording,
                           const fs::path& results) {
  const NetworkImages images = kept_images(network, recording, results);
  if (!fs::exists(images.folder) || are_whole(network, recording, images)) return;
  const FolderLock lock(results / kNetworksFolder);
  if (!are_whole(network, recording, images)) fs::remove_all(images.folder);
}

}  // namespace mapscore::eval
