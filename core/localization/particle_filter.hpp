// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/odometry_motion.hpp"
#include "core/localization/planar_pose.hpp"
#include "core/localization/resampling.hpp"
#include "core/localization/scan_likelihood.hpp"
#include "core/parameters.hpp"
#include "core/placement/pose_belief.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mapscore {

struct ParticleFilterParams {
  OdometryNoise noise;
  KldParams kld;
  /// Resample when the effective sample size falls below this share of the particles.
  double resample_below = 0.5;
  /// A scan that would leave less than this share effective is tempered further, by the largest
  /// exponent e <= 1 that leaves it. Such particles lie too far apart for the scan: when they are
  /// resampled, each is moved by a Gaussian kernel of (1 - e) bins on each axis, or less where they
  /// lie close together (a regularised filter: C. Musso, N. Oudjane, F. Le Gland, Improving
  /// Regularised Particle Filters, in Sequential Monte Carlo Methods in Practice, 2001). 0 turns
  /// both off; a global start then settles on whatever mode a particle happens to lie near.
  double least_effective = 0.2;
  /// A step updates the particles when the robot has moved this far, or turned this much, since the
  /// last update; a standing robot would take the same scan for ever more news.
  double update_way_m = 0.05;
  Degrees update_turn_deg{2.864788975654116};  ///< 0.05 rad
  int jobs = 1;                                ///< threads; the result does not depend on them

  /// Those of the filter itself; `noise` and `kld` have their own.
  static void fields(auto& s, auto&& visit) {
    visit(s.update_way_m, Field{"update_way_m", "way after which a scan is used", {0, 10}});
    visit(s.update_turn_deg, Field{"update_turn_deg", "turn after which a scan is used", {0, 360}});
  }
  bool operator==(const ParticleFilterParams&) const = default;
};

/// Monte Carlo localisation on a 2D grid: Thrun, Burgard, Fox (2005), tables 8.2 and 8.4. Between
/// updates the estimate moves with the odometry. Every draw comes from a stream named (seed,
/// purpose, update), so that same inputs give the same bytes for any number of threads. Not
/// thread-safe.
class ParticleFilter {
 public:
  /// Throws Error naming the parameter that is out of range.
  ParticleFilter(std::shared_ptr<const ScanModel> model, const ParticleFilterParams& params,
                 std::uint64_t seed);

  /// Tracking: least number of particles, drawn about T_map_base, error as PoseEstimate has it.
  /// Throws Error when the covariance is not positive semi-definite.
  void start_at(const PoseEstimate& start);
  /// Global: most particles, uniform over the free cells and all headings. Throws Error when no
  /// cell is free.
  void start_anywhere(const OccupancyGrid& grid);

  /// One step: predict and weight when the robot has moved enough (always at the first), else move
  /// the estimate with the odometry. True when the particles were updated. Throws Error before a
  /// start, or as beams_of.
  bool step(const PlanarPose& T_odom_base, const LaserScan& scan);

  /// T_map_base and its covariance at the last step.
  [[nodiscard]] const PoseEstimate& estimate() const { return estimate_; }
  /// The same as a belief: T_map_odom = T_map_base T_odom_base^-1, all three of the plane.
  [[nodiscard]] PoseBelief belief() const;
  /// Particles T_map_base at the last update, after resampling, and their weights (sum 1).
  [[nodiscard]] std::span<const PlanarPose> particles() const { return poses_; }
  [[nodiscard]] std::span<const double> weights() const { return weights_; }

 private:
  void restart();
  void predict(const OdometryMotion& motion, const MotionSigmas& sigmas);
  void weigh(const LaserScan& scan);
  void resample();
  [[nodiscard]] RandomStream stream(const char* purpose) const;

  std::shared_ptr<const ScanModel> model_;
  ParticleFilterParams params_;
  std::uint64_t seed_;
  std::uint64_t starts_ = 0, updates_ = 0;
  double held_back_ = 0.0;  ///< share of the last scan's exponent
  bool has_odometry_ = false;
  PlanarPose T_odom_base_, T_odom_base_updated_;
  std::vector<PlanarPose> poses_;
  std::vector<double> log_weights_, weights_;
  PoseEstimate estimate_, updated_;
};

}  // namespace mapscore
