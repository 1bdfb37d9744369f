// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/pose_fault.hpp"

#include "core/placement/pose_belief.hpp"
#include "core/random_stream.hpp"

namespace mapscore::sim {
namespace {

Pose draw_error(const Covariance6& root, std::uint64_t seed, std::size_t frame) {
  RandomStream stream(seed, "pose", {frame});
  Vector6 standard;
  for (int axis = 0; axis < 6; ++axis) standard[axis] = stream.normal();
  return exp_pose(root * standard);
}

/// Covariance of scale 1.
Covariance6 unit_covariance(const PoseNoise& noise) {
  using RowMajor6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  if (noise.covariance_m_rad)
    return Eigen::Map<const RowMajor6>(noise.covariance_m_rad->front().data());
  const double tilt = noise.sigma_roll_pitch_deg.rad();
  Vector6 sigma;
  sigma << noise.sigma_xy_m, noise.sigma_xy_m, noise.sigma_z_m, tilt, tilt,
      noise.sigma_yaw_deg.rad();
  return sigma.cwiseAbs2().asDiagonal();
}

}  // namespace

Covariance6 covariance_of(const PoseNoise& noise) {
  return noise.sigma_scale * noise.sigma_scale * unit_covariance(noise);
}

Covariance6 reported_covariance(const PoseNoise& noise) {
  return noise.reported_scale * covariance_of(noise);
}

PoseErrors::PoseErrors(const Covariance6& covariance, PoseNoiseKind kind, std::uint64_t seed)
    : root_(covariance_root(covariance)), kind_(kind), seed_(seed) {}

Pose PoseErrors::next() {
  if (root_.isZero(0.0)) return error_;
  const bool constant = kind_ == PoseNoiseKind::constant;
  const Pose drawn = draw_error(root_, seed_, constant ? 0 : frame_);
  ++frame_;
  error_ = kind_ == PoseNoiseKind::walk ? error_ * drawn : drawn;
  return error_;
}

std::vector<Pose> believe_poses(const std::vector<Pose>& T_world_base,
                                const Covariance6& covariance, PoseNoiseKind kind,
                                std::uint64_t seed) {
  if (covariance_root(covariance).isZero(0.0)) return T_world_base;
  PoseErrors errors(covariance, kind, seed);
  std::vector<Pose> believed;
  believed.reserve(T_world_base.size());
  for (const Pose& pose : T_world_base) believed.push_back(pose * errors.next());
  return believed;
}

}  // namespace mapscore::sim
