// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/trial_sheet.hpp"

#include "eval/recording/image_files.hpp"
#include "eval/recording/info_yaml.hpp"
#include "eval/recording/pose_text.hpp"
#include "eval/recording/stamp_list.hpp"
#include "files/csv.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "files/refusal.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"
#include "files/yaml_value.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <tuple>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

constexpr int kFormat = 1;
constexpr const char* kSheetFile = "trial.yaml";
constexpr const char* kMend = "write the trial anew";
constexpr std::string_view kFrameColumns = "frame,stamp_s,color,depth,label\n";
constexpr std::string_view kDetectionColumns = "frame,layer,id,class,score\n";
constexpr std::size_t kBeliefNumbers = 2 + 12 + 12 + 36;  // frame, stamp, two poses, covariance
constexpr std::size_t kMostLayers = 1000;

std::string belief_header() {
  std::string text = "frame,stamp_s";
  for (const char* pose : {"T_map_odom", "T_odom_base"})
    for (int row = 1; row <= 3; ++row)
      for (int column = 1; column <= 4; ++column)
        text += fmt::format(",{}_{}{}", pose, row, column);
  for (int row = 1; row <= 6; ++row)
    for (int column = 1; column <= 6; ++column)
      text += fmt::format(",covariance_{}{}", row, column);
  return text + '\n';
}

using CovarianceRows = std::array<double, 36>;

CovarianceRows covariance_rows(const Covariance6& covariance) {
  CovarianceRows rows{};
  std::ranges::copy(covariance.reshaped<Eigen::RowMajor>(), rows.begin());
  return rows;
}

std::string belief_lines(const TrialSheet& sheet) {
  std::string text = belief_header();
  for (const TrialFrame& frame : sheet.frames)
    text += fmt::format("{},{},{},{},{}\n", frame.index, frame.stamp_s,
                        join_numbers(rows_of(frame.belief.T_map_odom), ","),
                        join_numbers(rows_of(frame.belief.T_odom_base), ","),
                        join_numbers(covariance_rows(frame.belief.covariance), ","));
  return text;
}

/// TUM's lines, for people and their tools.
std::string pose_lines(const TrialSheet& sheet) {
  std::string text = "# T_map_base_footprint, believed: stamp_s tx ty tz qx qy qz qw\n";
  for (const TrialFrame& frame : sheet.frames)
    text += fmt::format(
        "{} {}\n", frame.stamp_s,
        join_numbers(numbers_of(frame.belief.T_map_odom * frame.belief.T_odom_base), " "));
  return text;
}

std::string frame_lines(const TrialSheet& sheet) {
  std::string text(kFrameColumns);
  for (const TrialFrame& frame : sheet.frames)
    text += csv_line({std::to_string(frame.index), fmt::format("{}", frame.stamp_s), frame.color,
                      frame.depth, frame.label});
  return text;
}

std::string detection_lines(const TrialSheet& sheet) {
  std::string text(kDetectionColumns);
  for (const TrialDetection& row : sheet.detections)
    text += fmt::format("{},{},{},{},{}\n", row.frame ? std::to_string(*row.frame) : "*", row.layer,
                        row.id, row.class_id, row.score);
  return text;
}

std::string trial_text(const TrialSheet& sheet) {
  const Calibration& believed = sheet.believed;
  return fmt::format("trial_format: {}\nstudy: {}\nmethod: {}\nseed_index: {}\ndraw_seed: {}\n",
                     kFormat, yaml_quoted(sheet.study), yaml_quoted(sheet.method), sheet.seed_index,
                     sheet.draw_seed) +
         fmt::format("voxel_m: {}\nmap_origin_m: [{}]\nmap_yaw_deg: {}\n", sheet.voxel_m,
                     join_numbers(std::span<const double>(sheet.map_origin_m.data(), 3), ", "),
                     sheet.map_yaw_deg) +
         cameras_text(believed, sheet.color_rate_hz, sheet.depth_rate_hz) +
         fmt::format("T_color_depth: [{}]\nT_base_depth: [{}]\n",
                     join_numbers(rows_of(believed.T_color_depth), ", "),
                     join_numbers(rows_of(believed.T_base_depth), ", ")) +
         classes_text(sheet.classes);
}

TrialSheet read_trial_yaml(const fs::path& file) {
  const YamlValue root = load_yaml(file);
  if (const YamlValue format = root.at("trial_format"); format.text() != std::to_string(kFormat))
    format.fail(fmt::format("trial of format {}, this program reads {}; {}", format.text(), kFormat,
                            kMend));
  root.only({"trial_format", "study", "method", "seed_index", "draw_seed", "voxel_m",
             "map_origin_m", "map_yaw_deg", "color", "depth", "T_color_depth", "T_base_depth",
             "classes"});
  TrialSheet sheet;
  sheet.study = root.at("study").name();
  sheet.method = root.at("method").name();
  sheet.seed_index = static_cast<int>(root.at("seed_index").whole(0, 1'000'000));
  sheet.draw_seed = root.at("draw_seed").whole(0, std::numeric_limits<std::uint64_t>::max());
  sheet.voxel_m = root.at("voxel_m").positive();
  const YamlValue origin = root.at("map_origin_m");
  const std::vector<YamlValue> numbers = origin.elements();
  if (numbers.size() != 3) origin.fail("expected [x, y, z]");
  for (int axis = 0; axis < 3; ++axis)
    sheet.map_origin_m[axis] = numbers[static_cast<std::size_t>(axis)].number();
  sheet.map_yaw_deg = root.at("map_yaw_deg").number();
  sheet.believed = calibration_of(root);
  sheet.color_rate_hz = root.at("color").at("rate_hz").positive();
  sheet.depth_rate_hz = root.at("depth").at("rate_hz").positive();
  sheet.classes = classes_of(root.at("classes"));
  return sheet;
}

/// Calls take(cells, fail) for each line below the header, which must be `columns`.
void read_csv(const fs::path& file, std::string_view columns,
              const std::function<void(const std::vector<std::string>&,
                                       const std::function<void(const char*)>&)>& take) {
  const std::string text = read_file(file);
  const auto count = static_cast<std::size_t>(std::ranges::count(columns, ',')) + 1;
  if (!text.starts_with(columns))
    refuse(file, 1, "does not begin with the columns {}; {}",
           columns.substr(0, columns.find(',', 30)), kMend);
  TextLines lines(text);
  static_cast<void>(lines.next());
  const auto fail = [&](const char* what) { refuse(file, lines.number(), "{}; {}", what, kMend); };
  while (const auto line = lines.next()) {
    if (line->empty()) continue;
    const auto cells = csv_cells(*line, count);
    if (!cells || cells->size() != count) fail("has not as many cells as the columns are");
    take(*cells, fail);
  }
}

int index_of(const std::string& cell, const std::function<void(const char*)>& fail) {
  const auto index = parse_count(cell);
  if (!index || *index > 999'999) fail("its frame is no whole number below a million");
  return static_cast<int>(*index);
}

std::vector<TrialFrame> read_frames(const fs::path& folder) {
  std::vector<TrialFrame> frames;
  read_csv(folder / "frames.csv", kFrameColumns, [&](const auto& cells, const auto& fail) {
    TrialFrame frame{index_of(cells[0], fail), 0.0, cells[2], cells[3], cells[4], {}};
    const auto stamp_s = parse_number(cells[1]);
    if (!stamp_s || (!frames.empty() && *stamp_s <= frames.back().stamp_s))
      fail("its stamp is no number above that of the line before");
    frame.stamp_s = *stamp_s;
    for (const std::string& image : {frame.color, frame.depth, frame.label}) {
      check_inside(folder, image, "a trial holds its own images: copy it there");
      if (!fs::is_regular_file(folder / image)) refuse(folder / image, "is missing; {}", kMend);
    }
    frames.push_back(std::move(frame));
  });
  if (frames.empty()) refuse(folder / "frames.csv", "lists no frame; {}", kMend);
  return frames;
}

void read_beliefs(const fs::path& file, std::vector<TrialFrame>& frames) {
  auto frame = frames.begin();
  read_csv(file, belief_header(), [&](const auto& cells, const auto& fail) {
    std::array<double, kBeliefNumbers> numbers{};
    for (std::size_t n = 0; n < cells.size(); ++n) {
      const auto number = parse_number(cells[n]);
      if (!number) fail("a cell is no finite number");
      numbers[n] = *number;
    }
    if (frame == frames.end() || numbers[0] != frame->index || numbers[1] != frame->stamp_s)
      fail("is not of the frame and stamp that frames.csv has there");
    PoseRows map_odom{}, odom_base{};
    std::copy_n(numbers.begin() + 2, 12, map_odom.begin());
    std::copy_n(numbers.begin() + 14, 12, odom_base.begin());
    const auto T_map_odom = pose_of_rows(map_odom), T_odom_base = pose_of_rows(odom_base);
    if (!T_map_odom || !T_odom_base) fail("a pose is no rigid transform");
    frame->belief = {*T_map_odom, *T_odom_base, Covariance6::Zero()};
    std::copy_n(numbers.begin() + 26, 36,
                frame->belief.covariance.reshaped<Eigen::RowMajor>().begin());
    try {
      static_cast<void>(covariance_root(frame->belief.covariance));
    } catch (const Error& error) {
      fail(error.what());
    }
    ++frame;
  });
  if (frame != frames.end()) refuse(file, "has fewer lines than frames.csv; {}", kMend);
}

std::vector<TrialDetection> read_detections(const fs::path& file,
                                            const std::vector<TrialFrame>& frames,
                                            std::size_t class_count) {
  std::vector<TrialDetection> detections;
  std::set<int> listed;
  for (const TrialFrame& frame : frames) listed.insert(frame.index);
  std::set<std::tuple<std::optional<int>, int, InstanceId>> seen;
  read_csv(file, kDetectionColumns, [&](const auto& cells, const auto& fail) {
    TrialDetection row;
    if (cells[0] != "*") row.frame = index_of(cells[0], fail);
    if (row.frame && !listed.contains(*row.frame)) fail("its frame is not in frames.csv");
    const auto layer = parse_count(cells[1]), id = parse_count(cells[2]),
               class_id = parse_count(cells[3]);
    const auto score = parse_number(cells[4]);
    if (!layer || *layer > kMostLayers) fail("its layer is no whole number up to 1000");
    if (!id || *id == 0 || *id > std::numeric_limits<InstanceId>::max())
      fail("its id is no whole number from 1 to 65535");
    if (!class_id || *class_id >= class_count) fail("its class is not in trial.yaml");
    if (!score || *score < 0.0 || *score > 1.0) fail("its score is no number from 0 to 1");
    row.layer = static_cast<int>(*layer);
    row.id = static_cast<InstanceId>(*id);
    row.class_id = static_cast<ClassId>(*class_id);
    row.score = *score;
    if (!seen.emplace(row.frame, row.layer, row.id).second ||
        (row.frame && seen.contains({std::nullopt, row.layer, row.id})))
      fail("its id of this layer stands in a line before");
    detections.push_back(row);
  });
  return detections;
}

/// Label images of a layer that no line names would not be read.
void check_layers(const fs::path& folder, const TrialSheet& sheet) {
  int most = 0;
  for (const TrialDetection& row : sheet.detections) most = std::max(most, row.layer);
  for (const TrialFrame& frame : sheet.frames)
    if (const fs::path beyond = folder / layer_path(frame.label, most + 1); fs::exists(beyond))
      refuse(beyond, "is of layer {}, which detections.csv does not name; {}", most + 1, kMend);
}

/// A changed poses.txt must not go without a word.
void check_poses(const fs::path& file, const std::vector<TrialFrame>& frames) {
  constexpr double kRounding = 1e-9;
  const auto same = [](const TrajectoryPose& line, const TrialFrame& frame) {
    const Pose believed = frame.belief.T_map_odom * frame.belief.T_odom_base;
    return line.stamp_s == frame.stamp_s &&
           (line.T_world_base.matrix() - believed.matrix()).norm() <=
               kRounding * (1.0 + believed.translation().norm());
  };
  if (!std::ranges::equal(read_trajectory(file), frames, same))
    refuse(file, "says other poses than beliefs.csv, which is what is read; {}", kMend);
}

}  // namespace

std::string layer_path(const std::string& label, int layer) {
  return layer == 0 ? label : sibling_path(label, fmt::format("label_{}", layer));
}

void write_sheet(const TrialSheet& sheet, const fs::path& folder) {
  write_file(folder / kSheetFile, trial_text(sheet));
  write_file(folder / "frames.csv", frame_lines(sheet));
  write_file(folder / "beliefs.csv", belief_lines(sheet));
  write_file(folder / "poses.txt", pose_lines(sheet));
  write_file(folder / "detections.csv", detection_lines(sheet));
}

TrialSheet read_sheet(const fs::path& folder) {
  TrialSheet sheet = read_trial_yaml(folder / kSheetFile);
  sheet.frames = read_frames(folder);
  read_beliefs(folder / "beliefs.csv", sheet.frames);
  sheet.detections = read_detections(folder / "detections.csv", sheet.frames, sheet.classes.size());
  check_layers(folder, sheet);
  check_poses(folder / "poses.txt", sheet.frames);
  return sheet;
}

bool is_trial_folder(const fs::path& folder) {
  return fs::is_regular_file(folder / kSheetFile);
}

}  // namespace mapscore::eval
