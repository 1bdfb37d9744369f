// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/fields.hpp"
#include "eval/experiment/study.hpp"

#include <array>
#include <string_view>

namespace mapscore::eval {

// Every parameter of a study, once. Loader, flags, sweep, resolved configuration and reference
// follow.

template <>
inline constexpr auto kNames<Place> = std::to_array<std::string_view>({"points", "voxels"});
template <>
inline constexpr auto kNames<SeedRule> = std::to_array<std::string_view>({"box_centre",
                                                                          "mask_centroid"});
template <>
inline constexpr auto kNames<NoiseAt> = std::to_array<std::string_view>({"base", "odom"});
template <>
inline constexpr auto kNames<CovarianceUse> = std::to_array<std::string_view>({"diagonal", "full"});
template <>
inline constexpr auto kNames<sim::PoseNoiseKind> = std::to_array<std::string_view>({"white", "walk",
                                                                                    "constant"});
template <>
inline constexpr auto kNames<PoseStamp> = std::to_array<std::string_view>({"depth", "color"});
template <>
inline constexpr auto kNames<sim::DepthPreset> = std::to_array<std::string_view>({"ideal", "astra",
                                                                                  "kinect_v1"});
template <>
inline constexpr auto kNames<sim::LabelPreset> = std::to_array<std::string_view>({"ideal",
                                                                                  "typical"});
template <>
inline constexpr auto kNames<ScoreUnit> = std::to_array<std::string_view>({"map", "frame"});

void fields(auto&& visit, Of<TrajectorySettings> auto& s) {
  visit(Field{"waypoints_m_deg", "x, y and heading of each waypoint, in the scene's world"},
        s.waypoints_m_deg);
  visit(Field{"speed_mps", "speed along a leg", above(0, 100)}, s.speed_mps);
  visit(Field{"turn_rate_dps", "greatest turn rate; a leg that turns more takes longer",
              above(0, 36000)},
        s.turn_rate_dps);
  visit(Field{"frames_per_s", "frames recorded in a second of the drive", above(0, 1000)},
        s.frames_per_s);
  visit(Field{"depth_frames_per_s",
              "depth images in a second of the drive; default: 30 where faults.time_offset_ms is "
              "dosed, else frames_per_s",
              above(0, 1000)},
        s.depth_frames_per_s);
  visit(Field{"max_frames", "stop after so many frames; 0: at the last waypoint", at_least(0)},
        s.max_frames);
}

void fields(auto&& visit, Of<CameraSettings> auto& s) {
  visit(Field{"width_px", "width of colour and depth images; the fields of view stay", {16, 8192}},
        s.width_px);
  visit(Field{"height_px", "height of colour and depth images", {16, 8192}}, s.height_px);
  visit(Field{"range_min_m", "least planar depth that the depth camera returns", above(0, 13)},
        s.range_min_m);
  visit(Field{"range_max_m", "greatest planar depth that the depth camera returns", above(0, 13)},
        s.range_max_m);
  visit(Field{"shadows", "draw shadows in the colour images"}, s.shadows);
}

void fields(auto&&, Of<DirectSettings> auto&) {}

void fields(auto&& visit, Of<ErosionSettings> auto& s) {
  visit(Field{"radius_px", "radius of the disc that erodes the mask", {0, 1000}}, s.radius_px);
}

void fields(auto&& visit, Of<RegionGrowingSettings> auto& s) {
  visit(Field{"radius_factor",
              "search radius over voxel edge: 1 in the paper, 0.5 in its released code",
              above(0, 10)},
        s.radius_factor);
  visit(Field{"released", "compare distances in single precision, as the released code does"},
        s.released);
  visit(Field{"seed", "pixel whose point the growing starts from"}, s.seed);
}

void fields(auto&& visit, Of<MethodSettings> auto& s) {
  visit(Field{"segmentation", "from a detection and a registered cloud to points", {}, true},
        s.segmentation);
  visit(Field{"place", "as the study's `place`, for this method alone"}, s.place);
}

void fields(auto&& visit, Of<BlendSettings> auto& s) {
  visit(Field{"K", "weight of what the map held before", {.low = 0, .high = 1, .open_high = true}},
        s.K);
  visit(Field{"N", "draws from the pose belief for an observation", {1, 100000}}, s.N);
  visit(Field{"noise_at", "draw about the robot (base) or the odom origin (as the paper)"},
        s.noise_at);
  visit(Field{"covariance", "part of the pose covariance that is drawn from"}, s.covariance);
}

void fields(auto&& visit, Of<MisregistrationSettings> auto& s) {
  visit(Field{"magnitude_m",
              "shift of the believed depth camera, its direction drawn by the seed",
              {0, 1}},
        s.magnitude_m);
  visit(
      Field{"angle_deg", "turn of the believed depth camera, its axis drawn by the seed", {0, 180}},
      s.angle_deg);
  visit(Field{"translation_m",
              "shift in the colour camera's optical frame; excludes magnitude_m",
              {-10, 10}},
        s.translation_m);
  visit(Field{"rotation_deg",
              "rotation vector in the colour camera's optical frame; excludes angle_deg",
              {-180, 180}},
        s.rotation_deg);
  visit(Field{"focal_error_percent",
              "error of the believed focal length of the colour camera",
              {.low = -100, .high = 100, .open_low = true}},
        s.focal_error_percent);
  visit(Field{"principal_point_px",
              "error of the believed principal point of the colour camera",
              {-1000, 1000}},
        s.principal_point_px);
}

void fields(auto&& visit, Of<MountSettings> auto& s) {
  visit(
      Field{"magnitude_m", "shift of the believed mount, its direction drawn by the seed", {0, 1}},
      s.magnitude_m);
  visit(Field{"angle_deg", "turn of the believed mount, its axis drawn by the seed", {0, 180}},
        s.angle_deg);
  visit(Field{"translation_m",
              "shift in the depth camera's optical frame; excludes magnitude_m",
              {-10, 10}},
        s.translation_m);
  visit(Field{"rotation_deg",
              "rotation vector in the depth camera's optical frame; excludes angle_deg",
              {-180, 180}},
        s.rotation_deg);
}

void fields(auto&& visit, Of<PoseNoiseSettings> auto& s) {
  visit(Field{"sigma_xy_m", "standard deviation of x and of y of base_footprint", {0, 100}},
        s.sigma_xy_m);
  visit(Field{"sigma_z_m", "standard deviation of z", {0, 100}}, s.sigma_z_m);
  visit(Field{"sigma_roll_pitch_deg", "standard deviation of roll and of pitch", {0, 180}},
        s.sigma_roll_pitch_deg);
  visit(Field{"sigma_yaw_deg", "standard deviation of yaw", {0, 180}}, s.sigma_yaw_deg);
  visit(Field{"covariance_m_rad",
              "6x6 covariance of x y z roll pitch yaw in place of the standard deviations"},
        s.covariance_m_rad);
  visit(Field{"sigma_scale",
              "multiplies the standard deviations (the covariance by its square): the dose in one "
              "number",
              {0, 1000}},
        s.sigma_scale);
  visit(Field{"kind", "drawn anew for each frame, summed up as a random walk, or drawn once"},
        s.kind);
  visit(Field{"reported_scale", "covariance reported to the mapper over the true one", {0, 1000}},
        s.reported_scale);
  visit(Field{.key = "stamp",
              .meaning = "the image at whose stamp the pose of a frame is looked up",
              .unkeyed = "depth"},
        s.stamp);
}

void fields(auto&& visit, Of<DepthFaultSettings> auto& s) {
  constexpr Range kDose{0, 100}, kMetres{0, 100};
  visit(Field{.key = "preset",
              .meaning = "depth camera that the other keys start from; ideal: no fault",
              .unkeyed = "ideal"},
        s.preset);
  visit(Field{.key = "scale", .meaning = "multiplies every dose", .range = kDose, .unkeyed = "1"},
        s.scale);
  visit(Field{"axial", "dose: noise along the view, over the published", kDose}, s.axial);
  visit(Field{"lateral", "dose: noise across the view, over the published", kDose}, s.lateral);
  visit(Field{"quantisation", "dose: step of the disparity over subpixel_px", kDose},
        s.quantisation);
  visit(Field{"grazing", "dose: loss at grazing angles", kDose}, s.grazing);
  visit(Field{"shadow", "dose: the projector's shadow, baseline over baseline_m", kDose}, s.shadow);
  visit(Field{"flying", "dose: flying pixels at depth edges over flying_share", kDose}, s.flying);
  visit(Field{"range", "dose: chance that what is measured out of range is dropped", kDose},
        s.range);
  visit(Field{"axial_base_m", "standard deviation along z at 0.4 m", {0, 1}}, s.axial_base_m);
  visit(Field{"axial_growth_per_m", "its growth with (z - 0.4 m)^2", {0, 1}}, s.axial_growth_per_m);
  visit(Field{"lateral_px", "standard deviation across the view", kDose}, s.lateral_px);
  visit(Field{"baseline_m", "projector to the right of the depth camera", above(0, 1)},
        s.baseline_m);
  visit(Field{"subpixel_px", "step of the disparity", above(0, 10)}, s.subpixel_px);
  visit(Field{"grazing_from_deg", "angle of incidence where losses begin", {0, 90}},
        s.grazing_from_deg);
  visit(Field{"grazing_to_deg", "angle of incidence where nothing comes back", {0, 90}},
        s.grazing_to_deg);
  visit(Field{"flying_share", "share of the pixels beside a depth edge that fly", {0, 1}},
        s.flying_share);
  visit(Field{"range_min_m", "least planar depth that is measured", kMetres}, s.range_min_m);
  visit(Field{"range_max_m", "greatest planar depth that is measured", kMetres}, s.range_max_m);
}

void fields(auto&& visit, Of<LabelFaultSettings> auto& s) {
  constexpr Range kShare{0, 1}, kPixels{1, 1000};
  visit(Field{.key = "preset",
              .meaning = "segmentation that the other keys start from; ideal: no fault",
              .unkeyed = "ideal"},
        s.preset);
  visit(
      Field{.key = "scale", .meaning = "multiplies every dose", .range = {0, 100}, .unkeyed = "1"},
      s.scale);
  visit(Field{"boundary_px", "dose: masks grown, or shrunk below 0", {-1000, 1000}}, s.boundary_px);
  visit(Field{"ragged_px", "dose: standard deviation of the boundary's place", {0, 1000}},
        s.ragged_px);
  visit(Field{"miss", "dose: chance to miss an instance of no size", kShare}, s.miss);
  visit(Field{"confusion", "dose: chance of a wrong class, even over the detected ones", kShare},
        s.confusion);
  visit(Field{"scores", "dose: how much of 1 - score is kept; 0: every score is 1", kShare},
        s.scores);
  visit(Field{"holes", "dose: share of a mask that lies in holes", kShare}, s.holes);
  visit(Field{"islands", "dose: share of a mask's surroundings that islands cover", kShare},
        s.islands);
  visit(Field{"confusion_matrix",
              "in place of confusion: row by true class, column by named class, over the detected "
              "classes in their order; rows add up to 1",
              kShare},
        s.confusion_matrix);
  visit(Field{"ragged_length_px", "pitch of the boundary's waves", kPixels}, s.ragged_length_px);
  visit(Field{"miss_area_px", "pixels of an instance at which its chance is half of miss",
              above(0, 1e9)},
        s.miss_area_px);
  visit(Field{"disc_radius_px", "radius of holes and islands", kPixels}, s.disc_radius_px);
  visit(Field{"island_reach_px", "islands lie within a quarter of it and all of it", kPixels},
        s.island_reach_px);
  visit(Field{"score_mean", "mean score; default: the chance of a right class", kShare},
        s.score_mean);
  visit(Field{"score_concentration", "of the Beta distribution of scores", above(0, 1e6)},
        s.score_concentration);
}

void fields(auto&& visit, Of<FaultSettings> auto& s) {
  visit(Field{"misregistration", "wrong depth-to-colour calibration: moves labels"},
        s.misregistration);
  visit(Field{"mount", "wrong camera-to-base calibration: moves points"}, s.mount);
  visit(Field{"pose", "wrong localisation"}, s.pose);
  visit(
      Field{.key = "time_offset_ms",
            .meaning = "pair each colour image with the depth image nearest to its stamp plus this",
            .range = {-10000, 10000},
            .unkeyed = "0"},
      s.time_offset_ms);
  visit(
      Field{.key = "depth", .meaning = "noise of the depth camera: moves points", .unkeyed = "{}"},
      s.depth);
  visit(Field{.key = "labels",
              .meaning = "errors of the 2D segmentation: moves labels",
              .unkeyed = "{}"},
        s.labels);
}

void fields(auto&& visit, Of<ScoreSettings> auto& s) {
  visit(Field{"unit", "score the fused map, or each frame's observation against its own truth"},
        s.unit);
  visit(
      Field{
          "at_s",
          "with unit map, where the scene moves: the time whose surfaces a map is scored against"},
      s.at_s);
  visit(Field{"threshold",
              "least probability of a predicted voxel; auto: half of what a first full hit gives",
              {0, 1}},
        s.threshold);
  visit(Field{"min_samples", "depth samples that make a voxel visible", {1, 1000000}},
        s.min_samples);
  visit(Field{"epsilon_m", "widening of voxels in the surface test", {0, 0.1}}, s.epsilon_m);
  visit(Field{"tolerances", "tolerances of the match, in voxels; 0 is always counted", {0, 5}},
        s.tolerances);
  visit(Field{"distances_m", "distances of the F-score", above(0, 10)}, s.distances_m);
  visit(Field{.key = "instances",
              .meaning = "score instances too, the connected pieces of each class: PQ and AP",
              .unkeyed = "false"},
        s.instances);
}

void fields(auto&& visit, Of<Study> auto& s) {
  visit(Field{"name", "name of the study; default: the file's stem"}, s.name);
  visit(Field{"seed", "seed of every random stream"}, s.seed);
  visit(Field{"seeds", "repetitions of each cell and method", {1, 100000}}, s.seeds);
  visit(Field{"scene", "MJCF of the scene, from the study file's folder"}, s.scene);
  visit(Field{"classes", "class file; default: SCENE.classes.yaml beside the scene"}, s.classes);
  visit(Field{"robot", "MJCF of the robot; default: robot.xml beside the scene"}, s.robot);
  visit(Field{"motion", "motion file (CSV): how joints of the scene move; needs a scene"},
        s.motion);
  visit(Field{"recording", "folder of a recording to replay in place of rendering one"},
        s.recording);
  visit(Field{"trajectory", "drive of the robot"}, s.trajectory);
  visit(Field{"cameras", "the RGB-D camera"}, s.cameras);
  visit(Field{"voxel_m", "edge of a voxel of the map", above(0, 10)}, s.voxel_m);
  visit(Field{"place", "voxelise moved points, or move the centres of sensor-frame voxels"},
        s.place);
  visit(Field{"map_origin_m",
              "origin of the map in the scene's world; default: drawn by the seed, "
              "within a voxel"},
        s.map_origin_m);
  visit(Field{"map_yaw_deg", "turn of the map frame in the scene's world", {-360, 360}},
        s.map_yaw_deg);
  visit(Field{"detect", "classes that become detections; default: as the class file says"},
        s.detect);
  visit(Field{"methods", "at least one, by name: letters, digits, _ and -"}, s.methods);
  visit(Field{"fusion", "how observations change the map"}, s.fusion);
  visit(Field{"faults", "doses of the faults"}, s.faults);
  visit(Field{"score", "how maps are scored"}, s.score);
  visit(Field{"sweep", "values of the leaf at a path; several paths make a grid"}, s.sweep);
  visit(Field{"picture_view",
              "view of the pictures: [ex, ey, ez, tx, ty, tz, vfov_deg], eye and target in the "
              "world in metres, the angle may be left out; default: an overview, and where most "
              "errors are"},
        s.picture_view);
}

}  // namespace mapscore::eval
