// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/pose_fault.hpp"

#include "core/mapping/pose_belief.hpp"
#include "core/random_stream.hpp"

namespace mapscore::sim {
namespace {

Pose draw_error(const Covariance6& root, std::uint64_t seed, std::size_t frame) {
  RandomStream stream(seed, "pose", {frame});
  Vector6 standard;
  for (int axis = 0; axis < 6; ++axis) standard[axis] = stream.normal();
  return exp_pose(root * standard);
}

}  // namespace

std::vector<Pose> believe_poses(const std::vector<Pose>& T_world_base, const PoseDose& dose,
                                std::uint64_t seed) {
  const Covariance6 root = covariance_root(dose.covariance);
  if (root.isZero(0.0)) return T_world_base;
  std::vector<Pose> believed;
  believed.reserve(T_world_base.size());
  Pose walked = Pose::Identity();
  for (std::size_t frame = 0; frame < T_world_base.size(); ++frame) {
    const bool constant = dose.kind == PoseNoiseKind::constant;
    const Pose error = draw_error(root, seed, constant ? 0 : frame);
    walked = dose.kind == PoseNoiseKind::walk ? walked * error : error;
    believed.push_back(T_world_base[frame] * walked);
  }
  return believed;
}

}  // namespace mapscore::sim
