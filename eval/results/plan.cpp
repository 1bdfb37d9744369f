// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/plan.hpp"

#include "core/error.hpp"
#include "eval/results/input_files.hpp"
#include "eval/score/counts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>
#include <variant>

namespace mapscore::eval {
namespace {

/// Leaves only what determines the result, so that renaming a study or adding a method to it does
/// not make its trials new. The recording stands for what it was made from.
Study determining(Study config, InputFiles& files) {
  const Study none;
  const std::string pose_file = files.poses(config), perceived = files.perceived(config);
  const Dosed<sim::LidarNoise> lidar = canonical_lidar(config.faults.lidar);
  const std::vector<std::string> depends = files.depends(config);
  config.name.clear();
  config.seeds = 1;
  for (auto* path :
       {&config.scene, &config.classes, &config.robot, &config.motion, &config.recording})
    path->reset();
  config.trajectory = none.trajectory;
  config.cameras = none.cameras;
  config.lidar = none.lidar;
  config.exploration = none.exploration;
  config.sweep.clear();
  config.sampling = {};
  config.picture_view.reset();
  config = without_titles(std::move(config));
  config.faults = with_canonical_doses(config.faults);
  resolve_localization(config.localization, config.faults, pose_file);
  if (auto* simulated = std::get_if<SimulatedPerception>(&config.perception);
      simulated && simulated->objects)
    simulated->objects = perceived;
  if (auto* images = std::get_if<ImagePerception>(&config.perception)) {
    images->folder = perceived;
    images->classes.reset();
    images->scores.reset();
    images->confidence.reset();
  }
  if (auto* network = std::get_if<NetworkPerception>(&config.perception)) {
    network->model = perceived;
    network->classes.reset();
  }
  config.base_folder.clear();
  for (MethodSettings& method : config.methods) {
    method.name = "method";
    if (auto& command = method.command) {
      config.faults.lidar = lidar;  // it is given the scans, whatever the poses come from
      command = CommandMethod{.command = command->command, .map = command->map, .depends = depends};
    }
  }
  return config;
}

/// The study with true poses and calibration and no fault; the errors of a network are faults of
/// its labels.
Study without_faults(Study config) {
  config.localization = {};
  config.calibration = {};
  config.faults = {};
  if (std::holds_alternative<ImagePerception>(config.perception) ||
      std::holds_alternative<NetworkPerception>(config.perception))
    config.perception = {};
  return config;
}

Study for_lattice_ceiling(Study config) {
  config = without_faults(std::move(config));
  config.perception = {};  // true labels, whatever the methods see
  config.methods = {{"lattice", Direct{}, Place::points}};
  config.place = Place::points;
  return config;
}

/// Whether poses may be drawn from a covariance that is not diagonal.
bool draws_correlated(const Study& config) {
  if (const auto& full = config.faults.pose.covariance_m_rad)
    for (std::size_t i = 0; i < full->size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if ((*full)[i][j] != 0.0 || (*full)[j][i] != 0.0) return true;
  return config.localization.source != PoseSource::gaussian &&
         std::visit([](const auto& rule) { return rule.draws.covariance; }, config.fusion) ==
             CovarianceUse::full;
}

/// Lines of the key for definitions that changed for some settings alone: a trial that has them is
/// made anew, any other keeps its key. `config` is a determining one.
std::string revisions(const Study& config) {
  std::string lines;
  const sim::LabelDose labels = config.faults.labels.dose();
  if (labels.scores != 0.0 && labels.score_mean)
    lines += "label_scores: 2\n";  // score_mean became the mean of all scores
  if (draws_correlated(config))
    lines += "covariance_root: 2\n";  // became Cholesky's, in the order of the axes
  if (config.score.asked.labels) lines += "labels: 2\n";  // edges, PQ, confusion, calibration
  if (std::holds_alternative<Crf>(config.methods.front().refinement))
    lines += "crf: 2\n";  // whole voxels decide its cut-off, and voxels alone keep their beliefs
  if (std::holds_alternative<PluggedSegmentation>(config.methods.front().segmentation) ||
      std::holds_alternative<Drawn<PluggedRule>>(config.fusion))
    lines += fmt::format("plugged_source: {}\n", plugged_source);
  return lines;
}

SeedlessTask make_task(Study config, Labels labels, const std::string& recording_hash,
                       InputFiles& files) {
  SeedlessTask task;
  task.before_seed =
      fmt::format("scoring_version: {}\nrecording: {}\nlabels: {}\nseed_index: ", kScoringVersion,
                  recording_hash, labels == Labels::truth ? "truth" : "detected");
  const Study decides = determining(config, files);
  task.after_seed = '\n' + to_key_yaml(decides) + revisions(decides);
  task.config = std::move(config);
  task.labels = labels;
  task.recording_hash = recording_hash;
  return task;
}

/// Collects the configurations of a plan cell by cell, each once.
class Configurations {
 public:
  void next_cell() { first_ = list_.size(); }

  /// Position of the configuration, which may be an earlier one.
  std::size_t add(SeedlessTask task) {
    const auto [entry, is_new] = positions_.try_emplace(task.key(0), list_.size());
    if (is_new) {
      list_.push_back({std::move(task), first_, 0});
      for (std::size_t n = first_; n < list_.size(); ++n) list_[n].count = list_.size() - first_;
    }
    return entry->second;
  }

  [[nodiscard]] std::vector<TaskList::Configuration> take() { return std::move(list_); }

 private:
  std::vector<TaskList::Configuration> list_;
  std::unordered_map<std::string, std::size_t> positions_;
  std::size_t first_ = 0;
};

void refuse_axis(const Study& study, const std::string& path) {
  if (path == "detect")
    throw Error(
        "sweep.detect: all trials of a sweep have one detected set; write a study for each");
  if (!decides_recording(path) || (path == kSceneAxis && !study.scenes.empty())) return;
  throw Error("sweep." + path +
              ": decides what is recorded; give each of its values a name under `scenes`");
}

/// What of a cell without_faults leaves: cells that are alike in it have the same ceilings.
decltype(Cell::doses) doses_of_ceilings(const Cell& cell) {
  auto doses = cell.doses;
  std::erase_if(doses, [](const auto& dose) {
    return dose.first.starts_with("faults.") || dose.first.starts_with("localization.") ||
           dose.first.starts_with("calibration");
  });
  return doses;
}

/// The configurations of a method's trials at a cell.
struct TrialConfigurations {
  std::size_t trial, registration_ceiling, lattice_ceiling;
};

}  // namespace

const std::string& RecordingHashes::of(const std::string& scene) const {
  const auto found = hashes_.find(scene);
  if (found == hashes_.end())
    throw Error(fmt::format("scene '{}': its recording is not known; sweep again", scene));
  return found->second;
}

Task task_of(const Study& study, const TrialSpec& spec, Labels labels,
             const RecordingHashes& recordings) {
  const Study config = resolve(study, spec.cell);
  InputFiles files;
  return make_task(labels == Labels::truth ? for_lattice_ceiling(config)
                                           : with_method(config, spec.method),
                   labels, recordings.of(scene_of(study, spec.cell)), files)
      .task(spec.seed_index);
}

bool is_as_planned(const Task& task) {
  InputFiles files;
  return make_task(task.config, task.labels, task.recording_hash, files).key(task.seed_index) ==
         task.key;
}

Plan plan_of(const Study& study, const RecordingHashes& recordings, InputFiles files) {
  for (const SweepAxis& axis : study.sweep) refuse_axis(study, axis.path);
  Configurations configurations;
  std::vector<TrialConfigurations> of_trials;  // by cell, then method
  const Cell* at = nullptr;
  const auto add = [&](Study&& config, Labels labels) {
    return configurations.add(
        make_task(std::move(config), labels, recordings.of(scene_of(study, *at)), files));
  };
  std::map<decltype(Cell::doses), std::vector<TrialConfigurations>> ceilings;  // by method
  for (const Cell& cell : cells(study)) {
    configurations.next_cell();
    at = &cell;
    const Study resolved = resolve(study, cell);
    auto& of_cell = ceilings[doses_of_ceilings(cell)];
    for (std::size_t m = 0; m < study.methods.size(); ++m) {
      const Study config = with_method(resolved, study.methods[m].name);
      const std::size_t trial = add(Study(config), Labels::detected);
      if (m == of_cell.size()) {
        const std::size_t registration = add(without_faults(config), Labels::detected);
        of_cell.push_back({trial, registration, add(for_lattice_ceiling(resolved), Labels::truth)});
      }
      of_trials.push_back({trial, of_cell[m].registration_ceiling, of_cell[m].lattice_ceiling});
    }
  }
  const TaskList tasks(configurations.take(), study.seeds);
  const LazyList<TrialSpec> specs = trials(study);
  const auto planned = [tasks, specs, of_trials = std::move(of_trials),
                        methods = study.methods.size(),
                        seeds = static_cast<std::size_t>(study.seeds)](std::size_t position) {
    PlannedTrial trial{specs[position]};
    const std::size_t cell = position / methods / seeds;
    const auto& of = of_trials[cell * methods + position % methods];
    trial.task = tasks.position_of(of.trial, trial.spec.seed_index);
    trial.registration_ceiling = tasks.position_of(of.registration_ceiling, trial.spec.seed_index);
    trial.lattice_ceiling = tasks.position_of(of.lattice_ceiling, trial.spec.seed_index);
    return trial;
  };
  return {tasks, {specs.size(), planned}, files.hashes()};
}

TrialTasks tasks_of_trials(const Study& study, const std::vector<TrialSpec>& trials,
                           const RecordingHashes& recordings) {
  InputFiles files;
  std::vector<TaskList::Configuration> list;
  std::unordered_map<std::string, std::size_t> places;
  std::vector<std::size_t> positions;
  for (const TrialSpec& trial : trials) {
    for (const auto& [path, value] : trial.cell.doses) refuse_axis(study, path);
    SeedlessTask task =
        make_task(with_method(resolve(study, trial.cell), trial.method), Labels::detected,
                  recordings.of(scene_of(study, trial.cell)), files);
    const auto [place, is_new] = places.try_emplace(task.key(trial.seed_index), list.size());
    positions.push_back(place->second);
    if (is_new) list.push_back({std::move(task), list.size(), 1, trial.seed_index});
  }
  return {TaskList(std::move(list), 1), positions};
}

}  // namespace mapscore::eval
