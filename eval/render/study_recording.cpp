// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/render/study_recording.hpp"

#include "core/error.hpp"
#include "eval/recording/recording_writer.hpp"
#include "eval/recording/stamp_list.hpp"
#include "eval/render/baked_frames.hpp"
#include "eval/render/own_robot.hpp"
#include "eval/render/replay_check.hpp"
#include "eval/results/input_files.hpp"
#include "files/folder_lock.hpp"
#include "files/text.hpp"

#ifdef MAPSCORE_SIMULATOR
#include "eval/render/study_drive.hpp"
#include "sim/world/motion.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <numbers>
#endif

namespace mapscore::eval {

namespace fs = std::filesystem;

namespace {

/// A recording to which the study's networks and their labels fit.
Recording opened(const Study& study, const fs::path& folder, const fs::path& results) {
  Recording recording = Recording::open(folder);
  recording.keep_in(results);
  check_network_labels(study, recording);
  return recording;
}

/// The recording that a study names.
Recording replayed(const Study& study, const fs::path& results) {
  Recording recording = opened(study, resolve_path(study, *study.recording), results);
  check_replay(study, recording.info());
  return recording;
}

/// A robot that explores needs maps to choose its way by, which trials have only afterwards.
[[maybe_unused]] void refuse_exploring(const Study& study) {
  if (explores(study))
    throw Error(
        "exploration.planner: only `mapscore explore` lets the robot choose its way; run that, and "
        "name what it recorded as recording, or write planner: none");
}

/// With the label images that the study's networks give of it.
Recording inferred(const Study& study, Recording recording, int jobs,
                   const RecordingProgress& progress) {
  infer_networks(study, recording, jobs, progress.networks);
  return recording;
}

}  // namespace

#ifdef MAPSCORE_SIMULATOR

namespace {

sim::CameraOverrides overrides_of(const CameraSettings& cameras) {
  const auto radians = [](const std::optional<double>& degrees) {
    return degrees ? std::optional(*degrees * std::numbers::pi / 180.0) : std::nullopt;
  };
  return {cameras.width_px, cameras.height_px,        cameras.range_min_m,      cameras.range_max_m,
          cameras.height_m, radians(cameras.pan_deg), radians(cameras.tilt_deg)};
}

/// Base poses that put the colour camera at the poses of a file.
std::vector<sim::StampedPose> poses_from(const fs::path& trajectory,
                                         const Calibration& calibration) {
  const Pose T_color_base = calibration.T_color_depth * calibration.T_base_depth.inverse();
  std::vector<sim::StampedPose> poses;
  for (const TrajectoryPose& line : read_trajectory(trajectory))
    poses.push_back({line.stamp_s, line.T_world_base * T_color_base});
  return poses;
}

double rate_of(const std::vector<sim::StampedPose>& poses) {
  const double seconds = poses.back().stamp_s - poses.front().stamp_s;
  return seconds > 0.0 ? static_cast<double>(poses.size() - 1) / seconds : 1.0;
}

/// Where the shapes that move are at each stamp.
ShapePoses poses_of_shapes(const sim::World& world, const std::vector<sim::StampedPose>& poses) {
  if (!world.motion()) return {};
  sim::MovingScene scene(world);
  std::vector<double> stamps_s;
  std::vector<std::vector<Pose>> T_world_shape;
  for (const sim::StampedPose& pose : poses) {
    scene.move_to(pose.stamp_s);
    stamps_s.push_back(pose.stamp_s);
    T_world_shape.push_back(scene.poses());
  }
  return poses_of_moving(world.shapes(), std::move(stamps_s), T_world_shape);
}

void write_logs(const Study& study, const sim::World& world, const StudyDrive& drive, int jobs,
                RecordingWriter& writer) {
  if (drive.odometry.empty()) return;
  writer.write_odometry(drive.odometry);
  writer.write_scans(scans_of(study, world, drive.scans, jobs));
  writer.add_poses(drive.truth);
}

void record_world(const Study& study, const sim::World& world, const StudyDrive& drive,
                  const fs::path& folder, int jobs, const FrameProgress& progress,
                  const BakedFrames* baked = nullptr) {
  const sim::Streams& streams = drive.streams;
  RecordingInfo info = info_of(study, world);
  info.color_rate_hz = rate_of(streams.color);
  info.depth_rate_hz = rate_of(streams.depth);
  info.frame_count = static_cast<int>(streams.color.size());
  if (baked) info.baked = baked->faults();
  RecordingWriter writer(folder, std::move(info));
  write_logs(study, world, drive, jobs, writer);
  writer.write_shapes(world.shapes(), poses_of_shapes(world, streams.depth));
  sim::record(
      world, streams, {jobs, study.cameras.shadows},
      {[&](const Frame& frame) { writer.write_color(baked ? baked->color(frame) : frame); },
       [&](const Frame& frame) { writer.write_depth(baked ? baked->depth(frame) : frame); }},
      progress);
  writer.finish();
}

void note_light(const Study& study, const sim::World& world, const RecordingProgress& progress) {
  if (world.has_light() || !progress.note) return;
  progress.note(
      fmt::format("{} has no light; a head light at the camera lights its images; add a <light> to "
                  "the scene to light it otherwise",
                  shown(study.scene.value_or("the scene"))));
}

/// Names what a recording is rendered from.
std::string recording_name(const Study& study, const sim::World& world) {
  Study rendered;
  rendered.trajectory = study.trajectory;
  if (depth_rate(study) != study.trajectory.frames_per_s)
    rendered.trajectory.depth_frames_per_s = depth_rate(study);
  else
    rendered.trajectory.depth_frames_per_s.reset();
  rendered.cameras = study.cameras;
  if (on_wheels(study)) rendered.lidar = study.lidar;
  std::string text = world.hash() + '\n' + sim::mujoco_version() + '\n' + to_key_yaml(rendered);
  if (world.motion()) text += world.motion()->hash;
  if (!world.has_light()) text += "\nhead light";  // without it images were black once
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return fmt::format("{}-{:012x}", fs::path(study.scene.value()).stem().string(),
                     hash.high64 >> 16);
}

/// Where the recording of a study is rendered to. Throws Error when the study does not fit the
/// scene's classes.
fs::path rendered_folder(const Study& study, const sim::World& world, const fs::path& results) {
  check_classes(study, world.classes());
  return results / "recordings" / recording_name(study, world);
}

}  // namespace

sim::World world_of_scene(const fs::path& scene) {
  return sim::World::load({scene, std::nullopt, {}}, {});
}

sim::World world_of(const Study& study) {
  sim::WorldFiles files;
  files.scene = resolve_path(study, study.scene.value());
  if (study.classes) files.classes = resolve_path(study, *study.classes);
  files.robot = robot_path(study);
  const sim::World world = sim::World::load(files, overrides_of(study.cameras));
  return study.motion ? world.moving(sim::read_motion(resolve_path(study, *study.motion))) : world;
}

RecordingInfo info_of(const Study& study, const sim::World& world) {
  RecordingInfo info;
  info.calibration = world.calibration();
  info.table = world.classes();
  info.scene = fs::path(study.scene.value()).filename().string();
  info.scene_hash = world.hash();
  info.mujoco_version = sim::mujoco_version();
  if (const sim::Motion* motion = world.motion()) {
    info.motion = motion->file;
    info.motion_hash = motion->hash;
  }
  info.seed = study.seed;
  return info;
}

void record_study(const Study& study, const fs::path& folder, int jobs,
                  const RecordingProgress& progress, const fs::path& trajectory, bool bake) {
  if (trajectory.empty()) refuse_exploring(study);
  if (!study.scene) throw Error("scene: nothing to record; name an MJCF file");
  const sim::World world = world_of(study);
  StudyDrive drive;
  if (trajectory.empty())
    drive = drive_of(study, world, progress.waypoints);
  else
    drive.streams.color = drive.streams.depth = poses_from(trajectory, world.calibration());
  std::optional<BakedFrames> baked;
  if (bake) baked.emplace(study, world.classes(), world.calibration().depth);
  record_world(study, world, drive, folder, jobs, progress.images, baked ? &*baked : nullptr);
  note_light(study, world, progress);
}

Recording recording_of(const Study& study, const fs::path& results, int jobs,
                       const RecordingProgress& progress) {
  check_input_files(study);
  if (study.recording) return inferred(study, replayed(study, results), jobs, progress);
  refuse_exploring(study);
  const sim::World world = world_of(study);
  const fs::path folder = rendered_folder(study, world, results);
  const FolderLock lock(folder.parent_path());  // of several shards one records, the others wait
  if (!fs::exists(folder)) {
    record_world(study, world, drive_of(study, world, progress.waypoints), folder, jobs,
                 progress.images);
    note_light(study, world, progress);
  }
  return inferred(study, opened(study, folder, results), jobs, progress);
}

std::optional<Recording> recording_there(const Study& study, const fs::path& results) {
  check_input_files(study);
  if (study.recording) return replayed(study, results);
  refuse_exploring(study);
  const fs::path folder = rendered_folder(study, world_of(study), results);
  return fs::exists(folder) ? std::optional(opened(study, folder, results)) : std::nullopt;
}

SceneSurfaces surfaces_of_scene(const fs::path& scene) {
  const sim::World world = world_of_scene(scene);
  return {world.classes(), world.shapes(), world.unmatched_bodies()};
}

#else

namespace {

[[noreturn]] void refuse() {
  throw Error(
      "scene: this mapscore was built without the simulator; give `recording`, or build with "
      "-DMAPSCORE_SIMULATOR=ON");
}

}  // namespace

sim::World world_of_scene(const fs::path&) {
  refuse();
}

sim::World world_of(const Study&) {
  refuse();
}

void record_study(const Study&, const fs::path&, int, const RecordingProgress&, const fs::path&,
                  bool) {
  refuse();
}

Recording recording_of(const Study& study, const fs::path& results, int jobs,
                       const RecordingProgress& progress) {
  if (!study.recording) refuse();
  return inferred(study, replayed(study, results), jobs, progress);
}

std::optional<Recording> recording_there(const Study& study, const fs::path& results) {
  if (!study.recording) refuse();
  return replayed(study, results);
}

SceneSurfaces surfaces_of_scene(const fs::path&) {
  refuse();
}

#endif

Study study_of_scene(const fs::path& scene, const std::vector<std::string>& overrides) {
  Study study;
  study.name = shown(scene.stem());
  study.scene = scene.filename().string();
  study.base_folder = scene.parent_path();
  set_leaves(study, overrides);
  if (const auto own = own_robot(); own && !study.robot && !names_base_footprint(robot_path(study)))
    study.robot = own->string();
  return study;
}

}  // namespace mapscore::eval
