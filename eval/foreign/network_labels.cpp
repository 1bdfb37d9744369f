// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/network_labels.hpp"

#include "eval/foreign/association.hpp"
#include "eval/foreign/score_rows.hpp"
#include "eval/recording/image_files.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "files/refusal.hpp"
#include "files/suggestion.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// Stamps that are farther apart do not belong together, seconds.
constexpr double kMaxOffset_s = 0.02;

/// Greatest share of pixels whose values have no meaning.
constexpr double kMostUnknown = 0.01;

constexpr const char* kMendLabels = "copy it there";

/// Names of the images in a folder without a list, ascending.
std::vector<std::string> pngs_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".png") names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

/// The list of a folder whose images have stamps of their own.
fs::path list_of(const fs::path& folder) {
  return folder / "label.txt";
}

std::vector<StampedImage> listed(const fs::path& folder) {
  std::vector<StampedImage> images = read_stamp_list(list_of(folder));
  for (const StampedImage& image : images) check_inside(folder, image.path, kMendLabels);
  return images;
}

void check_folder(const fs::path& folder) {
  if (!fs::is_directory(folder))
    refuse(folder, "no such folder; {}",
           path_suggestion(folder, "give the folder of the network's label images"));
}

/// Of the colour images, ascending.
std::vector<double> color_stamps_of(const Recording& recording) {
  std::vector<double> stamps_s;
  for (int frame = 0; frame < recording.frame_count(); ++frame)
    stamps_s.push_back(recording.color_stamp_s(frame));
  return stamps_s;
}

/// The images of a recording's frames by their stamps.
std::vector<fs::path> files_by_stamp(const fs::path& folder, const Recording& recording) {
  const std::vector<StampedImage> images = listed(folder);
  const std::vector<double> frames_s = color_stamps_of(recording);
  std::vector<double> stamps_s;
  for (const StampedImage& image : images) stamps_s.push_back(image.stamp_s);
  std::vector<fs::path> files(frames_s.size());
  for (const Association& pair : associate(stamps_s, frames_s, kMaxOffset_s))
    files[pair.second] = folder / images[pair.first].path;
  const auto missing = std::ranges::find(files, fs::path());
  if (missing != files.end())
    refuse(list_of(folder),
           "no label image within {} s of the colour image at {} s; list one for each colour image",
           kMaxOffset_s, frames_s[static_cast<std::size_t>(missing - files.begin())]);
  return files;
}

/// The images of a recording's frames by the names of their colour images.
std::vector<fs::path> files_by_name(const fs::path& folder, const Recording& recording) {
  std::vector<fs::path> files;
  for (int frame = 0; frame < recording.frame_count(); ++frame)
    files.push_back(folder /
                    fs::path(recording.color_path(frame)).filename().replace_extension(".png"));
  return files;
}

/// The commonest first.
std::string text_of(const std::vector<std::int64_t>& pixels_of_value, const auto& is_wanted) {
  constexpr std::size_t kMost = 20;
  std::vector<std::size_t> values;
  for (std::size_t value = 0; value < pixels_of_value.size(); ++value)
    if (pixels_of_value[value] > 0 && is_wanted(value)) values.push_back(value);
  std::ranges::stable_sort(values, std::ranges::greater{},
                           [&](std::size_t value) { return pixels_of_value[value]; });
  std::string text;
  for (std::size_t n = 0; n < std::min(kMost, values.size()); ++n)
    text += fmt::format("{}{}", n == 0 ? "" : ", ", values[n]);
  return values.size() > kMost ? fmt::format("{} and {} more", text, values.size() - kMost) : text;
}

/// Whether an image has a value that is scored, or one of a pixel's scores there is.
bool has_some(const cv::Mat1w& values, const FrameScores& scores) {
  if (!scores.at_pixels.empty()) return true;
  std::vector<bool> present(std::numeric_limits<std::uint16_t>::max() + 1);
  for (const std::uint16_t value : values) present[value] = true;
  return std::ranges::any_of(scores.of_value,
                             [&](const auto& score) { return present[score.first]; });
}

/// The scores of the values that detections' first pixels have, in row-major order.
void take_scores_of_values(const cv::Mat1w& values, const FrameScores& of_frame,
                           NetworkDetections& found) {
  std::vector<bool> seen(found.scores.size());
  for (int v = 0; v < values.rows; ++v) {
    for (int u = 0; u < values.cols; ++u) {
      const InstanceId id = found.instances(v, u);
      if (id == 0 || seen[id]) continue;
      seen[id] = true;
      const auto score = of_frame.of_value.find(values(v, u));
      if (score != of_frame.of_value.end()) found.scores[id] = score->second;
    }
  }
}

}  // namespace

std::string content_of(const NetworkImages& images) {
  check_folder(images.folder);
  std::vector<std::string> names;
  std::string content;
  const auto add_bytes = [&](std::string_view name, const std::string& bytes) {
    content += fmt::format("{} {}\n", hash_of(bytes), name);
  };
  const auto add = [&](std::string_view name, const fs::path& file) {
    add_bytes(name, read_file(file));
  };
  if (fs::is_regular_file(list_of(images.folder))) {
    add("label.txt", list_of(images.folder));
    for (const StampedImage& image : listed(images.folder)) names.push_back(image.path);
  } else {
    names = pngs_in(images.folder);
  }
  if (names.empty())
    refuse(images.folder, "holds no label image; give one PNG for each colour image, of its name");
  for (const std::string& name : names) add(name, images.folder / name);
  add("classes", images.classes);
  if (images.confidence) {
    check_folder(*images.confidence);
    for (const std::string& name : names) add("confidence/" + name, *images.confidence / name);
  }
  if (!images.scores) return content;
  const std::string scores = read_file(*images.scores);
  const bool has_stamps = scores.find("stamp_s") != scores.npos;  // became those of the nearest
  add_bytes(has_stamps ? "scores: 2" : "scores", scores);
  return content;
}

std::vector<ClassId> classes_of_values(const LabelClasses& classes, const fs::path& file,
                                       ClassMasks masks, const ClassTable& table) {
  std::vector<std::string> names;
  for (const SemanticClass& c : table.classes) names.push_back(c.name);
  std::vector<ClassId> ours(classes.table.classes.size(), kBackground);  // by the file's class id
  for (const SemanticClass& c : classes.table.classes) {
    if (!c.detect) continue;
    const auto found = std::ranges::find(names, c.name);
    if (found == names.end())
      refuse(file,
             "the recording has no class '{}'; {}; or give it detect: false, and its pixels are "
             "background",
             c.name, suggestion(c.name, names));
    ours[c.id] = static_cast<ClassId>(found - names.begin());
  }
  std::vector<ClassId> of_value = classes.class_of_value(masks);
  for (ClassId& value : of_value) value = ours[value];
  return of_value;
}

NetworkLabels::NetworkLabels(const NetworkImages& images, const Recording& recording,
                             const ClassTable& table)
    : images_(images),
      table_(table),
      size_(recording.info().calibration.color.width_px,
            recording.info().calibration.color.height_px) {
  check_folder(images.folder);
  files_ = fs::is_regular_file(list_of(images.folder)) ? files_by_stamp(images.folder, recording)
                                                       : files_by_name(images.folder, recording);
  take_meaning(table);
  scores_.resize(files_.size());
  if (images.scores)
    scores_ = read_scores(*images.scores, files_, size_, color_stamps_of(recording), kMaxOffset_s);
}

void NetworkLabels::take_meaning(const ClassTable& table) {
  const LabelClasses file = read_label_classes(images_.classes, images_.masks);
  if (file.has_instances && images_.masks != ClassMasks::instances)
    refuse(images_.classes, "lists instances, each a detection; write masks: instances");
  const std::vector<ClassId> named = file.class_of_value(images_.masks);
  known_.resize(named.size());
  for (std::size_t value = 0; value < known_.size(); ++value)
    known_[value] = value == 0 || named[value] != kBackground;
  class_of_value_ = classes_of_values(file, images_.classes, images_.masks, table);
}

cv::Mat1w NetworkLabels::read(int frame) const {
  const fs::path& file = files_.at(static_cast<std::size_t>(frame));
  if (!fs::is_regular_file(file))
    refuse(file,
           "label image is missing; give one for each colour image, of its name, or list "
           "them with their stamps in {}",
           list_of(images_.folder).filename().string());
  return decode_id_png(read_file(file), size_, file.string());
}

NetworkDetections NetworkLabels::of(int frame) const {
  const cv::Mat1w values = read(frame);
  LabelledImage cut = instances_of(values, class_of_value_, table_, images_.masks);
  NetworkDetections found{cut.instances, std::move(cut.table), {}};
  found.scores.resize(found.table.instances.size(), 1.0);
  const FrameScores& of_frame = scores_[static_cast<std::size_t>(frame)];
  if (!of_frame.of_value.empty()) take_scores_of_values(values, of_frame, found);
  for (const FrameScores::AtPixel& at : of_frame.at_pixels)
    found.scores[found.instances(at.v, at.u)] = at.score;
  found.scores[0] = 1.0;  // of no detection
  return found;
}

cv::Mat1w NetworkLabels::read_confidence(int frame) const {
  constexpr int kMost = 1000;
  const fs::path file = images_.confidence.value() /
                        fs::relative(files_.at(static_cast<std::size_t>(frame)), images_.folder);
  if (!fs::is_regular_file(file))
    refuse(file, "image is missing; give one of the name of each label image");
  cv::Mat1w thousandths = decode_id_png(read_file(file), size_, file.string());
  const std::uint16_t most = *std::ranges::max_element(thousandths);
  if (most > kMost)
    refuse(file, "holds {}, which is no probability in thousandths; write 0 to {}", most, kMost);
  return thousandths;
}

std::optional<PixelVerdicts> NetworkLabels::verdicts_of(int frame) const {
  if (!images_.confidence) return std::nullopt;
  PixelVerdicts verdicts{read(frame), read_confidence(frame)};
  for (std::uint16_t& value : verdicts.classes) value = class_of_value_[value];
  return verdicts;
}

void NetworkLabels::check() const {
  std::vector<std::int64_t> pixels(known_.size());
  bool scored = false;
  for (std::size_t frame = 0; frame < files_.size(); ++frame) {
    const cv::Mat1w values = read(static_cast<int>(frame));
    for (const std::uint16_t value : values) ++pixels[value];
    scored = scored || has_some(values, scores_[frame]);
    if (images_.confidence) static_cast<void>(read_confidence(static_cast<int>(frame)));
  }
  std::int64_t all = 0, unknown = 0, detected = 0;
  for (std::size_t value = 0; value < pixels.size(); ++value) {
    all += pixels[value];
    if (!known_[value]) unknown += pixels[value];
    if (table_.detected(class_of_value_[value])) detected += pixels[value];
  }
  const double share = static_cast<double>(unknown) / static_cast<double>(all);
  if (share > kMostUnknown)
    refuse(images_.folder,
           "{:.1f} % of the pixels have values that {} gives no meaning: {}; name their classes, "
           "and what is to be background as {{name: other, label: [...], detect: false}}",
           100.0 * share, images_.classes.string(),
           text_of(pixels, [&](std::size_t value) { return !known_[value]; }));
  if (detected == 0)
    refuse(images_.folder,
           "no pixel is of a detected class, the values are {}; mend {} or the study's `detect`",
           text_of(pixels, [](std::size_t) { return true; }), images_.classes.string());
  const auto row = std::ranges::find_if_not(scores_, &FrameScores::empty);
  if (!scored && row != scores_.end())
    refuse(*images_.scores,
           "no id is a pixel value of its image, such as {} of {}; the images hold {}: write these",
           row->of_value.begin()->first,
           files_[static_cast<std::size_t>(row - scores_.begin())].filename().string(),
           text_of(pixels, [](std::size_t) { return true; }));
}

}  // namespace mapscore::eval
