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

std::vector<Pose> believe_poses(const std::vector<Pose>& T_world_base,
                                const Covariance6& covariance, PoseNoiseKind kind,
                                std::uint64_t seed) {
  const Covariance6 root = covariance_root(covariance);
  if (root.isZero(0.0)) return T_world_base;
  std::vector<Pose> believed;
  believed.reserve(T_world_base.size());
  Pose walked = Pose::Identity();
  for (std::size_t frame = 0; frame < T_world_base.size(); ++frame) {
    const bool constant = kind == PoseNoiseKind::constant;
    const Pose error = draw_error(root, seed, constant ? 0 : frame);
    walked = kind == PoseNoiseKind::walk ? walked * error : error;
    believed.push_back(T_world_base[frame] * walked);
  }
  return believed;
}

}  // namespace mapscore::sim
