// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/space/occupancy.hpp"
#include "eval/study/drive_settings.hpp"
#include "eval/study/exploration_settings.hpp"
#include "eval/study/localization_settings.hpp"
#include "eval/study/sampling.hpp"
#include "eval/study/trial_settings.hpp"
#include "sim/faults/calibration_faults.hpp"
#include "sim/faults/image_doses.hpp"
#include "sim/faults/lidar_noise.hpp"
#include "sim/faults/pose_fault.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mapscore::eval {

// A study as its file has it. Parameters of core and sim stand in their own structs; here are those
// that only a study has, and the order of the keys.

struct FaultSettings {
  sim::Misregistration misregistration;
  sim::MountError mount;
  sim::PoseNoise pose;
  double time_offset_ms = 0;  ///< of the depth image that a colour image is paired with
  Dosed<sim::DepthDose> depth;
  Dosed<sim::LabelDose> labels;
  Dosed<sim::LidarNoise> lidar;

  static void fields(auto& s, auto&& visit) {
    visit(s.misregistration,
          Field{"misregistration", "wrong depth-to-colour calibration: moves labels"});
    visit(s.mount, Field{"mount", "wrong camera-to-base calibration: moves points"});
    visit(s.pose, Field{"pose", "wrong localisation"});
    visit(s.time_offset_ms,
          later({"time_offset_ms",
                 "pair each colour image with the depth image nearest to its stamp plus this",
                 {-10000, 10000},
                 "time offset (ms)"}));
    visit(s.depth, later({"depth", "noise of the depth camera: moves points"}));
    visit(s.labels, later({"labels", "errors of the 2D segmentation: moves labels"}));
    visit(s.lidar, later({"lidar", "noise of the lidar: moves the poses of the particle filter"}));
  }
  bool operator==(const FaultSettings&) const = default;
};

/// The faults with each dose in its canonical form. Those of the lidar stay: resolve_localization
/// decides which of them a key holds.
[[nodiscard]] inline FaultSettings with_canonical_doses(FaultSettings faults) {
  FaultSettings::fields(faults, [](auto& fault, const Field&) {
    if constexpr (requires { is_zero(fault.dose()); }) fault = canonical(fault.dose());
  });
  return faults;
}

/// Names of the classes that become detections, or all of them.
struct DetectedSet {
  bool all = false;
  std::vector<std::string> classes;
  bool operator==(const DetectedSet&) const = default;
};

/// Names of classes in figures, and in tables for papers.
using ClassTitles = std::map<std::string, std::string>;

/// One swept leaf. Values are canonical texts (0.010 is 0.01), in the order of the file.
struct SweepAxis {
  std::string path;
  std::vector<std::string> values;
  bool operator==(const SweepAxis&) const = default;
};

/// One scene of a study that has several: the keys of its recording, by dotted path, as canonical
/// texts.
struct SceneSettings {
  std::string name;  ///< letters, digits, _ and -
  std::vector<std::pair<std::string, std::string>> leaves = {};
  bool operator==(const SceneSettings&) const = default;
};

/// The swept path whose values are the names of `Study::scenes`.
inline constexpr std::string_view kSceneAxis = "scene";

/// Its value in tables and figures for all scenes together; no scene may be called so.
inline constexpr std::string_view kAllScenes = "all";

/// One study file (docs/study_reference.md lists its keys). Paths stay as they are written; those
/// that are relative start at `base_folder`, which is not part of the file.
struct Study {
  std::string name;
  std::uint64_t seed = 1;
  int seeds = 1;
  std::optional<std::string> scene, classes, robot, motion, recording;
  std::vector<SceneSettings> scenes;  ///< swept as kSceneAxis, in place of `scene`
  TrajectorySettings trajectory;
  CameraSettings cameras;
  LidarStudySettings lidar;
  ExplorationSettings exploration;
  double voxel_m = 0.05;
  Place place = Place::points;
  std::optional<std::array<double, 3>> map_origin_m;  ///< empty: drawn by the seed, within a voxel
  double map_yaw_deg = 0;
  std::optional<DetectedSet> detect;  ///< empty: as the class file says
  PerceptionSettings perception;
  std::vector<MethodSettings> methods;
  DrawnFusion fusion;
  Carving occupancy;
  CalibrationSettings calibration;
  LocalizationSettings localization;
  FaultSettings faults;
  ScoreSettings score;
  std::vector<SweepAxis> sweep;
  Sampling sampling;
  std::optional<std::vector<double>> picture_view;  ///< see view_of_numbers; changes no result
  ClassTitles class_titles;                         ///< changes no result

  std::filesystem::path base_folder;

  static void fields(auto& s, auto&& visit) {
    const auto recorded = [&](auto& member, std::string_view key, std::string_view meaning,
                              bool later = false) {
      visit(member, Field{.key = key, .meaning = meaning, .later = later, .recorded = true});
    };
    visit(s.name, Field{.key = "name",
                        .meaning = "name of the study; default: the file's stem",
                        .swept = false});
    visit(s.seed, Field{.key = "seed", .meaning = "seed of every random stream", .swept = false});
    visit(s.seeds, Field{.key = "seeds",
                         .meaning = "repetitions of each cell and method",
                         .range = {1, 100000},
                         .swept = false});
    recorded(s.scene, "scene", "MJCF of the scene, from the study file's folder");
    recorded(s.classes, "classes", "class file; default: SCENE.classes.yaml beside the scene");
    recorded(s.robot, "robot", "MJCF of the robot; default: robot.xml beside the scene");
    recorded(s.motion, "motion", "motion file (CSV): how joints of the scene move; needs a scene");
    recorded(s.recording, "recording", "folder of a recording to replay in place of rendering one");
    visit(s.scenes, Field{.key = "scenes",
                          .meaning = "several recordings, by name: {home: {scene: home.xml, "
                                     "trajectory: {...}}, hall: {recording: hall}}; the keys that "
                                     "decide a recording, over those of the study; swept as "
                                     "`scene` (docs/scoring.md)",
                          .later = true,
                          .swept = false});
    recorded(s.trajectory, "trajectory", "drive of the robot");
    recorded(s.cameras, "cameras", "the RGB-D camera");
    recorded(s.lidar, "lidar", "the lidar, with trajectory.drive wheels; exact ranges are recorded",
             true);
    recorded(s.exploration, "exploration", "how the robot chooses its own way, on wheels", true);
    visit(s.voxel_m, Field{"voxel_m", "edge of a voxel of the map", above(0, 10), "voxel (mm)"});
    visit(s.place,
          Field{"place", "voxelise moved points, or move the centres of sensor-frame voxels"});
    visit(
        s.map_origin_m,
        Field{
            "map_origin_m",
            "origin of the map in the scene's world; default: drawn by the seed, within a voxel"});
    visit(s.map_yaw_deg,
          Field{"map_yaw_deg", "turn of the map frame in the scene's world", {-360, 360}});
    visit(s.detect,
          Field{"detect", "classes that become detections; default: as the class file says"});
    visit(s.perception, later({"perception", "where detections come from"}));
    visit(s.methods, Field{"methods", "at least one, by name: letters, digits, _ and -"});
    visit(s.fusion, Field{"fusion", "how observations change the map"});
    visit(s.occupancy, later({"occupancy", "free space in the map"}));
    visit(s.calibration, later({"calibration", "what the methods believe of the cameras"}));
    visit(s.localization, later({"localization", "where the robot believes it is"}));
    visit(s.faults, Field{"faults", "doses of the faults"});
    visit(s.score, Field{"score", "how maps are scored"});
    visit(s.sweep, Field{"sweep",
                         "values of the leaf at a path, or kinds of a choice there; several paths "
                         "make a grid"});
    visit(s.sampling, Field{.key = "sampling",
                            .meaning = "which points of the swept paths are tried; but for a grid, "
                                       "a path with numbers has a range, [LOW, HIGH], and one with "
                                       "names a list (docs/scoring.md)",
                            .later = true,
                            .swept = false});
    visit(s.picture_view,
          Field{.key = "picture_view",
                .meaning = "view of the pictures: [ex, ey, ez, tx, ty, tz, vfov_deg], eye and "
                           "target in the world in metres, the angle may be left out; default: an "
                           "overview, and where most errors are",
                .swept = false});
    visit(s.class_titles,
          Field{.key = "class_titles",
                .meaning = "names of classes in figures, and in tables for papers, as {tv: TV set}",
                .swept = false});
  }
  bool operator==(const Study&) const = default;
};

/// Reads a study file. `overrides` are `path=value` texts of flags, applied after the file in their
/// order; a value is YAML (`faults.pose.sigma_xy_m=0.02`, `sweep.voxel_m=[0.05, 0.1]`, `sweep={}`),
/// a path may be short (whole_path). Every value and every cell of the sweep is checked, and that
/// trajectory, cameras and lidar do not stand beside a recording. Throws Error "FILE:LINE:
/// key.path: what; mend".
[[nodiscard]] Study load_study(const std::filesystem::path& file,
                               const std::vector<std::string>& overrides = {});

/// As load_study, from the text of a file; `file` names it in errors and gives name and base
/// folder.
[[nodiscard]] Study parse_study(const std::string& text, const std::filesystem::path& file,
                                const std::vector<std::string>& overrides = {});

/// Sets the leaf at a dotted path (`methods.erosion.segmentation.erosion.radius_px`) from YAML
/// text, and checks its type and range; what must hold between leaves is checked by `check`. Throws
/// Error naming the path, and then leaves the study as it was.
void set_leaf(Study& study, std::string_view path, const std::string& yaml_value);

/// The same for `path=value` texts of flags, in their order; a path may be short (whole_path).
void set_leaves(Study& study, const std::vector<std::string>& overrides);

/// As set_leaf, for a value of a sweep: a choice that is of the kind already keeps its parameters.
void set_dose(Study& study, std::string_view path, const std::string& yaml_value);

/// Every leaf that is set, by dotted path, as its canonical text, and every choice as its kind; not
/// the sweep.
[[nodiscard]] std::map<std::string, std::string> leaf_texts(const Study& study);

/// The path of the only leaf that ends in ".NAME", where the first part of `name` is no key of a
/// study; else `name` itself. Throws Error, with their paths, where several end so.
[[nodiscard]] std::string whole_path(const Study& study, const std::string& name);

/// Canonical text of the leaf at a dotted path; an unset optional leaf is "-", a choice its kind.
/// Throws as set_leaf.
[[nodiscard]] std::string leaf_text(Study study, std::string_view path);

/// Throws an Error that states where the value at a dotted path was written, and `problem`.
using Blame = std::function<void(std::string_view path, const std::string& problem)>;

/// Throws through `blame` when leaves do not fit each other, for the study and each cell of its
/// sweep; without it, Error naming the key.
void check(const Study& study, const Blame& blame);
void check(const Study& study);

/// The resolved configuration: every key, defaults included, in the order of the reference. The
/// same study gives the same bytes; parsing them gives an equal study. Holds no path that the study
/// did not hold.
[[nodiscard]] std::string to_yaml(const Study& study);

/// As to_yaml, for a trial's key: leaves marked `later` (Field) are left out at their defaults, so
/// that results stored before those leaves existed keep their keys.
[[nodiscard]] std::string to_key_yaml(const Study& study);

/// What of a configuration decides how its method maps, as a study that `map --study` takes, beside
/// the folder that is mapped.
[[nodiscard]] std::string method_yaml(const Study& config);

/// Table of all keys in Markdown: type, unit, default, range, meaning. docs/study_reference.md is
/// this text.
[[nodiscard]] std::string config_reference();

/// `path` if absolute, otherwise below the study's base folder.
[[nodiscard]] std::filesystem::path resolve_path(const Study& study, const std::string& path);

/// The absolute path of a word of a command that names a file, which is absolute or lies beside the
/// study.
[[nodiscard]] std::optional<std::filesystem::path> file_beside(const Study& study,
                                                               const std::string& word);

/// Depth frames per second of a study's recording: its own, else where the study doses the time
/// offset the least multiple of the colour camera's that is 30 or more, so that without an offset
/// their stamps agree, else those of the colour camera.
[[nodiscard]] double depth_rate(const Study& study);

/// True when the study's robot drives on wheels, as one that explores does.
[[nodiscard]] bool on_wheels(const Study& study);

/// True when the study's robot chooses its own way, in some cell of the sweep at least.
[[nodiscard]] bool explores(const Study& study);

/// The robot's MJCF: `robot`, or robot.xml beside the scene. Needs `scene` or `robot`.
[[nodiscard]] std::filesystem::path robot_path(const Study& study);

/// How a method places its observations: its own `place`, or the study's.
[[nodiscard]] Place place_of(const Study& study, const MethodSettings& method);

/// A method's own fusion, or the study's.
[[nodiscard]] DrawnFusion fusion_of(const DrawnFusion& of_study, const MethodFusion& of_method);

/// In the order of the study.
[[nodiscard]] std::vector<std::string> method_names(const Study& study);

/// What a method or a class is called in figures, and in tables for papers: its title or else its
/// name.
[[nodiscard]] std::string method_title(const Study& study, const std::string& name);
[[nodiscard]] std::string class_title(const Study& study, const std::string& name);

/// The study without titles, which decide nothing.
[[nodiscard]] Study without_titles(Study study);

/// The study with one of its methods alone, whose fusion becomes the study's, and no sweep.
[[nodiscard]] Study with_method(Study study, const std::string& method);

/// How the first method of a study maps; `table` has the study's detected classes. Throws Error as
/// for_classes.
[[nodiscard]] Mapping mapping_of(const Study& study, const ClassTable& table);

/// Whether some method of a study reads colour images.
[[nodiscard]] bool reads_colour(const Study& study);

/// The field of the leaf at a dotted path. Throws as set_leaf.
[[nodiscard]] Field field_of(Study study, std::string_view path);

/// Whether the leaf at a dotted path is a whole number. Throws as set_leaf.
[[nodiscard]] bool is_whole_number(Study study, std::string_view path);

/// The study of one of its scenes: their keys are its own, and it has no scenes and does not sweep
/// them. Throws Error when it has no scene of the name.
[[nodiscard]] Study with_scene(Study study, const std::string& name);

/// The study of each of its scenes that are swept, by name; of a study without scenes itself, under
/// no name.
[[nodiscard]] std::vector<std::pair<std::string, Study>> studies_of_scenes(const Study& study);

/// The only one of them. Throws Error where there are several.
[[nodiscard]] Study study_of_only_scene(const Study& study);

/// True when the leaf decides what a recording holds (scene, trajectory, cameras, ...), so that a
/// sweep over it needs a recording for each of its values.
[[nodiscard]] bool decides_recording(std::string_view path);

}  // namespace mapscore::eval
