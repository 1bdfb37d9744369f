// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/info_scene.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/foreign/trial_sheet.hpp"
#include "eval/map_files/legend.hpp"
#include "eval/map_files/map_file.hpp"
#include "eval/recording/recording.hpp"
#include "eval/report/summary.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/study_store.hpp"
#include "files/suggestion.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <set>
#include <string>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// How far the odometry has come off the truth since the true pose at its start, and on how long a
/// way; nothing where the trajectory does not reach its ends.
std::string drift_text(const Recording& recording, const std::vector<OdometryPose>& odometry) {
  const auto start = recording.T_world_base_at(odometry.front().stamp_s);
  const auto end = recording.T_world_base_at(odometry.back().stamp_s);
  if (!start || !end) return "";
  double way_m = 0.0;
  for (std::size_t i = 1; i < odometry.size(); ++i)
    way_m +=
        (odometry[i].T_odom_base.translation() - odometry[i - 1].T_odom_base.translation()).norm();
  const Pose T_world_odom = *start * odometry.front().T_odom_base.inverse();
  const Pose error = end->inverse() * T_world_odom * odometry.back().T_odom_base;
  const double yaw_deg =
      std::atan2(error.linear()(1, 0), error.linear()(0, 0)) * 180.0 / std::numbers::pi;
  return fmt::format(", {:.1f} m long, at its end {:.3f} m and {:.1f} deg off the truth", way_m,
                     error.translation().head<2>().norm(), std::abs(yaw_deg));
}

std::string odometry_line(const Recording& recording) {
  const std::vector<OdometryPose> odometry = recording.read_odometry();
  return fmt::format("odometry: {} poses, {:.1f} s{}\n", odometry.size(),
                     odometry.back().stamp_s - odometry.front().stamp_s,
                     drift_text(recording, odometry));
}

std::string scan_line(const Recording& recording) {
  const ScanLog log = recording.read_scans();
  return fmt::format("lidar: {} scans of {} beams, {:g} to {:g} m\n", log.scans.size(),
                     log.scans.front().ranges_m.size(), log.geometry.range_min_m,
                     log.geometry.range_max_m);
}

void print_recording(const fs::path& folder) {
  const Recording recording = Recording::open(folder);
  const RecordingInfo& info = recording.info();
  const CameraModel& color = info.calibration.color;
  std::cout << fmt::format("{}: recording of {}, {} frames of {} x {}, {:.4g} frames/s, {}\n",
                           shown(folder), shown(info.scene), info.frame_count, color.width_px,
                           color.height_px, info.color_rate_hz,
                           info.has_truth ? "with truth" : "without truth");
  std::cout << fmt::format("content hash {}\n", recording.content_hash());
  std::string logs;
  if (recording.has_odometry()) logs += odometry_line(recording);
  if (recording.has_scans()) logs += scan_line(recording);
  std::cout << logs;
  if (info.baked)
    std::cout << fmt::format("baked into depth: {{{}}}, into labels: {{{}}}, seed {}\n",
                             info.baked->depth, info.baked->labels, info.baked->seed);
  print_classes(info.table);
}

std::string text_of_builds(const std::set<std::string>& builds) {
  std::string text;
  for (const std::string& build : builds)
    text += build.empty() ? ", a build that did not tell" : ", build " + shown(build);
  return text;
}

/// What `mapscore tolerance` alone has filled, or a sweep that was killed at once.
void print_studyless(const ResultStore& store, const fs::path& file) {
  std::set<std::string> builds;
  const auto of_trials = store.builds();
  for (const auto& [key, build] : of_trials) builds.insert(build);
  std::cout << fmt::format("{}: {} trials of `mapscore tolerance`, no study swept{}\n", shown(file),
                           of_trials.size(), text_of_builds(builds));
}

void print_store(const fs::path& results) {
  const fs::path file = store_file(results);
  const ResultStore store = ResultStore::open_existing(file);
  if (store.text("study").empty()) return print_studyless(store, file);
  const StudyRecord record = read_study(store, file.parent_path());
  const Plan plan = plan_of(record);
  const HeldTasks held = held_tasks(store, plan.tasks);
  std::cout << fmt::format("{}: results of study {}, {} of {} trials and ceilings, by mapscore {}",
                           shown(file), record.study.name, held.all, plan.tasks.size(),
                           shown(store.text("mapscore_version")));
  std::cout << text_of_builds(held.builds) << '\n';
  std::cout << store.text("study");
}

const char* name_of(LabelKind kind) {
  return kind == LabelKind::colour ? "colour"
         : kind == LabelKind::id   ? "id"
         : kind == LabelKind::name ? "class"
                                   : "label";
}

void print_map(const fs::path& file) {
  constexpr std::size_t kLabels = 40;
  const MapFile map = read_map_file(file, NotFinite::skip);
  const auto free = std::ranges::count(map.occupied, std::uint8_t{0});
  const char* unit = map.points.empty() ? "voxels" : "points";
  const std::string edge = map.edge_m > 0 ? fmt::format(" of {} m", map.edge_m) : "";
  std::cout << fmt::format("{}: map of {} {}{}{}\n", shown(file), map.size(), unit, edge,
                           free ? fmt::format(", {} of them free", free) : "");
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& point : map.points) bounds.extend(point);
  for (const VoxelKey& key : map.voxels)
    bounds.extend(centre_of(key, map.edge_m > 0 ? map.edge_m : 1.0));
  std::cout << fmt::format("  x {:.3f} to {:.3f}, y {:.3f} to {:.3f}, z {:.3f} to {:.3f} {}\n",
                           bounds.min().x(), bounds.max().x(), bounds.min().y(), bounds.max().y(),
                           bounds.min().z(), bounds.max().z(),
                           map.points.empty() && map.edge_m == 0 ? "voxels" : "m");
  const std::vector<Leftover> labels = labels_of(map);
  if (labels.empty()) std::cout << "  no labels: geometry alone\n";
  for (std::size_t n = 0; n < std::min(kLabels, labels.size()); ++n)
    std::cout << fmt::format("  {} {:<12} {}\n", name_of(map.label_kind), shown(labels[n].label),
                             labels[n].count);
  if (labels.size() > kLabels)
    std::cout << fmt::format("  and {} labels more\n", labels.size() - kLabels);
}

void print_trial(const fs::path& folder) {
  const TrialSheet sheet = read_sheet(folder);
  std::cout << fmt::format(
      "{}: trial of study {}, method {}, seed {}, {} frames, {} lines of detections\n"
      "voxels of {} m, origin {} {} {} m, yaw {} deg\n",
      shown(folder), shown(sheet.study), shown(sheet.method), sheet.seed_index, sheet.frames.size(),
      sheet.detections.size(), sheet.voxel_m, sheet.map_origin_m.x(), sheet.map_origin_m.y(),
      sheet.map_origin_m.z(), sheet.map_yaw_deg);
}

struct InfoFlags : SceneInfoFlags {
  std::string file;
};

void info(const InfoFlags& flags) {
  const fs::path file = flags.file;
  if (!fs::exists(file))
    throw Error(file.string() + ": there is no such file or folder; " +
                path_suggestion(file, "give the path of one"));
  if (file.extension() == ".xml") return info_of_scene(file, flags);
  if (flags.any()) throw Error(file.string() + ": not a scene (.xml), so no flag applies");
  if (has_ending_of_a_map(file)) return print_map(file);
  if (fs::exists(file / "recording.yaml")) return print_recording(file);
  if (is_trial_folder(file)) return print_trial(file);
  if (fs::exists(store_file(file)) && store_file(file).extension() == ".sqlite")
    return print_store(file);
  throw Error(file.string() + ": not a scene (.xml), a recording's or trial's folder, a map (" +
              map_endings() + ") or a results folder");
}

}  // namespace

void add_info(CLI::App& program) {
  const auto [verb, flags] = add_verb<InfoFlags>(
      program, "info", "What is this scene, recording, trial, map or store", info);
  verb->add_option("FILE", flags->file, "Scene, recording, folder of a trial, map or results")
      ->required();
  verb->add_option("--picture", flags->picture,
                   "Of a scene: where its picture by class goes [STEM.classes.png beside it]");
  verb->add_flag("--no_picture", flags->no_picture, "Of a scene: draw none");
  verb->add_flag("--suggest_classes", flags->suggest_classes,
                 "Of a scene: print a first class file, made of its bodies' names");
  verb->add_option("-o,--output", flags->output, "Write the suggestion here; must not exist");
  verb->footer(
      "Examples:\n"
      "  mapscore info scenes/apartment.xml --picture apartment.png\n"
      "  mapscore info kitchen.xml --suggest_classes -o kitchen.classes.yaml\n"
      "  mapscore info map.pcd\n"
      "  mapscore info results/demo");
}

}  // namespace mapscore::eval
