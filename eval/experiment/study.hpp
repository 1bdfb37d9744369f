// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/segmentation.hpp"
#include "eval/experiment/drive_settings.hpp"
#include "eval/experiment/fusion_settings.hpp"
#include "eval/experiment/localization_settings.hpp"
#include "eval/experiment/occupancy_settings.hpp"
#include "eval/experiment/perception_settings.hpp"
#include "eval/experiment/refinement_settings.hpp"
#include "sim/faults/depth_dose.hpp"
#include "sim/faults/label_dose.hpp"
#include "sim/faults/pose_fault.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace mapscore::eval {

// The structs below mirror the study file key by key, in its units: the unit is the member's
// suffix, and the conversion to SI happens where they are turned into types of core and sim. Keys,
// ranges and meanings stand in study_fields.hpp.

struct TrajectorySettings {
  std::vector<std::array<double, 3>> waypoints_m_deg;  ///< x, y, heading
  double speed_mps = 0.4;
  double turn_rate_dps = 40;
  double frames_per_s = 2;
  std::optional<double> depth_frames_per_s;  ///< empty: see depth_rate
  int max_frames = 0;
  DriveChoice drive;

  bool operator==(const TrajectorySettings&) const = default;
};

struct CameraSettings {
  int width_px = 640, height_px = 480;
  double range_min_m = 0.6, range_max_m = 8;
  bool shadows = false;
  std::optional<double> height_m{}, pan_deg{}, tilt_deg{};  ///< empty: as the robot has it

  bool operator==(const CameraSettings&) const = default;
};

/// How an observation reaches the map's lattice: its points moved by the pose, or its voxels'
/// centres.
enum class Place { points, voxels };

struct DirectSettings {
  static constexpr std::string_view kKind = "direct";
  static constexpr std::string_view kMeaning = "every point of the mask";
  bool operator==(const DirectSettings&) const = default;
};

struct ErosionSettings {
  static constexpr std::string_view kKind = "erosion";
  static constexpr std::string_view kMeaning = "erode the mask, then direct";
  int radius_px = 5;
  bool operator==(const ErosionSettings&) const = default;
};

struct RegionGrowingSettings {
  static constexpr std::string_view kKind = "region_growing";
  static constexpr std::string_view kMeaning =
      "grow voxels from a seed point (algorithm 1 of the paper)";
  double radius_factor = 1;
  bool released = false;
  SeedRule seed = SeedRule::box_centre;
  bool kd_tree = false;
  bool operator==(const RegionGrowingSettings&) const = default;
};

struct EdgeAlignedSettings {
  static constexpr std::string_view kKind = "edge_aligned";
  static constexpr std::string_view kMeaning =
      "fit a frame's masks to its depth edges, then vote on the depth surface";
  double search_px = 40, reach_px = 3;
  bool operator==(const EdgeAlignedSettings&) const = default;
};

using SegmentationSettings =
    std::variant<DirectSettings, ErosionSettings, RegionGrowingSettings, EdgeAlignedSettings>;

struct MethodSettings {
  std::string name;  ///< letters, digits, _ and -
  SegmentationSettings segmentation;
  std::optional<Place> place;  ///< empty: the study's
  MethodFusionSettings fusion{};
  RefinementSettings refinement{};

  bool operator==(const MethodSettings&) const = default;
};

/// T_believed_color_depth = E * T_color_depth, and wrong intrinsics of the colour camera.
struct MisregistrationSettings {
  double magnitude_m = 0, angle_deg = 0;  ///< direction drawn by the seed, in the image plane
  std::array<double, 3> translation_m{}, rotation_deg{};
  double focal_error_percent = 0;
  std::array<double, 2> principal_point_px{};

  bool operator==(const MisregistrationSettings&) const = default;
};

/// T_believed_base_depth = T_base_depth * M.
struct MountSettings {
  double magnitude_m = 0, angle_deg = 0;
  std::array<double, 3> translation_m{}, rotation_deg{};

  bool operator==(const MountSettings&) const = default;
};

/// The image at whose stamp the pose of a frame is looked up.
enum class PoseStamp { depth, color };

/// T_believed = T_true * Exp(xi), xi ~ N(0, E).
struct PoseNoiseSettings {
  double sigma_xy_m = 0, sigma_z_m = 0, sigma_roll_pitch_deg = 0, sigma_yaw_deg = 0;
  std::optional<std::array<std::array<double, 6>, 6>> covariance_m_rad;  ///< in place of the sigmas
  double sigma_scale = 1;  ///< of every standard deviation
  sim::PoseNoiseKind kind = sim::PoseNoiseKind::white;
  double reported_scale = 1;  ///< reported covariance over the true one
  PoseStamp stamp = PoseStamp::depth;

  bool operator==(const PoseNoiseSettings&) const = default;
};

/// A ready-made depth camera, and what differs from it; members as those of sim::DepthDose.
struct DepthFaultSettings {
  sim::DepthPreset preset = sim::DepthPreset::ideal;
  double scale = 1;  ///< of every dose
  std::optional<double> axial, lateral, quantisation, grazing, shadow, flying, range;
  std::optional<double> axial_base_m, axial_growth_per_m, lateral_px, baseline_m, subpixel_px;
  std::optional<double> grazing_from_deg, grazing_to_deg, flying_share, range_min_m, range_max_m;

  bool operator==(const DepthFaultSettings&) const = default;
};

/// A ready-made segmentation, and what differs from it; members as those of sim::LabelDose.
struct LabelFaultSettings {
  sim::LabelPreset preset = sim::LabelPreset::ideal;
  double scale = 1;  ///< of every dose
  std::optional<double> boundary_px, ragged_px, miss, confusion, scores, holes, islands;
  std::optional<std::vector<std::vector<double>>> confusion_matrix;  ///< in place of `confusion`
  std::optional<double> ragged_length_px, miss_area_px, disc_radius_px, island_reach_px;
  std::optional<double> score_mean, score_concentration;

  bool operator==(const LabelFaultSettings&) const = default;
};

struct FaultSettings {
  MisregistrationSettings misregistration;
  MountSettings mount;
  PoseNoiseSettings pose;
  double time_offset_ms = 0;  ///< of the depth image that a colour image is paired with
  DepthFaultSettings depth;
  LabelFaultSettings labels;
  LidarFaultSettings lidar;

  bool operator==(const FaultSettings&) const = default;
};

/// A number, or `auto` (empty).
struct AutoNumber {
  std::optional<double> value;
  bool operator==(const AutoNumber&) const = default;
};

enum class ScoreUnit { map, frame };

struct ScoreSettings {
  ScoreUnit unit = ScoreUnit::map;
  std::optional<double> at_s;  ///< empty: nothing moves, or each frame at its own time
  AutoNumber threshold;
  int min_samples = 1;
  double epsilon_m = 0.0005;
  std::vector<int> tolerances{0, 1};
  std::vector<double> distances_m{0.01, 0.02, 0.05, 0.1};
  bool instances = false;
  bool thin = false;

  bool operator==(const ScoreSettings&) const = default;
};

/// Names of the classes that become detections, or all of them.
struct DetectedSet {
  bool all = false;
  std::vector<std::string> classes;
  bool operator==(const DetectedSet&) const = default;
};

/// One swept leaf. Values are canonical texts (0.010 is 0.01), in the order of the file.
struct SweepAxis {
  std::string path;
  std::vector<std::string> values;
  bool operator==(const SweepAxis&) const = default;
};

/// One study file (docs/study_reference.md lists its keys). Paths stay as they are written; those
/// that are relative start at `base_folder`, which is not part of the file.
struct Study {
  std::string name;
  std::uint64_t seed = 1;
  int seeds = 1;
  std::optional<std::string> scene, classes, robot, motion, recording;
  TrajectorySettings trajectory;
  CameraSettings cameras;
  LidarStudySettings lidar;
  double voxel_m = 0.05;
  Place place = Place::points;
  std::optional<std::array<double, 3>> map_origin_m;  ///< empty: drawn by the seed, within a voxel
  double map_yaw_deg = 0;
  std::optional<DetectedSet> detect;  ///< empty: as the class file says
  PerceptionSettings perception;
  std::vector<MethodSettings> methods;
  FusionSettings fusion;
  OccupancySettings occupancy;
  LocalizationSettings localization;
  FaultSettings faults;
  ScoreSettings score;
  std::vector<SweepAxis> sweep;
  std::optional<std::vector<double>> picture_view;  ///< see view_of_numbers; changes no result

  std::filesystem::path base_folder;

  bool operator==(const Study&) const = default;
};

/// Reads a study file. `overrides` are `path=value` texts of flags, applied after the file in their
/// order; a value is YAML (`faults.pose.sigma_xy_m=0.02`, `sweep.voxel_m=[0.05, 0.1]`, `sweep={}`).
/// Every value and every cell of the sweep is checked. Throws Error "FILE:LINE: key.path: what;
/// mend".
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

/// The same for `path=value` texts of flags, in their order.
void set_leaves(Study& study, const std::vector<std::string>& overrides);

/// Canonical text of the leaf at a dotted path; an unset optional leaf is "-". Throws as set_leaf.
[[nodiscard]] std::string leaf_text(const Study& study, std::string_view path);

/// Throws Error naming the key when leaves do not fit each other, for the study and each cell of
/// its sweep.
void check(const Study& study);

/// The resolved configuration: every key, defaults included, in the order of the reference. The
/// same study gives the same bytes; parsing them gives an equal study. Holds no path that the study
/// did not hold.
[[nodiscard]] std::string to_yaml(const Study& study);

/// As to_yaml, for a trial's key: without the leaves that came after the first keys and stand at
/// what was always done.
[[nodiscard]] std::string to_key_yaml(const Study& study);

/// Table of all keys in Markdown: type, unit, default, range, meaning. docs/study_reference.md is
/// this text.
[[nodiscard]] std::string config_reference();

/// `path` if absolute, otherwise below the study's base folder.
[[nodiscard]] std::filesystem::path resolve_path(const Study& study, const std::string& path);

/// Depth frames per second of a study's recording: its own, else 30 where the study doses the time
/// offset, else those of the colour camera.
[[nodiscard]] double depth_rate(const Study& study);

/// True when the study's robot drives on wheels.
[[nodiscard]] bool on_wheels(const Study& study);

/// The robot's MJCF: `robot`, or robot.xml beside the scene. Needs `scene` or `robot`.
[[nodiscard]] std::filesystem::path robot_path(const Study& study);

/// How a method places its observations: its own `place`, or the study's.
[[nodiscard]] Place place_of(const Study& study, const MethodSettings& method);

/// True when the leaf decides what a recording holds (scene, trajectory, cameras, ...), so that a
/// sweep over it needs a recording for each of its values.
[[nodiscard]] bool decides_recording(std::string_view path);

}  // namespace mapscore::eval
