// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/odometry_motion.hpp"
#include "core/localization/particle_filter.hpp"
#include "core/localization/resampling.hpp"
#include "core/localization/scan_likelihood.hpp"
#include "core/parameters.hpp"
#include "eval/localization/localization_run.hpp"
#include "eval/localization/visual_run.hpp"
#include "sim/faults/lidar_noise.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// Where a trial's believed poses come from.
enum class PoseSource {
  gaussian,         ///< the true pose moved by faults.pose; the true one where that has no dose
  truth,            ///< the true pose, whatever faults.pose says
  odometry,         ///< dead reckoning by the wheels, from the true pose at the start
  particle_filter,  ///< odometry and lidar on a grid of the home
  trajectory,       ///< a file
  visual_odometry,  ///< depth images, matched with those before, and the wheels
  visual_slam       ///< the same with loop closure
};

/// How the particle filter starts: about the true pose, or anywhere on the grid.
enum class FilterStart { tracking, global };

enum class ScanModelKind { likelihood_field, beam };
constexpr auto names_of(PoseSource) {
  return std::to_array<std::string_view>({"gaussian", "truth", "odometry", "particle_filter",
                                          "trajectory", "visual_odometry", "visual_slam"});
}
constexpr auto names_of(FilterStart) {
  return std::to_array<std::string_view>({"tracking", "global"});
}
constexpr auto names_of(ScanModelKind) {
  return std::to_array<std::string_view>({"likelihood_field", "beam"});
}

/// The particle filter of a study; what is not given is as the core has it.
struct ParticleFilterSettings {
  FilterStart start = FilterStart::tracking;
  Overrides<StartSpread> spread;
  Overrides<KldParams> kld;
  Overrides<ParticleFilterParams> filter;
  ScanModelKind scan_model = ScanModelKind::likelihood_field;
  Overrides<LikelihoodFieldParams> model;  ///< keys that the beam model has too

  static void fields(auto& s, auto&& visit) {
    visit(s.start,
          later({"start", "about the true pose (tracking), or anywhere on the grid (global)"}));
    Overrides<StartSpread>::fields(s.spread, visit);
    Overrides<KldParams>::fields(s.kld, visit);
    Overrides<ParticleFilterParams>::fields(s.filter, visit);
    visit(s.scan_model, later({"scan_model", "probability of a scan"}));
    Overrides<LikelihoodFieldParams>::fields(s.model, visit);
  }
  bool operator==(const ParticleFilterSettings&) const = default;
};

/// Visual odometry and SLAM of a study; what is not given is as the core has it.
struct VisualOdometrySettings {
  VisualSettings visual;
  Overrides<DepthSampling> sampling;
  Overrides<PlaneMapParams> map;
  Overrides<KeyFrameRule> key;
  Overrides<LoopClosure> loops;

  static void fields(auto& s, auto&& visit) {
    VisualSettings::fields(s.visual, visit);
    Overrides<DepthSampling>::fields(s.sampling, visit);
    Overrides<PlaneMapParams>::fields(s.map, visit);
    Overrides<KeyFrameRule>::fields(s.key, visit);
    Overrides<LoopClosure>::fields(s.loops, visit);
  }
  bool operator==(const VisualOdometrySettings&) const = default;
};

/// Whether the poses come from depth images.
[[nodiscard]] constexpr bool is_visual(PoseSource source) {
  return source == PoseSource::visual_odometry || source == PoseSource::visual_slam;
}

/// Where the robot of a study believes it is.
struct LocalizationSettings {
  PoseSource source = PoseSource::gaussian;
  std::optional<std::string> trajectory;  ///< of source trajectory
  std::optional<std::string> grid;        ///< empty: cut from the truth at the lidar's height
  std::optional<double> grid_resolution_m;
  Overrides<OdometryNoise> odometry_noise;
  ParticleFilterSettings filter;
  VisualOdometrySettings visual;

  static void fields(auto& s, auto&& visit) {
    visit(s.source, later({"source",
                           "of the believed poses; gaussian: the true pose under faults.pose",
                           {},
                           "pose source"}));
    visit(s.trajectory, Field{"trajectory",
                              "TUM lines of base_footprint in the scene's world, a 6x6 covariance "
                              "behind each if known; for source trajectory"});
    visit(s.grid, Field{"grid",
                        "grid of ROS's map_server (YAML) in the scene's world; default: cut from "
                        "the scene at the lidar's height"});
    visit(s.grid_resolution_m, Field{"grid_resolution_m",
                                     "edge of a cell of a grid that is cut; default 0.02",
                                     {0.005, 1}});
    visit(s.odometry_noise,
          later({"odometry_noise",
                 "of the odometry, as sources odometry and particle_filter believe it"}));
    visit(s.filter, later({"filter", "the particle filter"}));
    visit(s.visual, later({"visual", "odometry and SLAM by depth images (docs/odometry.md)"}));
  }
  bool operator==(const LocalizationSettings&) const = default;
};

/// Edge of a cell of a grid that is cut from the truth, metres.
[[nodiscard]] double grid_resolution_m(const LocalizationSettings& settings);

/// The filter of a study, with the lidar's noise.
[[nodiscard]] FilterSettings filter_of(const LocalizationSettings& settings,
                                       const Dosed<sim::LidarNoise>& lidar);

/// The visual odometry of a study, with loop closure for source visual_slam.
[[nodiscard]] VisualOdometryParams visual_of(const LocalizationSettings& settings);

/// The noise of the lidar with every key, or none where there is no noise: equal exactly where the
/// scans are.
[[nodiscard]] Dosed<sim::LidarNoise> canonical_lidar(const Dosed<sim::LidarNoise>& settings);

struct FaultSettings;
struct Study;

/// Canonical settings of the poses of a study, equal exactly where the poses are: every default
/// that the source uses is written out, and nothing that it does not use. `content`: hash of what
/// the file holds that the source reads.
void resolve_localization(LocalizationSettings& localization, FaultSettings& faults,
                          const std::string& content);

/// What decides the poses of a source along a whole recording: sections and leaves of a study, by
/// dotted path. Beside them do the recording and the seed.
[[nodiscard]] std::vector<std::string> keys_of_poses(const LocalizationSettings& settings);

/// Whether the leaf at a dotted path decides the poses of a study's source, as the study stands: a
/// key of the loops does not where none are closed. Throws Error where there is no such leaf.
[[nodiscard]] bool decides_poses(const Study& study, std::string_view path);

}  // namespace mapscore::eval
