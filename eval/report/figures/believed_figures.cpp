// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/believed_figures.hpp"

#include "core/error.hpp"
#include "eval/lab/pose_sources.hpp"
#include "eval/localization/localization_score.hpp"
#include "eval/report/figures/pose_errors_figure.hpp"
#include "eval/report/figures/trajectory_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr const char* kSourceKey = "localization.source";
constexpr double kPointEvery_s = 0.1;                           ///< of a drawn line
constexpr double kMostPoints = 10000.0, kMostEllipses = 500.0;  ///< of however long a drive
constexpr double kEllipseEvery_s = 30.0;                        ///< of the ellipses along it

/// Configurations, one for each source that does not put the robot where it is.
std::vector<Study> sources_of(const Study& study, const PictureChoice& choice) {
  Study config = resolve(study, chosen_cell(study, choice));
  std::vector<std::string> sources{leaf_text(config, kSourceKey)};
  for (const SweepAxis& axis : study.sweep)
    if (axis.path == kSourceKey) sources = axis.values;
  std::vector<Study> configs;
  for (const std::string& source : sources) {
    set_leaf(config, kSourceKey, source);
    const PoseSource of = config.localization.source;
    if (of != PoseSource::gaussian && of != PoseSource::truth) configs.push_back(config);
  }
  return configs;
}

/// Stamps from the first to the last frame.
std::vector<double> stamps_of(const Recording& recording, double every_s, double most) {
  const double first_s = recording.color_stamp_s(0);
  const double last_s = recording.color_stamp_s(recording.frame_count() - 1);
  every_s = std::max(every_s, (last_s - first_s) / most);
  std::vector<double> stamps_s;
  for (int n = 0; first_s + n * every_s < last_s; ++n) stamps_s.push_back(first_s + n * every_s);
  stamps_s.push_back(last_s);
  return stamps_s;
}

DrawnTrajectory drawn_truth(const Recording& recording) {
  DrawnTrajectory truth{"truth", {}, {}};
  for (const double stamp_s : stamps_of(recording, kPointEvery_s, kMostPoints))
    if (const auto pose = recording.T_world_base_at(stamp_s))
      truth.points_map.emplace_back(pose->translation().head<2>());
  return truth;
}

/// From its convergence on.
DrawnTrajectory drawn(const Recording& recording, const std::string& name,
                      const BelievedTrajectory& believed, double from_s) {
  DrawnTrajectory line{name, {}, {}};
  for (const double stamp_s : stamps_of(recording, kPointEvery_s, kMostPoints)) {
    if (stamp_s < from_s) continue;
    const PlanarPose mean = planar_estimate(believed.at(stamp_s)).mean;
    line.points_map.emplace_back(mean.x_m, mean.y_m);
  }
  for (const double stamp_s : stamps_of(recording, kEllipseEvery_s, kMostEllipses))
    if (stamp_s >= from_s) line.beliefs.push_back(planar_estimate(believed.at(stamp_s)));
  return line;
}

std::string errors_text(const std::string& name, const LocalizationScore& score) {
  if (!score.converged_s) return fmt::format("{}: never converged. ", name);
  std::string text = fmt::format("{}: {:.3f} m and {:.2f} degrees off on average", name,
                                 score.position_m.mean, score.heading_deg.mean);
  if (score.nees_share)
    text += fmt::format(", normalised error within its 95 % band in {:.0f} % of frames",
                        100.0 * *score.nees_share);
  return text + ". ";
}

/// The grid under the trajectories; none, and why, where none can be cut and no filter needs one.
std::optional<OccupancyGrid> background(const Recording& recording,
                                        const std::vector<Study>& configs, std::string& why_not) {
  try {
    return grid_of(recording, configs.front());
  } catch (const Error& error) {
    const auto filters = [](const Study& config) {
      return config.localization.source == PoseSource::particle_filter;
    };
    if (std::ranges::any_of(configs, filters)) throw;
    why_not = error.what();
    return {};
  }
}

}  // namespace

Pictures draw_believed(const Study& study, const Recording& recording, const PictureChoice& choice,
                       const std::filesystem::path& folder, const FigureStyle& style) {
  const std::vector<Study> configs = sources_of(study, choice);
  if (configs.empty()) return {};
  std::vector<PoseErrors> errors;
  std::vector<DrawnTrajectory> lines{drawn_truth(recording)};
  TrajectoryNotes notes{"trajectory_on_grid",
                        fmt::format("{}: where the robot believes it is", study.name),
                        fmt::format("Seed {}. ", choice.seed_index),
                        {}};
  for (const Study& config : configs) {
    Task task;
    task.config = config;
    task.seed_index = choice.seed_index;
    const BelievedTrajectory believed = believed_trajectory(recording, task);
    std::string name = leaf_text(config, kSourceKey);
    std::ranges::replace(name, '_', ' ');
    LocalizationScore score = score_localization(believed, recording);
    if (score.converged_s) lines.push_back(drawn(recording, name, believed, *score.converged_s));
    notes.caption += errors_text(name, score);
    errors.push_back({std::move(name), std::move(score.frames)});
  }
  Pictures pictures{
      draw(pose_errors_figure(errors, fmt::format("{}: seed {}. ", study.name, choice.seed_index),
                              style),
           folder),
      {}};
  if (!recording.has_scans()) return pictures;
  const std::optional<OccupancyGrid> grid = background(recording, configs, pictures.skipped);
  if (!grid) return pictures;
  if (study.scene)
    for (const auto& [x, y, yaw] : study.trajectory.waypoints_m_deg)
      notes.waypoints_map.emplace_back(x, y);
  for (std::filesystem::path& file : draw(trajectory_figure(*grid, lines, notes, style), folder))
    pictures.files.push_back(std::move(file));
  return pictures;
}

}  // namespace mapscore::eval
