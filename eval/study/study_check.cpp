// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/study/fault_check.hpp"
#include "eval/study/grid.hpp"
#include "eval/study/method_check.hpp"
#include "eval/study/picture_view.hpp"
#include "files/png.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace mapscore::eval {
namespace {

/// The name becomes a folder's and stands in figures.
void check_name(const std::string& name, const Blame& blame) {
  if (const auto unfit = unfit_as_name(name)) blame("name", *unfit);
  if (name.find('/') != name.npos || name == "." || name == "..")
    blame("name",
          fmt::format("'{}' names no folder of its own; write a name without /, and not . or ..",
                      name));
}

/// Each stands for one method or class in a figure's legend.
void check_titles(const Study& study, const Blame& blame) {
  std::set<std::string> seen;
  const auto check_title = [&](const std::string& path, const std::string& title) {
    if (const auto unfit = unfit_as_name(title)) blame(path, *unfit);
    if (!seen.insert(title).second)
      blame(path, fmt::format("'{}' stands for another too; write one of its own", title));
  };
  for (const MethodSettings& method : study.methods)
    check_title(fmt::format("methods.{}.title", method.name), method.title.value_or(method.name));
  seen.clear();
  for (const auto& [name, title] : study.class_titles) check_title("class_titles", title);
}

void check_input(const Study& study, const Blame& blame) {
  const auto needs_scene = [&](const auto& of_scene, const char* path, const char* why) {
    if (of_scene && !study.scene)
      blame(path, fmt::format("stands without a scene, {}; write scene: PATH, or remove it", why));
  };
  needs_scene(study.motion, "motion", "whose joints it moves");
  if (study.recording) needs_scene(study.classes, "classes", "whose bodies it names");
  if (study.recording) needs_scene(study.robot, "robot", "through which it drives");
  if (study.recording) return;
  if (!study.scene)
    blame("scene", "is missing; write scene: PATH, or recording: PATH to replay one");
  if (study.trajectory.waypoints_m_deg.empty() && !explores(study))
    blame("trajectory.waypoints_m_deg",
          "the trajectory is empty; write at least one waypoint, [[x, y, yaw], ...], or for "
          "mapscore explore who chooses the way, exploration: {planner: next_best_view}");
}

/// Each has a scene or a recording of its own, with images of its own.
void check_scenes(const Study& study, const Blame& blame) {
  if (study.scene || study.recording)
    blame(study.scene ? "scene" : "recording",
          "stands beside scenes, of which each has its own; "
          "write it below one of them");
  if (points_of(study.sampling) > 0)
    blame("sampling", "stands beside scenes, of which every point would have one; leave one out");
  const auto studies = studies_of_scenes(study);
  for (const auto& [name, one] : studies)
    check_input(one, [&, scene = name](std::string_view path, const std::string& problem) {
      blame("scenes." + scene, fmt::format("{}: {}", path, problem));
    });
  const bool swept = std::ranges::any_of(study.sweep, [](const SweepAxis& axis) {
    return axis.path == "perception" && std::ranges::count(axis.values, "images") > 0;
  });
  if (studies.size() > 1 && (swept || std::holds_alternative<ImagePerception>(study.perception)))
    blame("perception.images",
          "are of one recording, and there are several scenes; write a study for each of them");
}

void check_cameras(const CameraSettings& cameras, const Blame& blame) {
  if (const std::string problem = too_many_pixels(cameras.width_px, cameras.height_px);
      !problem.empty())
    blame("cameras.width_px", problem);
}

/// Of the cameras or the lidar.
void check_span(const auto& sensor, const std::string& path, const Blame& blame) {
  if (sensor.range_min_m < sensor.range_max_m) return;
  blame(path + ".range_min_m", fmt::format("{} is not below range_max_m, {}; write a lesser number",
                                           sensor.range_min_m, sensor.range_max_m));
}

void check_distinct(const std::vector<std::string>& list, std::string_view path,
                    const Blame& blame) {
  std::set<std::string> seen;
  for (const std::string& element : list)
    if (!seen.insert(element).second)
      blame(path, fmt::format("{} stands twice; keep one", element));
}

/// The scorer counts along such a list, so its order is part of it.
template <class T>
void check_ascending(const std::vector<T>& list, std::string_view path, const Blame& blame) {
  for (std::size_t i = 1; i < list.size(); ++i)
    if (list[i] <= list[i - 1])
      blame(path, fmt::format("{} stands after {}; write them ascending, each once", list[i],
                              list[i - 1]));
}

void check_exploration(const Study& study, const Blame& blame) {
  if (explores(study) && std::holds_alternative<PoseDrive>(study.trajectory.drive))
    blame("trajectory.drive",
          "is poses, and who explores drives on wheels; write wheels, or leave it out");
  if (std::holds_alternative<DrawnWaypoints>(study.exploration.planner) &&
      study.trajectory.waypoints_m_deg.empty())
    blame("trajectory.waypoints_m_deg",
          "is empty, and exploration.planner drives its waypoints; write at least one, or choose "
          "another planner");
}

/// The controller creeps no slower (sim::WaypointController).
void check_wheels(const Study& study, const Blame& blame) {
  constexpr double kSlowest_mps = 0.01;
  if (!on_wheels(study) || study.trajectory.speed_mps >= kSlowest_mps) return;
  blame("trajectory.speed_mps",
        fmt::format("{} is below {}, the slowest that wheels drive; write a greater number",
                    study.trajectory.speed_mps, kSlowest_mps));
}

void check_localization(const Study& study, const Blame& blame) {
  const LocalizationSettings& localization = study.localization;
  if (localization.source == PoseSource::trajectory && !localization.trajectory)
    blame("localization.trajectory", "is missing; write trajectory: FILE, or another source");
  const bool needs_logs = localization.source == PoseSource::odometry ||
                          localization.source == PoseSource::particle_filter ||
                          (is_visual(localization.source) && localization.visual.visual.wheels);
  if (needs_logs && !study.recording && !on_wheels(study))
    blame("localization.source",
          "needs the odometry of a drive on wheels; write trajectory: {drive: {wheels: {}}}");
  const KldParams& kld = localization.filter.kld.values;
  const std::size_t least = kld.min_particles, most = kld.max_particles;
  if (most < least)
    blame("localization.filter.most_particles",
          fmt::format("{} is below least_particles, {}; write a greater one", most, least));
  const double rate = study.faults.lidar.dose().dropout_rate;
  if (rate > 1)
    blame("faults.lidar.scale",
          fmt::format("makes dropout_rate {}; write a lesser number, a share ends at 1", rate));
}

void check_perception(const Study& study, const Blame& blame) {
  if (std::holds_alternative<SimulatedPerception>(study.perception) &&
      study.faults.time_offset_ms != 0)
    blame("faults.time_offset_ms",
          "stands beside simulated perception, which sees the depth image itself, at no offset; "
          "keep one of the two");
  if (const auto* network = std::get_if<NetworkPerception>(&study.perception)) {
    if (!network->model)
      blame("perception.network.model", "is missing; write model: FILE.onnx, the network");
    if (!network->classes)
      blame("perception.network.classes",
            "is missing; write classes: FILE, what the channels of its output mean");
    if (study.faults.labels.dose().scores != 0)
      blame("faults.labels.scores",
            "stands beside perception.network, which scores its detections; keep one of the two");
  }
  const auto* images = std::get_if<ImagePerception>(&study.perception);
  if (images == nullptr) return;
  if (!images->folder)
    blame("perception.images.folder", "is missing; write folder: FOLDER, of the label images");
  if (!images->classes)
    blame("perception.images.classes", "is missing; write classes: FILE, what their pixels mean");
  if (images->scores && study.faults.labels.dose().scores != 0)
    blame("faults.labels.scores",
          "stands beside perception.images.scores, the network's own; keep one of the two");
}

void check_time(const ScoreSettings& score, const Blame& blame) {
  if (score.at_s && score.unit == ScoreUnit::frame)
    blame("score.at_s",
          "stands beside unit: frame, which scores each frame at its own time; "
          "keep one of the two");
}

void check_view(const Study& study, const Blame& blame) try {
  if (study.picture_view) (void)view_of_numbers(*study.picture_view);
} catch (const Error& error) {
  blame("picture_view", error.what());
}

/// One point of the grid, or a study without a sweep.
void check_leaves(const Study& study, const Blame& blame) {
  check_input(study, blame);
  check_methods(study, blame);
  check_cameras(study.cameras, blame);
  check_span(study.cameras, "cameras", blame);
  check_span(study.lidar, "lidar", blame);
  if (study.detect) check_distinct(study.detect->classes, "detect", blame);
  check_faults(study.faults, blame);
  check_wheels(study, blame);
  check_exploration(study, blame);
  check_localization(study, blame);
  check_perception(study, blame);
  check_time(study.score, blame);
  check_ascending(study.score.tolerances, "score.tolerances", blame);
  check_ascending(study.score.distances_m, "score.distances_m", blame);
}

/// Paths with numbers have ranges.
void check_sampling(const Study& study, const Blame& blame) {
  if (points_of(study.sampling) == 0) return;
  if (study.sweep.empty())
    blame("sampling",
          "stands without a sweep, whose ranges its points fill; write sweep: {PATH: [LOW, HIGH]}");
  for (const SweepAxis& axis : study.sweep) {
    const auto numbers = numbers_of(axis);
    if (!numbers) continue;
    if (numbers->size() != 2)
      blame("sweep." + axis.path,
            fmt::format("has {} value{}; beside sampling write a range, [LOW, HIGH]",
                        numbers->size(), numbers->size() == 1 ? "" : "s"));
    if (numbers->front() >= numbers->back())
      blame("sweep." + axis.path, fmt::format("{} is not below {}; write a range, [LOW, HIGH]",
                                              axis.values.front(), axis.values.back()));
  }
}

/// Cells are held in memory, trials are counted by an int.
void check_size(const Study& study, const Blame& blame) {
  constexpr double kMostCells = 1e6, kMostTrials = 1e9;
  const bool is_grid = points_of(study.sampling) == 0;
  double cells = std::max(1, points_of(study.sampling));
  for (const SweepAxis& axis : study.sweep) {
    if (axis.values.empty()) blame("sweep." + axis.path, "has no values; write at least one");
    check_distinct(axis.values, "sweep." + axis.path, blame);
    if (is_grid) cells *= static_cast<double>(axis.values.size());
  }
  const double trials = cells * static_cast<double>(study.methods.size()) * study.seeds;
  if (cells > kMostCells)
    blame("sweep",
          fmt::format("{} cells by {} methods and {} seeds are {} trials; at most {} cells "
                      "are held in memory, so --yes does not help: sweep fewer values, or "
                      "write sampling: {{sobol: {{points: N}}}} and ranges",
                      cells, study.methods.size(), study.seeds, trials, kMostCells));
  if (trials > kMostTrials)
    blame("seeds", fmt::format("{} cells by {} methods and {} seeds are {} trials, of at most {}; "
                               "write fewer of them",
                               cells, study.methods.size(), study.seeds, trials, kMostTrials));
}

void check_cell(const Study& study, const Cell& cell, const Blame& blame) {
  const auto blame_cell = [&](std::string_view path, const std::string& problem) {
    blame("sweep", fmt::format("with {}, {}: {}", text_of(cell), path, problem));
  };
  check_leaves(resolve(study, cell), blame_cell);
}

}  // namespace

void check(const Study& study, const Blame& blame) {
  check_name(study.name, blame);
  check_titles(study, blame);
  check_view(study, blame);
  check_sampling(study, blame);
  check_size(study, blame);
  if (study.sweep.empty()) return check_leaves(study, blame);
  if (study.scenes.empty())
    check_input(study, blame);
  else
    check_scenes(study, blame);
  check_methods(study, blame);
  for (const Cell& cell : cells(study)) check_cell(study, cell, blame);
}

void check(const Study& study) {
  check(study, [](std::string_view path, const std::string& problem) {
    throw Error(fmt::format("{}: {}", path, problem));
  });
}

}  // namespace mapscore::eval
