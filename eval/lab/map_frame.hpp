// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "eval/study/study.hpp"

#include <Eigen/Core>

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
[[nodiscard]] Eigen::Vector3d low_discrepancy_point(int n);

/// Map frame of seed n: the study's `map_origin_m` if given, otherwise low_discrepancy_point(n)
/// voxels.
[[nodiscard]] MapFrame map_frame(const Study& study, int seed_index);

}  // namespace mapscore::eval
