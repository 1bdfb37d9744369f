// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/fields.hpp"
#include "eval/experiment/localization_settings.hpp"

#include <array>
#include <string_view>

namespace mapscore::eval {

// Every parameter of a study's localisation, once; see study_fields.hpp.

template <>
inline constexpr auto kNames<PoseSource> = std::to_array<std::string_view>(
    {"gaussian", "truth", "odometry", "particle_filter", "trajectory"});
template <>
inline constexpr auto kNames<FilterStart> = std::to_array<std::string_view>({"tracking", "global"});
template <>
inline constexpr auto kNames<ScanModelKind> = std::to_array<std::string_view>({"likelihood_field",
                                                                               "beam"});
template <>
inline constexpr auto kNames<LidarPreset> = std::to_array<std::string_view>({"ideal",
                                                                             "rplidar_a2"});

void fields(auto&& visit, Of<OdometryNoiseSettings> auto& s) {
  constexpr Range kAlpha{0, 100};
  visit(Field{"alpha1", "variance of a turn by turn squared", kAlpha}, s.alpha1);
  visit(Field{"alpha2", "variance of a turn by way squared", kAlpha}, s.alpha2);
  visit(Field{"alpha3", "variance of the way by way squared", kAlpha}, s.alpha3);
  visit(Field{"alpha4", "variance of the way by turn squared", kAlpha}, s.alpha4);
}

void fields(auto&& visit, Of<ParticleFilterSettings> auto& s) {
  constexpr Range kCount{1, 1000000};
  visit(Field{.key = "start",
              .meaning = "about the true pose (tracking), or anywhere on the grid (global)",
              .unkeyed = "tracking"},
        s.start);
  visit(Field{"start_sigma_xy_m", "standard deviation of the start, x and y; default 0.1", {0, 10}},
        s.start_sigma_xy_m);
  visit(Field{"start_sigma_yaw_deg",
              "standard deviation of the start's heading; default 2.9",
              {0, 180}},
        s.start_sigma_yaw_deg);
  visit(Field{"least_particles", "however narrow the belief is", kCount}, s.least_particles);
  visit(Field{"most_particles", "however wide it is; those of a global start", kCount},
        s.most_particles);
  visit(Field{"kld_epsilon", "error of the belief that sets the number of particles", above(0, 1)},
        s.kld_epsilon);
  visit(Field{"update_way_m", "way after which a scan is used", {0, 10}}, s.update_way_m);
  visit(Field{"update_turn_deg", "turn after which a scan is used", {0, 360}}, s.update_turn_deg);
  visit(
      Field{.key = "scan_model", .meaning = "probability of a scan", .unkeyed = "likelihood_field"},
      s.scan_model);
  visit(Field{"beams", "of a scan that are used, at most", {1, 100000}}, s.beams);
  visit(Field{"sigma_hit_m", "standard deviation of a beam that hits what the grid shows",
              above(0, 10)},
        s.sigma_hit_m);
  visit(Field{"temper", "exponent of a scan's probability: its beams are not independent",
              above(0, 1)},
        s.temper);
}

void fields(auto&& visit, Of<LocalizationSettings> auto& s) {
  visit(Field{.key = "source",
              .meaning = "of the believed poses; gaussian: the true pose under faults.pose",
              .unkeyed = "gaussian"},
        s.source);
  visit(Field{"trajectory",
              "TUM lines of base_footprint in the scene's world, a 6x6 covariance behind each if "
              "known; for source trajectory"},
        s.trajectory);
  visit(Field{"grid",
              "grid of ROS's map_server (YAML) in the scene's world; default: cut from the scene "
              "at the lidar's height"},
        s.grid);
  visit(
      Field{"grid_resolution_m", "edge of a cell of a grid that is cut; default 0.02", {0.005, 1}},
      s.grid_resolution_m);
  visit(Field{.key = "odometry_noise",
              .meaning = "of the odometry, as sources odometry and particle_filter believe it",
              .unkeyed = "{}"},
        s.odometry_noise);
  visit(Field{.key = "filter", .meaning = "the particle filter", .unkeyed = "{}"}, s.filter);
}

void fields(auto&& visit, Of<LidarFaultSettings> auto& s) {
  visit(Field{.key = "preset",
              .meaning = "lidar that the other keys start from; ideal: no fault",
              .unkeyed = "ideal"},
        s.preset);
  visit(
      Field{.key = "scale", .meaning = "multiplies every dose", .range = {0, 100}, .unkeyed = "1"},
      s.scale);
  visit(Field{"sigma_m", "standard deviation of a range, the part that does not grow", {0, 10}},
        s.sigma_m);
  visit(Field{"sigma_per_metre", "standard deviation of a range by the range", {0, 1}},
        s.sigma_per_metre);
  visit(Field{"dropout_rate", "share of beams without a measurement", {0, 1}}, s.dropout_rate);
}

}  // namespace mapscore::eval
