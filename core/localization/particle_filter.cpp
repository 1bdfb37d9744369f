// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/particle_filter.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace mapscore {
namespace {

constexpr std::size_t kRunOfParticles = 1024;

void check(bool usable, const char* what) {
  if (!usable) throw Error(std::string("particle filter: ") + what);
}

void check(const ParticleFilterParams& params) {
  const KldParams& kld = params.kld;
  check(kld.min_particles >= 1 && kld.max_particles >= kld.min_particles,
        "give 1 <= min_particles <= max_particles");
  check(kld.epsilon > 0 && kld.z_quantile >= 0 && kld.bin_m > 0 && kld.bin_rad > 0,
        "give epsilon and the edges of the bins above 0, z_quantile of at least 0");
  check(params.resample_below >= 0 && params.resample_below <= 1,
        "resample_below is a share; give 0 to 1");
  check(params.least_effective >= 0 && params.least_effective < 1,
        "least_effective is a share; give 0 to below 1");
  check(params.update_way_m >= 0 && params.update_turn_deg.deg >= 0,
        "give update_way_m and update_turn_deg of at least 0");
  check(params.jobs >= 1, "give at least 1 job");
}

/// The estimate after a motion that the particles have not made yet: its error is carried along and
/// that of the motion is added.
PoseEstimate moved(const PoseEstimate& estimate, const PlanarPose& T_before_after,
                   const OdometryNoise& noise) {
  const OdometryMotion motion = motion_parts(T_before_after, noise.least_way_m);
  const Eigen::Matrix3d carry = adjoint(inverse(T_before_after));
  return {estimate.mean * T_before_after,
          carry * estimate.covariance * carry.transpose() +
              motion_covariance(motion, motion_sigmas(motion, noise))};
}

/// Largest exponent of at most 1 with which the news leaves the wanted effective sample size.
double exponent_of(const std::vector<double>& log_weights, const std::vector<double>& news,
                   double wanted) {
  std::vector<double> trial(news.size());
  const auto leaves_enough = [&](double exponent) {
    for (std::size_t n = 0; n < news.size(); ++n) trial[n] = log_weights[n] + exponent * news[n];
    return effective_sample_size(normalised_weights(trial)) >= wanted;
  };
  if (leaves_enough(1.0)) return 1.0;
  double low = 0.0, high = 1.0;
  for (int halving = 0; halving < 20; ++halving) {
    const double middle = 0.5 * (low + high);
    (leaves_enough(middle) ? low : high) = middle;
  }
  return low;
}

/// Gaussian kernel of `share` of a bin on each axis of the robot, no wider than what suits the
/// particles' own spread: Silverman's 0.97 n^(-1/7) standard deviations, for three dimensions.
void smooth(std::vector<PlanarPose>& poses, double share, const KldParams& kld,
            const Eigen::Matrix3d& covariance, RandomStream& stream) {
  const double bandwidth = 0.97 * std::pow(static_cast<double>(poses.size()), -1.0 / 7.0);
  const Eigen::Array3d bins(kld.bin_m, kld.bin_m, kld.bin_rad);
  const Eigen::Array3d width =
      share * bins.min(bandwidth * covariance.diagonal().array().max(0.0).sqrt());
  for (PlanarPose& pose : poses) {
    const double x = width[0] * stream.normal(), y = width[1] * stream.normal();
    pose = pose * PlanarPose{x, y, width[2] * stream.normal()};
  }
}

/// What the grid's resolution r adds to the covariance of a position on each axis: a surface lies
/// anywhere in its cell, with variance r^2 / 12, and a position that rests on four of them has
/// r^2 / 48. All scans that see these surfaces share this error, so more beams do not reduce it.
Eigen::Matrix3d map_covariance(const ScanModel& model) {
  const GridFrame& frame =
      std::visit([](const auto& scans) -> const GridFrame& { return scans.frame(); }, model);
  const double sigma = frame.resolution_m / std::sqrt(48.0);
  return Eigen::Vector3d(sigma * sigma, sigma * sigma, 0.0).asDiagonal();
}

}  // namespace

ParticleFilter::ParticleFilter(std::shared_ptr<const ScanModel> model,
                               const ParticleFilterParams& params, std::uint64_t seed)
    : model_(std::move(model)), params_(params), seed_(seed) {
  check(params);
  static_cast<void>(motion_sigmas({}, params.noise));  // refuses bad alphas now, not at a step
}

RandomStream ParticleFilter::stream(const char* purpose) const {
  return {seed_, purpose, {starts_, updates_}};
}

void ParticleFilter::restart() {
  ++starts_;
  updates_ = 0;
  has_odometry_ = false;
  const auto count = static_cast<double>(poses_.size());
  log_weights_.assign(poses_.size(), -std::log(count));
  weights_.assign(poses_.size(), 1.0 / count);
  estimate_ = updated_ = estimate_of(poses_, weights_);
}

void ParticleFilter::start_at(const PoseEstimate& start) {
  const Covariance6 root = covariance_root(spatial_covariance(start.covariance));
  RandomStream draws = stream("localization start");
  poses_.resize(params_.kld.min_particles);
  for (PlanarPose& pose : poses_) {
    Vector6 standard = Vector6::Zero();
    for (const int axis : {0, 1, 5}) standard[axis] = draws.normal();
    pose = start.mean * planar(exp_pose(root * standard));
  }
  restart();
}

void ParticleFilter::start_anywhere(const OccupancyGrid& grid) {
  std::vector<GridCell> free;
  const GridFrame& frame = grid.frame();
  for (GridCell cell; cell.row < frame.height; ++cell.row)
    for (cell.column = 0; cell.column < frame.width; ++cell.column)
      if (grid.at(cell) == kFreeCell) free.push_back(cell);
  if (free.empty())
    throw Error("grid: has no free cell to start in; use one that says where the robot can be");
  RandomStream draws = stream("localization start");
  poses_.resize(params_.kld.max_particles);
  for (PlanarPose& pose : poses_) {
    const auto pick = static_cast<std::size_t>(draws.uniform() * static_cast<double>(free.size()));
    const double x = (free[pick].column + draws.uniform()) * frame.resolution_m;
    const double y = (free[pick].row + draws.uniform()) * frame.resolution_m;
    const double yaw = (2.0 * draws.uniform() - 1.0) * std::numbers::pi;
    pose = frame.T_map_grid * PlanarPose{x, y, yaw};
  }
  restart();
}

bool ParticleFilter::step(const PlanarPose& T_odom_base, const LaserScan& scan) {
  check(!poses_.empty(), "has not been started; call start_at or start_anywhere first");
  check(std::isfinite(T_odom_base.x_m) && std::isfinite(T_odom_base.y_m) &&
            std::isfinite(T_odom_base.yaw_rad),
        "the odometry's pose is not finite; give metres and radians");
  T_odom_base_ = T_odom_base;
  if (!has_odometry_) T_odom_base_updated_ = T_odom_base;
  const PlanarPose T_before_after = inverse(T_odom_base_updated_) * T_odom_base;
  const bool has_moved =
      std::hypot(T_before_after.x_m, T_before_after.y_m) >= params_.update_way_m ||
      std::abs(T_before_after.yaw_rad) >= params_.update_turn_deg.rad();
  if (has_odometry_ && !has_moved) {
    estimate_ = moved(updated_, T_before_after, params_.noise);
    return false;
  }
  const OdometryMotion motion = motion_parts(T_before_after, params_.noise.least_way_m);
  predict(motion, motion_sigmas(motion, params_.noise));
  weigh(scan);
  estimate_ = estimate_of(poses_, weights_);
  resample();
  estimate_.covariance += map_covariance(*model_);
  updated_ = estimate_;
  T_odom_base_updated_ = T_odom_base;
  has_odometry_ = true;
  ++updates_;
  return true;
}

void ParticleFilter::predict(const OdometryMotion& motion, const MotionSigmas& sigmas) {
  RandomStream draws = stream("localization motion");
  for (PlanarPose& pose : poses_) pose = pose * sample_motion(motion, sigmas, draws);
}

void ParticleFilter::weigh(const LaserScan& scan) {
  std::vector<double> news(poses_.size());
  const std::span<const PlanarPose> poses(poses_);
  const std::span<double> results(news);
  const std::size_t runs = (poses.size() + kRunOfParticles - 1) / kRunOfParticles;
  for_each_in_parallel(runs, params_.jobs, [&](std::size_t run) {
    const std::size_t first = run * kRunOfParticles;
    const std::size_t count = std::min(kRunOfParticles, poses.size() - first);
    const auto weigh_run = [&](const auto& model) {
      model.log_likelihoods(scan, poses.subspan(first, count), results.subspan(first, count));
    };
    std::visit(weigh_run, *model_);
  });
  const double wanted = std::min(params_.least_effective * static_cast<double>(poses_.size()),
                                 0.999 * effective_sample_size(weights_));
  const double exponent = exponent_of(log_weights_, news, wanted);
  held_back_ = 1.0 - exponent;
  for (std::size_t n = 0; n < news.size(); ++n) log_weights_[n] += exponent * news[n];
  weights_ = normalised_weights(log_weights_);
  const double top = *std::max_element(log_weights_.begin(), log_weights_.end());
  for (double& log_weight : log_weights_) log_weight -= top;
}

void ParticleFilter::resample() {
  const auto count = static_cast<double>(poses_.size());
  if (effective_sample_size(weights_) >= params_.resample_below * count) return;
  RandomStream draws = stream("localization resampling");
  const std::size_t wanted = kld_particles(poses_, weights_, params_.kld, draws);
  std::vector<PlanarPose> picked;
  picked.reserve(wanted);
  for (const std::size_t pick : low_variance_picks(weights_, wanted, draws.uniform()))
    picked.push_back(poses_[pick]);
  if (held_back_ > 0.0) smooth(picked, held_back_, params_.kld, estimate_.covariance, draws);
  poses_ = std::move(picked);
  log_weights_.assign(wanted, 0.0);
  weights_.assign(wanted, 1.0 / static_cast<double>(wanted));
}

PoseBelief ParticleFilter::belief() const {
  return {spatial(estimate_.mean * inverse(T_odom_base_)), spatial(T_odom_base_),
          spatial_covariance(estimate_.covariance)};
}

}  // namespace mapscore
