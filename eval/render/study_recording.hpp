// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/recording/recording.hpp"
#include "eval/study/study.hpp"
#include "sim/world/world.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

using FrameProgress = std::function<void(int done, int total)>;

/// Called while a drive on wheels is simulated, then while images are rendered, and then while
/// networks run over them; `note` before, with what the user may want to know of the scene.
struct RecordingProgress {
  FrameProgress images = {}, waypoints = {}, networks = {};
  std::function<void(const std::string& text)> note = {};
};

/// The scene and robot of a study. Throws Error when the program was built without the simulator or
/// the scene is refused.
[[nodiscard]] sim::World world_of(const Study& study);

/// A scene by itself, with the class file beside it and without a robot. Throws Error as world_of.
[[nodiscard]] sim::World world_of_scene(const std::filesystem::path& scene);

/// What recording.yaml says of a study's drive through a world, but for the rates and the number of
/// its frames.
[[nodiscard]] RecordingInfo info_of(const Study& study, const sim::World& world);

/// Renders the drive of a study and writes it as a recording, with odometry and scans where it
/// drives on wheels. A `trajectory` file (TUM lines: poses of the colour camera's optical frame in
/// the world) takes the place of the drive, without odometry and scans. `bake`: with the study's
/// faults of depth and labels in the images, see BakedFrames. Throws Error when the program was
/// built without the simulator, the scene is refused, or the folder exists or cannot be written.
void record_study(const Study& study, const std::filesystem::path& folder, int jobs,
                  const RecordingProgress& progress, const std::filesystem::path& trajectory = {},
                  bool bake = false);

/// A study of nothing but a scene, to record it along given poses. Where no robot.xml with a body
/// `base_footprint` lies beside the scene and the overrides name no robot, it is the program's own.
[[nodiscard]] Study study_of_scene(const std::filesystem::path& scene,
                                   const std::vector<std::string>& overrides);

/// The recording that a study replays: its own `recording`, or the one below `results`/recordings
/// that was rendered from the same scene, robot, trajectory and cameras; rendered now if there is
/// none. What the study's networks see in it is inferred, and kept below `results`
/// (infer_networks).
[[nodiscard]] Recording recording_of(const Study& study, const std::filesystem::path& results,
                                     int jobs, const RecordingProgress& progress);

/// The same without rendering: nothing where there is none yet.
[[nodiscard]] std::optional<Recording> recording_there(const Study& study,
                                                       const std::filesystem::path& results);

/// Drawn surfaces and classes of a scene by itself.
struct SceneSurfaces {
  ClassTable table;
  std::vector<Shape> shapes;
  std::vector<std::string> unmatched_bodies;  ///< with drawn geoms, of no class
};

/// Throws Error when the program was built without the simulator or the scene is refused.
[[nodiscard]] SceneSurfaces surfaces_of_scene(const std::filesystem::path& scene);

}  // namespace mapscore::eval
