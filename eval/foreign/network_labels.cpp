// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/network_labels.hpp"

#include "eval/foreign/association.hpp"
#include "eval/recording/image_files.hpp"
#include "files/csv.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "files/refusal.hpp"
#include "files/suggestion.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

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

/// The images of a recording's frames by their stamps.
std::vector<fs::path> files_by_stamp(const fs::path& folder, const Recording& recording) {
  const std::vector<StampedImage> images = listed(folder);
  std::vector<double> stamps_s, frames_s;
  for (const StampedImage& image : images) stamps_s.push_back(image.stamp_s);
  for (int frame = 0; frame < recording.frame_count(); ++frame)
    frames_s.push_back(recording.color_stamp_s(frame));
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
  for (const StampedImage& image : read_stamp_list(recording.folder() / "color.txt"))
    files.push_back(folder / fs::path(image.path).filename().replace_extension(".png"));
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

/// Rows of `image,id,score` or `stamp_s,id,score`.
class ScoreReader {
 public:
  ScoreReader(const fs::path& file, const std::vector<fs::path>& images, const Recording& recording)
      : file_(file), images_(images), recording_(recording), scores_(images.size()) {}

  std::vector<std::map<std::uint16_t, double>> read() {
    const std::string text = read_file(file_);
    TextLines lines(text);
    for (bool is_head = true; const auto line = lines.next();) {
      line_ = lines.number();
      const auto cells = csv_cells(*line, kCells);
      if (cells && cells->size() == 1 && cells->front().empty()) continue;
      if (!cells || cells->size() != kCells) refuse_row("expected three cells, {}", kHeads);
      if (is_head)
        take_head(*cells);
      else
        take_row(*cells);
      is_head = false;
    }
    if (line_ == 0) refuse(file_, "is empty; write {}", kHeads);
    return std::move(scores_);
  }

 private:
  static constexpr std::size_t kCells = 3;
  static constexpr const char* kHeads = "image,id,score or stamp_s,id,score";

  template <class... Args>
  [[noreturn]] void refuse_row(fmt::format_string<Args...> what, Args&&... args) const {
    refuse(file_, line_, what, std::forward<Args>(args)...);
  }

  void take_head(const std::vector<std::string>& cells) {
    by_stamp_ = cells[0] == "stamp_s";
    if ((!by_stamp_ && cells[0] != "image") || cells[1] != "id" || cells[2] != "score")
      refuse_row("the first line names other columns; write {}", kHeads);
  }

  void take_row(const std::vector<std::string>& cells) {
    const std::size_t frame = by_stamp_ ? frame_at(cells[0]) : frame_named(cells[0]);
    const auto id = parse_count(cells[1]);
    if (!id || *id > std::numeric_limits<std::uint16_t>::max())
      refuse_row("id '{}' is no pixel value; write a whole number up to 65535", shown(cells[1]));
    const auto score = parse_number(cells[2]);
    if (!score || *score < 0.0 || *score > 1.0)
      refuse_row("score '{}' is no number from 0 to 1", shown(cells[2]));
    if (!scores_[frame].emplace(static_cast<std::uint16_t>(*id), *score).second)
      refuse_row("id {} of this image stands twice; keep one", *id);
  }

  [[nodiscard]] std::size_t frame_named(const std::string& name) const {
    const auto found = std::ranges::find(
        images_, name, [](const fs::path& image) { return image.filename().string(); });
    if (found == images_.end())
      refuse_row("there is no label image '{}'; name one as it stands in the folder, such as {}",
                 shown(name), shown(images_.front().filename().string()));
    return static_cast<std::size_t>(found - images_.begin());
  }

  [[nodiscard]] std::size_t frame_at(const std::string& text) const {
    const auto stamp_s = parse_number(text);
    if (!stamp_s) refuse_row("stamp '{}' is no number", shown(text));
    for (int frame = 0; frame < recording_.frame_count(); ++frame)
      if (std::abs(recording_.color_stamp_s(frame) - *stamp_s) < kMaxOffset_s)
        return static_cast<std::size_t>(frame);
    refuse_row("there is no colour image within {} s of stamp {}", kMaxOffset_s, *stamp_s);
  }

  const fs::path& file_;
  const std::vector<fs::path>& images_;
  const Recording& recording_;
  std::vector<std::map<std::uint16_t, double>> scores_;
  std::size_t line_ = 0;
  bool by_stamp_ = false;
};

}  // namespace

std::string content_of(const NetworkImages& images) {
  check_folder(images.folder);
  std::vector<std::string> names;
  std::string content;
  const auto add = [&](std::string_view name, const fs::path& file) {
    content += fmt::format("{} {}\n", hash_of(read_file(file)), name);
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
  if (images.scores) add("scores", *images.scores);
  return content;
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
  if (images.scores) scores_ = ScoreReader(*images.scores, files_, recording).read();
}

void NetworkLabels::take_meaning(const ClassTable& table) {
  const LabelClasses file = read_label_classes(images_.classes);
  if (file.has_instances && images_.masks != ClassMasks::instances)
    refuse(images_.classes, "lists instances, each a detection; write masks: instances");
  std::vector<std::string> names;
  for (const SemanticClass& c : table.classes) names.push_back(c.name);
  std::vector<ClassId> ours(file.table.classes.size(), kBackground);  // by the file's class id
  for (const SemanticClass& c : file.table.classes) {
    if (!c.detect) continue;
    const auto found = std::ranges::find(names, c.name);
    if (found == names.end())
      refuse(images_.classes,
             "the recording has no class '{}'; {}; or give it detect: false, and its pixels are "
             "background",
             c.name, suggestion(c.name, names));
    ours[c.id] = static_cast<ClassId>(found - names.begin());
  }
  class_of_value_ = file.class_of_value(images_.masks);
  known_.resize(class_of_value_.size());
  for (std::size_t value = 0; value < known_.size(); ++value) {
    known_[value] = value == 0 || class_of_value_[value] != kBackground;
    class_of_value_[value] = ours[class_of_value_[value]];
  }
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
  const auto& of_frame = scores_[static_cast<std::size_t>(frame)];
  if (of_frame.empty()) return found;
  std::vector<bool> seen(
      found.scores.size());  // the first pixel of each in row-major order decides
  for (int v = 0; v < values.rows; ++v) {
    for (int u = 0; u < values.cols; ++u) {
      const InstanceId id = found.instances(v, u);
      if (id == 0 || seen[id]) continue;
      seen[id] = true;
      if (const auto score = of_frame.find(values(v, u)); score != of_frame.end())
        found.scores[id] = score->second;
    }
  }
  return found;
}

void NetworkLabels::check() const {
  std::vector<std::int64_t> pixels(known_.size());
  for (std::size_t frame = 0; frame < files_.size(); ++frame)
    for (const std::uint16_t value : read(static_cast<int>(frame))) ++pixels[value];
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
}

}  // namespace mapscore::eval
