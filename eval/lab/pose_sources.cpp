// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/pose_sources.hpp"

#include "core/error.hpp"
#include "eval/lab/map_frame.hpp"
#include "eval/lab/sights.hpp"
#include "eval/localization/localization_run.hpp"
#include "eval/recording/grid_file.hpp"
#include "eval/truth/floor_grid.hpp"

#include <fmt/format.h>

#include <utility>

namespace mapscore::eval {
namespace {

bool looks_up_at_depth(const Task& task) {
  return task.config.faults.pose.stamp == sim::PoseStamp::depth;
}

std::vector<double> stamps_of(const Recording& recording, const Task& task,
                              const std::vector<int>& depth_of) {
  std::vector<double> stamps_s;
  for (int frame = 0; frame < recording.frame_count(); ++frame)
    stamps_s.push_back(looks_up_at_depth(task)
                           ? recording.depth_stamp_s(depth_of[static_cast<std::size_t>(frame)])
                           : recording.color_stamp_s(frame));
  return stamps_s;
}

void check_logs(const Recording& recording, PoseSource source) {
  const bool needs_scans = source == PoseSource::particle_filter;
  if (recording.has_odometry() && (recording.has_scans() || !needs_scans)) return;
  throw Error(fmt::format(
      "localization.source: {} needs odometry.txt{}, which {} does not hold; record it with "
      "trajectory.drive: {{wheels: {{}}}}{}",
      word_of(source), needs_scans ? " and scan/scans.bin" : "", recording.folder().string(),
      is_visual(source) ? ", or go without: localization.visual.wheels=false" : ""));
}

/// True pose at the first line of the odometry.
Pose start_of(const Recording& recording, const std::vector<OdometryPose>& odometry) {
  const double stamp_s = odometry.front().stamp_s;
  if (const auto pose = recording.T_world_base_at(stamp_s)) return *pose;
  throw Error(
      fmt::format("{}: does not reach stamp {}, where odometry.txt starts; lengthen the trajectory",
                  (recording.folder() / "groundtruth.txt").string(), stamp_s));
}

/// The plane that localisation lives in lies at the height of the start.
void lift(BelievedTrajectory& believed, double z_m) {
  for (StampedBelief& entry : believed.entries)
    entry.belief.T_map_odom.pretranslate(Eigen::Vector3d(0.0, 0.0, z_m));
}

/// The true poses under the doses of faults.pose; those of source truth under none.
std::vector<PoseBelief> gaussian(const Recording& recording, const Task& task,
                                 const std::vector<int>& depth_of, const Pose& T_map_world) {
  sim::PoseNoise noise = task.config.faults.pose;
  if (task.config.localization.source == PoseSource::truth) noise = {};
  const std::vector<Pose> poses = true_poses(recording, task, depth_of);
  const Covariance6 covariance = sim::reported_covariance(noise);
  std::vector<PoseBelief> beliefs;
  for (const Pose& pose :
       sim::believe_poses(poses, sim::covariance_of(noise), noise.kind, trial_seed(task)))
    beliefs.push_back({Pose::Identity(), T_map_world * pose, covariance});
  return beliefs;
}

/// Names what decides the beliefs of a task whose source is no Gaussian.
std::string poses_key(const Task& task) {
  Study deciding;
  deciding.localization = task.config.localization;
  deciding.faults.lidar = task.config.faults.lidar;
  deciding.faults.pose.stamp = task.config.faults.pose.stamp;
  deciding.faults.time_offset_ms = task.config.faults.time_offset_ms;
  if (is_visual(task.config.localization.source)) {
    deciding.faults.depth = task.config.faults.depth;
    deciding.faults.mount = task.config.faults.mount;
  }
  return fmt::format("{}\n{}", trial_seed(task), to_key_yaml(deciding));
}

}  // namespace

std::vector<Pose> true_poses(const Recording& recording, const Task& task,
                             const std::vector<int>& depth_of) {
  std::vector<Pose> poses;
  for (int frame = 0; frame < recording.frame_count(); ++frame)
    poses.push_back(looks_up_at_depth(task)
                        ? recording.T_world_base_of_depth(depth_of[static_cast<std::size_t>(frame)])
                        : recording.T_world_base_of_color(frame));
  return poses;
}

OccupancyGrid grid_of(const Recording& recording, const Study& config) {
  check_logs(recording, PoseSource::particle_filter);
  const Pose start = start_of(recording, recording.read_odometry());
  if (config.localization.grid) {
    const std::filesystem::path file = resolve_path(config, *config.localization.grid);
    OccupancyGrid grid = load_grid(file);
    check_start(grid, planar(start), file.string());
    return grid;
  }
  if (!recording.info().has_truth)
    throw Error(fmt::format(
        "localization.grid: is missing, and {} has no truth to cut one from; write grid: FILE.yaml",
        recording.folder().string()));
  const Pose lidar = start * recording.read_scans().geometry.T_base_lidar;
  std::vector<Eigen::Vector2d> way_m;
  for (int frame = 0; frame < recording.frame_count(); ++frame)
    way_m.emplace_back(recording.T_world_base_of_color(frame).translation().head<2>());
  return floor_grid(recording.read_shapes(), Pose::Identity(),
                    {.height_m = lidar.translation().z(),
                     .resolution_m = grid_resolution_m(config.localization),
                     .start_m = start.translation().head<2>(),
                     .way_m = std::move(way_m)});
}

VisualTrajectory visual_trajectory(const Recording& recording, const Task& task,
                                   const std::function<void(int, int)>& progress) {
  const LocalizationSettings& settings = task.config.localization;
  if (settings.visual.visual.wheels) check_logs(recording, settings.source);
  return run_visual(recording,
                    {visual_of(settings), settings.visual.visual,
                     believed_calibration(recording.info().calibration, task),
                     task.config.faults.depth.dose(), trial_seed(task)},
                    recording.T_world_base_of_depth(0), progress);
}

BelievedTrajectory believed_trajectory(const Recording& recording, const Task& task,
                                       const OccupancyGrid* grid,
                                       const std::function<void(int, int)>& progress) {
  const LocalizationSettings& settings = task.config.localization;
  if (settings.source == PoseSource::trajectory)
    return read_believed(resolve_path(task.config, settings.trajectory.value()));
  if (is_visual(settings.source)) return visual_trajectory(recording, task, progress).believed;
  check_logs(recording, settings.source);
  const std::vector<OdometryPose> odometry = recording.read_odometry();
  const Pose start = start_of(recording, odometry);
  BelievedTrajectory believed =
      settings.source == PoseSource::odometry
          ? odometry_only(odometry, planar(start), settings.odometry_noise.values)
          : run_filter(odometry, recording.read_scans(),
                       grid ? *grid : grid_of(recording, task.config),
                       filter_of(settings, task.config.faults.lidar), planar(start),
                       trial_seed(task), progress);
  lift(believed, start.translation().z());
  return believed;
}

TrialPoses PoseSources::poses(const Task& task, const std::vector<int>& depth_of) {
  const Pose T_map_world = map_frame(task.config, task.seed_index).T_map_world();
  const PoseSource source = task.config.localization.source;
  if (source == PoseSource::gaussian || source == PoseSource::truth)
    return {gaussian(recording_, task, depth_of, T_map_world)};
  TrialPoses poses = *beliefs_.get(poses_key(task), [&] {
    return std::make_shared<const TrialPoses>(believed_at(task, depth_of));
  });
  for (PoseBelief& belief : poses.beliefs) {
    belief.T_map_odom = T_map_world * belief.T_map_odom;
    belief.covariance *= task.config.faults.pose.reported_scale;
  }
  return poses;
}

TrialPoses PoseSources::believed_at(const Task& task, const std::vector<int>& depth_of) try {
  TrialPoses poses;
  BelievedTrajectory believed;
  if (is_visual(task.config.localization.source)) {
    VisualTrajectory visual = visual_trajectory(recording_, task);
    poses.tracking = TrackingCounts::of(visual);
    believed = std::move(visual.believed);
  } else {
    believed = believed_trajectory(recording_, task, grid(task).get());
  }
  for (const double stamp_s : stamps_of(recording_, task, depth_of))
    poses.beliefs.push_back(believed.at(stamp_s));
  return poses;
} catch (const Error& error) {
  const LocalizationSettings& settings = task.config.localization;
  if (settings.source != PoseSource::trajectory) throw;
  throw Error(fmt::format("localization.trajectory: {}", error.what()));
}

std::shared_ptr<const OccupancyGrid> PoseSources::grid(const Task& task) {
  const LocalizationSettings& settings = task.config.localization;
  if (settings.source != PoseSource::particle_filter) return nullptr;
  const std::string key = settings.grid ? resolve_path(task.config, *settings.grid).string()
                                        : fmt::format("{}", grid_resolution_m(settings));
  return grids_.get(
      key, [&] { return std::make_shared<const OccupancyGrid>(grid_of(recording_, task.config)); });
}

}  // namespace mapscore::eval
