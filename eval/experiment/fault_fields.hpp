// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/fields.hpp"
#include "eval/experiment/localization_fields.hpp"
#include "eval/experiment/study.hpp"

#include <array>
#include <string_view>

namespace mapscore::eval {

// Every parameter of a study's faults, once; see study_fields.hpp.

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
  visit(Field{.key = "lidar",
              .meaning = "noise of the lidar: moves the poses of the particle filter",
              .unkeyed = "{}"},
        s.lidar);
}

}  // namespace mapscore::eval
