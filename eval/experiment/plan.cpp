// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/plan.hpp"

#include "core/error.hpp"
#include "eval/experiment/localization_doses.hpp"
#include "eval/experiment/sensor_doses.hpp"
#include "eval/experiment/trial_fusion.hpp"
#include "eval/experiment/trial_seed.hpp"
#include "eval/localization/believed_file.hpp"
#include "eval/recording/file_bytes.hpp"
#include "eval/recording/grid_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <unordered_map>
#include <variant>

namespace mapscore::eval {
namespace {

/// What the files hold that poses and detections of a study come from. Each is read once.
class PoseFiles {
 public:
  /// Hash of the object map that perception is simulated from; empty without one. Throws Error when
  /// it is missing.
  std::string objects(const Study& config) {
    const auto* simulated = std::get_if<SimulatedPerceptionSettings>(&config.perception);
    if (!simulated || !simulated->objects) return "";
    return of(resolve_path(config, *simulated->objects),
              [](const std::filesystem::path& file) { return read_file(file); });
  }

  /// Hash of the file that the source of a configuration reads; empty when it reads none. Throws
  /// Error when the file is refused.
  std::string content(const Study& config) {
    const LocalizationSettings& settings = config.localization;
    if (settings.source == PoseSource::trajectory)
      return of(resolve_path(config, settings.trajectory.value()), trajectory_bytes);
    if (settings.source == PoseSource::particle_filter && settings.grid)
      return of(resolve_path(config, *settings.grid), grid_bytes);
    return "";
  }

 private:
  static std::string trajectory_bytes(const std::filesystem::path& file) {
    static_cast<void>(read_believed(file));  // refuses what is no trajectory
    return read_file(file);
  }

  static std::string grid_bytes(const std::filesystem::path& file) {
    const OccupancyGrid grid = load_grid(file);
    const GridFrame& frame = grid.frame();
    std::string bytes =
        fmt::format("{} {} {} {} {} {}\n", frame.resolution_m, frame.T_map_grid.x_m,
                    frame.T_map_grid.y_m, frame.T_map_grid.yaw_rad, frame.width, frame.height);
    bytes.append(grid.cells().begin(), grid.cells().end());
    return bytes;
  }

  std::string of(const std::filesystem::path& file, auto read) {
    const auto [entry, is_new] = hashes_.try_emplace(file);
    if (is_new) entry->second = hash_of(read(file));
    return entry->second;
  }

  std::map<std::filesystem::path, std::string> hashes_;
};

/// Leaves only what determines the result, so that renaming a study or adding a method to it does
/// not make its trials new. The recording stands for what it was made from.
Study determining(Study config, const std::string& pose_file, const std::string& objects) {
  const Study none;
  config.name.clear();
  config.seeds = 1;
  for (auto* path :
       {&config.scene, &config.classes, &config.robot, &config.motion, &config.recording})
    path->reset();
  config.trajectory = none.trajectory;
  config.cameras = none.cameras;
  config.lidar = none.lidar;
  config.sweep.clear();
  config.picture_view.reset();
  config.faults.depth = resolved(config.faults.depth);
  config.faults.labels = resolved(config.faults.labels);
  resolve_localization(config.localization, config.faults, pose_file);
  if (auto* simulated = std::get_if<SimulatedPerceptionSettings>(&config.perception);
      simulated && simulated->objects)
    simulated->objects = objects;
  config.base_folder.clear();
  for (MethodSettings& method : config.methods) method.name = "method";
  return config;
}

/// With one method, whose fusion becomes the study's.
Study with_method(Study config, const std::string& name) {
  std::erase_if(config.methods, [&](const MethodSettings& method) { return method.name != name; });
  config.sweep.clear();
  for (MethodSettings& method : config.methods) {
    config.fusion = fusion_of(config.fusion, method.fusion);
    method.fusion = StudyFusionSettings{};
  }
  return config;
}

/// A true pose is part of it.
Study without_faults(Study config) {
  config.localization = {};
  config.faults = {};
  return config;
}

Study for_lattice_ceiling(Study config) {
  config = without_faults(std::move(config));
  config.perception = {};  // true labels, whatever the methods see
  config.methods = {{"lattice", DirectSettings{}, Place::points}};
  config.place = Place::points;
  return config;
}

Task make_task(Study config, int seed_index, Labels labels, const std::string& recording_hash,
               PoseFiles& files) {
  Task task;
  task.description = fmt::format(
      "scoring_version: {}\nrecording: {}\nlabels: {}\nseed_index: {}\n{}", kScoringVersion,
      recording_hash, labels == Labels::truth ? "truth" : "detected", seed_index,
      to_key_yaml(determining(config, files.content(config), files.objects(config))));
  task.key = hash_of(task.description);
  task.config = std::move(config);
  task.seed_index = seed_index;
  task.labels = labels;
  return task;
}

/// Adds tasks to a plan, each once.
class TaskList {
 public:
  explicit TaskList(std::vector<Task>& tasks) : tasks_(tasks) {}

  std::size_t add(Task task) {
    const auto [entry, is_new] = positions_.try_emplace(task.key, tasks_.size());
    if (is_new) tasks_.push_back(std::move(task));
    return entry->second;
  }

 private:
  std::vector<Task>& tasks_;
  std::unordered_map<std::string, std::size_t> positions_;
};

}  // namespace

std::uint64_t trial_seed(const Task& task) {
  return trial_seed(task.config.seed, task.seed_index);
}

void check_pose_files(const Study& study) {
  PoseFiles files;
  for (const Cell& cell : cells(study)) {
    const Study config = resolve(study, cell);
    static_cast<void>(files.content(config));
    static_cast<void>(files.objects(config));
  }
}

Task task_of(const Study& study, const TrialSpec& spec, Labels labels,
             const std::string& recording_hash) {
  const Study config = resolve(study, spec.cell);
  PoseFiles files;
  return make_task(
      labels == Labels::truth ? for_lattice_ceiling(config) : with_method(config, spec.method),
      spec.seed_index, labels, recording_hash, files);
}

Plan plan_of(const Study& study, const std::string& recording_hash) {
  for (const SweepAxis& axis : study.sweep)
    if (decides_recording(axis.path))
      throw Error("sweep." + axis.path +
                  ": decides what is recorded; make one study for each of its values");
  Plan plan;
  TaskList list(plan.tasks);
  PoseFiles files;
  for (const TrialSpec& spec : trials(study)) {
    const Study config = with_method(resolve(study, spec.cell), spec.method);
    const auto add = [&](Study&& of, Labels labels) {
      return list.add(make_task(std::move(of), spec.seed_index, labels, recording_hash, files));
    };
    PlannedTrial trial;
    trial.spec = spec;
    trial.task = add(Study(config), Labels::detected);
    trial.registration_ceiling = add(without_faults(config), Labels::detected);
    trial.lattice_ceiling = add(for_lattice_ceiling(resolve(study, spec.cell)), Labels::truth);
    plan.trials.push_back(std::move(trial));
  }
  return plan;
}

}  // namespace mapscore::eval
