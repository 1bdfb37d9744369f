// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "eval/study/study.hpp"

#include <Eigen/Core>
#include <numbers>

namespace mapscore::eval {

/// Lattice on which a trial maps and scores: voxel edge, and where the map frame lies in the world.
struct MapFrame {
  double edge_m = 0.05;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;

  [[nodiscard]] Pose T_map_world() const { return map_from_world(origin_m, yaw_rad); }
  bool operator==(const MapFrame&) const = default;
};

/// The n-th point of the three-dimensional R-sequence in [0, 1)^3: frac(1/2 + (n + 1) a_i) with
/// a = (1/g, 1/g^2, 1/g^3) and g the real root of g^4 = g + 1.
[[nodiscard]] inline Eigen::Vector3d low_discrepancy_point(int n) {
  constexpr double kG = 1.2207440846057594754;
  const Eigen::Vector3d steps(1.0 / kG, 1.0 / (kG * kG), 1.0 / (kG * kG * kG));
  const Eigen::Vector3d point = (Eigen::Vector3d::Constant(0.5) + (n + 1) * steps);
  return point - point.array().floor().matrix();
}

/// Map frame of seed n: the study's `map_origin_m` if given, otherwise low_discrepancy_point(n)
/// voxels.
[[nodiscard]] inline MapFrame map_frame(const Study& study, int seed_index) {
  MapFrame frame;
  frame.edge_m = study.voxel_m;
  frame.yaw_rad = study.map_yaw_deg * std::numbers::pi / 180.0;
  frame.origin_m = study.map_origin_m
                       ? Eigen::Vector3d(study.map_origin_m->at(0), study.map_origin_m->at(1),
                                         study.map_origin_m->at(2))
                       : Eigen::Vector3d(study.voxel_m * low_discrepancy_point(seed_index));
  return frame;
}

}  // namespace mapscore::eval
