// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/occupancy_grid.hpp"
#include "core/localization/planar_pose.hpp"
#include "core/parameters.hpp"

#include <cstddef>
#include <span>
#include <variant>
#include <vector>

namespace mapscore {

/// One turn of a planar lidar, as sensor_msgs/LaserScan has it. Beam n points along first_angle_rad
/// + n angle_step_rad in the lidar's frame. A range that is not a number, or below range_min_m, is
/// no measurement; one of range_max_m or more (infinity too) says that nothing was hit.
struct LaserScan {
  PlanarPose T_base_lidar;
  double first_angle_rad = 0.0, angle_step_rad = 0.0;
  double range_min_m = 0.0, range_max_m = 12.0;
  std::vector<float> ranges_m;
};

/// One beam as a model uses it: direction in the lidar's frame; `hit` false when nothing was hit
/// within the lidar's range, which is then `range_m`.
struct Beam {
  double angle_rad = 0.0, range_m = 0.0;
  bool hit = true;
};

/// At most `count` beams, evenly spread over the scan: beams floor(n size / count). Of these, those
/// that measured nothing are left out. Throws Error when the scan's numbers are not usable.
[[nodiscard]] std::vector<Beam> beams_of(const LaserScan& scan, std::size_t count);

/// What both models have in common.
void scan_model_fields(auto& s, auto&& visit) {
  visit(s.beams, Field{"beams", "of a scan that are used, at most", {1, 100000}});
  visit(s.sigma_hit_m,
        Field{"sigma_hit_m", "standard deviation of a beam that hits what the grid shows",
              above(0, 10)});
  visit(s.temper, Field{"temper", "exponent of a scan's probability: its beams are not independent",
                        above(0, 1)});
}

/// Likelihood field: Thrun, Burgard, Fox (2005), section 6.4, table 6.3.
struct LikelihoodFieldParams {
  std::size_t beams = 360;           ///< of a scan, at most
  double sigma_hit_m = 0.05;         ///< of the distance from an end point to the nearest obstacle
  double z_hit = 0.9, z_rand = 0.1;  ///< shares; sum 1
  /// Exponent of the scan's likelihood. Beams are not independent: neighbours share the map's
  /// errors. A scan is worth `temper` times as many independent beams as it has. The error that all
  /// beams share, and that more beams do not reduce, is the map's (ParticleFilter).
  double temper = 0.8;

  static void fields(auto& s, auto&& visit) { scan_model_fields(s, visit); }
  bool operator==(const LikelihoodFieldParams&) const = default;
};

/// Beam model: the same, section 6.3, table 6.1.
struct BeamModelParams {
  std::size_t beams = 60;
  double sigma_hit_m = 0.06;
  double lambda_short_per_m = 1.0;  ///< rate at which unexpected obstacles end a beam
  double z_hit = 0.8, z_short = 0.05, z_max = 0.05, z_rand = 0.1;  ///< shares; sum 1
  double temper = 0.1;

  static void fields(auto& s, auto&& visit) { scan_model_fields(s, visit); }
  bool operator==(const BeamModelParams&) const = default;
};

/// ln p(scan | pose, map) of the likelihood field, up to a constant:
///
///   temper * sum over beams of ln(z_hit N(d; 0, sigma_hit) + z_rand / range_max)
///
/// d the distance from the cell of the beam's end point to the nearest occupied cell, centre to
/// centre. Beams that hit nothing are left out. An end point beyond the grid counts as far from all
/// obstacles. Logarithms are made once per cell, in single precision. Immutable, safe to share.
class LikelihoodField {
 public:
  /// Throws Error naming the parameter that is out of range. `range_max_m` is the lidar's.
  LikelihoodField(const OccupancyGrid& grid, const LikelihoodFieldParams& params,
                  double range_max_m);

  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  /// One number for each pose T_map_base. Throws Error as beams_of.
  void log_likelihoods(const LaserScan& scan, std::span<const PlanarPose> poses,
                       std::span<double> results) const;

 private:
  GridFrame frame_;
  LikelihoodFieldParams params_;
  std::vector<float> log_p_;  ///< by cell, within a border one cell wide
};

/// ln p(scan | pose, map) of the beam model, up to a constant: temper * sum over beams of ln p(z),
/// with z* the cast ray's length plus half a cell, since the surface lies anywhere between a cell's
/// near and far side (range_max when it meets nothing), and
///
///   p(z) = z_hit N(z; z*, sigma_hit) / P(0 <= N <= range_max)
///        + z_short lambda exp(-lambda z) / (1 - exp(-lambda z*))    for z <= z*
///        + z_rand / range_max                                       for z < range_max
///   p(range_max) = z_max, plus z_hit when z* = range_max
///
/// Casts a ray for each pose and beam. Keeps a copy of the grid. Immutable, safe to share.
class BeamModel {
 public:
  /// Throws Error naming the parameter that is out of range. `range_max_m` is the lidar's.
  BeamModel(const OccupancyGrid& grid, const BeamModelParams& params, double range_max_m);

  [[nodiscard]] const GridFrame& frame() const { return grid_.frame(); }
  /// One number for each pose T_map_base. Throws Error as beams_of.
  void log_likelihoods(const LaserScan& scan, std::span<const PlanarPose> poses,
                       std::span<double> results) const;

  /// p(z) of one beam, given the expected range (metres).
  [[nodiscard]] double probability(double range_m, bool hit, double expected_m) const;

 private:
  OccupancyGrid grid_;
  BeamModelParams params_;
  double range_max_m_;
};

/// The model of a study, chosen at run time.
using ScanModel = std::variant<LikelihoodField, BeamModel>;

}  // namespace mapscore
