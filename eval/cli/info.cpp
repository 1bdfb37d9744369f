// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/experiment/plan.hpp"
#include "eval/experiment/study_recording.hpp"
#include "eval/experiment/study_store.hpp"
#include "eval/map_files/legend.hpp"
#include "eval/map_files/map_file.hpp"
#include "eval/recording/recording.hpp"
#include "eval/report/summary.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <iostream>
#include <map>
#include <memory>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

void print_classes(const ClassTable& table) {
  std::cout << fmt::format("{:>4}  {:<16} {:<8} {:<7} {}\n", "id", "class", "colour", "detect",
                           "instances");
  for (const SemanticClass& c : table.classes) {
    int instances = 0;
    for (const Instance& instance : table.instances)
      instances += instance.id != 0 && instance.class_id == c.id ? 1 : 0;
    std::cout << fmt::format("{:>4}  {:<16} {:02X}{:02X}{:02X}   {:<7} {}\n", c.id, c.name,
                             c.colour.r, c.colour.g, c.colour.b, c.detect ? "yes" : "no",
                             instances);
  }
}

void print_scene(const fs::path& file) {
  const SceneSurfaces scene = surfaces_of_scene(file);
  std::cout << fmt::format("{}: scene of {} drawn surfaces\n", file.string(), scene.shapes.size());
  std::map<std::string, int> kinds;
  for (const Shape& shape : scene.shapes) ++kinds[name_of(shape.kind)];
  for (const auto& [kind, count] : kinds) std::cout << fmt::format("  {:<10} {}\n", kind, count);
  for (const std::string& body : scene.unmatched_bodies)
    std::cout << fmt::format("  no class matches body '{}'\n", body);
  print_classes(scene.table);
}

void print_recording(const fs::path& folder) {
  const Recording recording = Recording::open(folder);
  const RecordingInfo& info = recording.info();
  const CameraModel& color = info.calibration.color;
  std::cout << fmt::format("{}: recording of {}, {} frames of {} x {}, {:.4g} frames/s, {}\n",
                           folder.string(), info.scene, info.frame_count, color.width_px,
                           color.height_px, info.color_rate_hz,
                           info.has_truth ? "with truth" : "without truth");
  std::cout << fmt::format("content hash {}\n", recording.content_hash());
  print_classes(info.table);
}

void print_store(const fs::path& results) {
  const fs::path file = store_file(results);
  const ResultStore store = ResultStore::open_existing(file);
  const StudyRecord record = read_study(store, file.parent_path());
  const Plan plan = plan_of(record.study, record.recording_hash);
  std::size_t done = 0;
  for (const Task& task : plan.tasks) done += store.contains(task.key) ? 1 : 0;
  std::cout << fmt::format(
      "{}: results of study {}, {} of {} trials and ceilings, by mapscore {}\n", file.string(),
      record.study.name, done, plan.tasks.size(), store.text("mapscore_version"));
  std::cout << store.text("study");
}

const char* name_of(LabelKind kind) {
  switch (kind) {
    case LabelKind::colour:
      return "colour";
    case LabelKind::id:
      return "id";
    case LabelKind::name:
      return "class";
    default:
      return "label";
  }
}

void print_map(const fs::path& file) {
  constexpr std::size_t kLabels = 40;
  const MapFile map = read_map_file(file, NotFinite::skip);
  const auto free = std::ranges::count(map.occupied, std::uint8_t{0});
  const char* unit = map.points.empty() ? "voxels" : "points";
  const std::string edge = map.edge_m > 0 ? fmt::format(" of {} m", map.edge_m) : "";
  std::cout << fmt::format("{}: map of {} {}{}{}\n", file.string(), map.size(), unit, edge,
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
    std::cout << fmt::format("  {} {:<12} {}\n", name_of(map.label_kind), labels[n].label,
                             labels[n].count);
  if (labels.size() > kLabels)
    std::cout << fmt::format("  and {} labels more\n", labels.size() - kLabels);
}

void info(const fs::path& file) {
  if (!fs::exists(file)) throw Error(file.string() + ": there is no such file or folder");
  if (file.extension() == ".xml") return print_scene(file);
  if (has_ending_of_a_map(file)) return print_map(file);
  if (fs::exists(file / "recording.yaml")) return print_recording(file);
  if (fs::exists(store_file(file)) && store_file(file).extension() == ".sqlite")
    return print_store(file);
  throw Error(
      file.string() +
      ": not a scene (.xml), a recording's folder, a map (.ot, .bt, .ply, .pcd, .csv) or a results "
      "folder");
}

}  // namespace

void add_info(CLI::App& program) {
  auto* verb = program.add_subcommand("info", "What is this scene, recording, map or store");
  const auto file = std::make_shared<std::string>();
  verb->add_option("FILE", *file, "Scene, recording, map or results")->required();
  verb->footer(
      "Examples:\n"
      "  mapscore info scenes/apartment.xml\n"
      "  mapscore info map.pcd\n"
      "  mapscore info results/demo");
  verb->callback([file] { info(*file); });
}

}  // namespace mapscore::eval
