// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/drive_fields.hpp"
#include "eval/experiment/fault_fields.hpp"
#include "eval/experiment/fields.hpp"
#include "eval/experiment/fusion_fields.hpp"
#include "eval/experiment/occupancy_fields.hpp"
#include "eval/experiment/perception_fields.hpp"
#include "eval/experiment/refinement_fields.hpp"
#include "eval/experiment/study.hpp"

#include <array>
#include <string_view>

namespace mapscore::eval {

// Every parameter of a study, once; those of faults in fault_fields.hpp. Loader, flags, sweep,
// resolved configuration and reference follow.

template <>
inline constexpr auto kNames<Place> = std::to_array<std::string_view>({"points", "voxels"});
template <>
inline constexpr auto kNames<SeedRule> =
    std::to_array<std::string_view>({"box_centre", "mask_centroid", "largest_piece", "depth_mode"});
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
  visit(Field{.key = "drive",
              .meaning = "how the robot gets from waypoint to waypoint",
              .unkeyed = "poses"},
        s.drive);
}

void fields(auto&& visit, Of<CameraSettings> auto& s) {
  visit(Field{"width_px", "width of colour and depth images; the fields of view stay", {16, 8192}},
        s.width_px);
  visit(Field{"height_px", "height of colour and depth images", {16, 8192}}, s.height_px);
  visit(Field{"range_min_m", "least planar depth that the depth camera returns", above(0, 13)},
        s.range_min_m);
  visit(Field{"range_max_m", "greatest planar depth that the depth camera returns", above(0, 13)},
        s.range_max_m);
  visit(Field{"height_m", "height of both cameras above the floor; default: the robot's",
              above(0, 10)},
        s.height_m);
  visit(Field{"pan_deg", "turn of both cameras to the left; default: the robot's", {-180, 180}},
        s.pan_deg);
  visit(Field{"tilt_deg", "turn of both cameras downwards; default: the robot's", {-90, 90}},
        s.tilt_deg);
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
  visit(Field{.key = "kd_tree",
              .meaning = "search by a KD-tree, as the paper does: the same result, more slowly",
              .unkeyed = "false"},
        s.kd_tree);
}

void fields(auto&& visit, Of<EdgeAlignedSettings> auto& s) {
  visit(Field{"search_px", "largest displacement of the masks that is looked for", {0, 200}},
        s.search_px);
  visit(Field{"reach_px", "how far votes spread over a depth surface", above(0, 100)}, s.reach_px);
}

void fields(auto&& visit, Of<MethodSettings> auto& s) {
  visit(Field{"segmentation", "from a detection and a registered cloud to points", {}, true},
        s.segmentation);
  visit(Field{"place", "as the study's `place`, for this method alone"}, s.place);
  visit(Field{.key = "fusion",
              .meaning = "how this method's observations change the map",
              .unkeyed = "study"},
        s.fusion);
  visit(Field{.key = "refinement",
              .meaning = "what happens to this method's map before it is scored",
              .unkeyed = "none"},
        s.refinement);
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
  visit(Field{.key = "thin",
              .meaning = "count the voxels of thin parts (chair legs) by themselves too",
              .unkeyed = "false"},
        s.thin);
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
  visit(Field{.key = "lidar",
              .meaning = "the lidar, with trajectory.drive wheels; exact ranges are recorded",
              .unkeyed = "{}"},
        s.lidar);
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
  visit(Field{.key = "perception", .meaning = "where detections come from", .unkeyed = "labels"},
        s.perception);
  visit(Field{"methods", "at least one, by name: letters, digits, _ and -"}, s.methods);
  visit(Field{"fusion", "how observations change the map"}, s.fusion);
  visit(Field{.key = "occupancy", .meaning = "free space in the map", .unkeyed = "{}"},
        s.occupancy);
  visit(Field{.key = "localization", .meaning = "where the robot believes it is", .unkeyed = "{}"},
        s.localization);
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
