// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/localization/trajectory_errors.hpp"

#include "core/error.hpp"
#include "core/localization/nees.hpp"
#include "eval/localization/believed_trajectory.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

namespace mapscore::eval {
namespace {

constexpr double kRounding = 1e-9;  ///< metres or radians of an axis that is right

/// Way along the true trajectory to each pose. Squares are added from left to right, as evo's
/// library does: the pair of a pose must not depend on the last bit of a sum.
std::vector<double> ways_to(std::span<const Pose> truth) {
  std::vector<double> ways{0.0};
  for (std::size_t n = 1; n < truth.size(); ++n) {
    const Eigen::Vector3d step = truth[n - 1].translation() - truth[n].translation();
    ways.push_back(ways.back() +
                   std::sqrt(step.x() * step.x() + step.y() * step.y() + step.z() * step.z()));
  }
  return ways;
}

Eigen::Matrix3Xd positions_of(std::span<const Pose> poses) {
  Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(poses.size()));
  for (std::size_t n = 0; n < poses.size(); ++n)
    positions.col(static_cast<Eigen::Index>(n)) = poses[n].translation();
  return positions;
}

void add_absolute(std::span<const Pose> truth, std::span<const Pose> believed,
                  TrajectoryErrors& errors) {
  const Pose T_true_believed = rigid_alignment(truth, believed);
  for (std::size_t n = 0; n < truth.size(); ++n) {
    const Pose& T_true = truth[n];
    const Pose& T_mean = believed[n];
    errors.position.add((T_mean.translation() - T_true.translation()).squaredNorm());
    errors.aligned.add(
        (T_true_believed * T_mean.translation() - T_true.translation()).squaredNorm());
    const double angle = rotation_angle(T_true.linear().transpose() * T_mean.linear());
    errors.rotation.add(angle * angle);
  }
}

/// E = (T_i^-1 T_j)^-1 (M_i^-1 M_j) of each pair, T true and M believed.
void add_relative(std::span<const Pose> truth, std::span<const Pose> believed,
                  TrajectoryErrors& errors) {
  for (const auto& [i, j] : pairs_of_way(truth)) {
    const Pose true_motion = truth[i].inverse() * truth[j];
    const Pose error = true_motion.inverse() * (believed[i].inverse() * believed[j]);
    errors.relative_position.add(error.translation().squaredNorm());
    const double angle = rotation_angle(error.linear());
    errors.relative_rotation.add(angle * angle);
  }
}

void tally_up(double squared, const NeesBand& band, NeesTally& tally) {
  ++tally.count;
  if (band.holds(squared)) ++tally.in_band;
  if (squared < kInfiniteNees)
    tally.sum += squared;
  else
    ++tally.infinite;
}

/// Whether every axis that a belief calls certain is right.
bool right_where_certain(const PoseEstimate& estimate, const PlanarPose& T_true) {
  const Eigen::Vector3d xi = log_planar(inverse(estimate.mean) * T_true);
  for (int axis = 0; axis < 3; ++axis)
    if (estimate.covariance(axis, axis) == 0.0 && std::abs(xi[axis]) > kRounding) return false;
  return true;
}

void add_nees(const PoseBelief& belief, const Pose& T_true, TrajectoryErrors& errors) {
  const PoseEstimate estimate = planar_estimate(belief);
  const bool some_certain = (estimate.covariance.diagonal().array() == 0.0).any();
  const bool silent = estimate.covariance.isZero(0.0) ||
                      (some_certain && right_where_certain(estimate, planar(T_true)));
  if (!silent) tally_up(nees(estimate, planar(T_true)), kNeesBand, errors.planar);
  if (is_spatial(belief)) tally_up(nees(belief, T_true), kNeesBand6, errors.spatial);
}

}  // namespace

std::optional<double> SquareSum::rms() const {
  if (count == 0) return std::nullopt;
  return std::sqrt(sum / static_cast<double>(count));
}

std::optional<double> NeesTally::share() const {
  if (count == 0) return std::nullopt;
  return static_cast<double>(in_band) / static_cast<double>(count);
}

std::optional<double> NeesTally::mean() const {
  if (count == 0 || infinite > 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

std::vector<std::pair<std::size_t, std::size_t>> pairs_of_way(std::span<const Pose> truth) {
  const std::vector<double> ways = ways_to(truth);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i + 1 < truth.size(); ++i) {
    std::size_t nearest = i + 1;
    for (std::size_t j = i + 2; j < truth.size(); ++j) {
      if (std::abs(ways[j] - ways[i] - kPairWay) < std::abs(ways[nearest] - ways[i] - kPairWay))
        nearest = j;
      if (ways[j] - ways[i] > kPairWay) break;  // ways never fall
    }
    if (std::abs(ways[nearest] - ways[i] - kPairWay) <= kPairSlack) pairs.emplace_back(i, nearest);
  }
  return pairs;
}

Pose rigid_alignment(std::span<const Pose> a, std::span<const Pose> b) {
  Pose T_a_b = Pose::Identity();
  T_a_b.matrix() = Eigen::umeyama(positions_of(b), positions_of(a), false);
  return T_a_b;
}

double rotation_angle(const Eigen::Matrix3d& rotation) {
  return Eigen::AngleAxisd(rotation).angle();
}

TrajectoryErrors trajectory_errors(std::span<const Pose> truth, std::span<const Pose> believed) {
  if (truth.empty() || truth.size() != believed.size())
    throw Error(
        fmt::format("trajectory: {} believed poses against {} true ones; give one for each "
                    "frame",
                    believed.size(), truth.size()));
  TrajectoryErrors errors;
  add_absolute(truth, believed, errors);
  add_relative(truth, believed, errors);
  return errors;
}

TrajectoryErrors trajectory_errors(std::span<const Pose> truth,
                                   std::span<const PoseBelief> believed) {
  std::vector<Pose> means;
  for (const PoseBelief& belief : believed) means.push_back(belief.T_map_odom * belief.T_odom_base);
  TrajectoryErrors errors = trajectory_errors(truth, means);
  for (std::size_t n = 0; n < believed.size(); ++n) add_nees(believed[n], truth[n], errors);
  return errors;
}

}  // namespace mapscore::eval
