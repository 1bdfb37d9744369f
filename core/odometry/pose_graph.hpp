// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <cstddef>
#include <vector>

namespace mapscore {

/// A measured pose of one node in the axes of another: T_from_to_true = T_from_to Exp(xi),
/// xi ~ N(0, covariance), in the order x y z roll pitch yaw.
struct PoseEdge {
  std::size_t from = 0, to = 0;
  Pose T_from_to = Pose::Identity();
  Covariance6 covariance = Covariance6::Identity();
  bool loop = false;  ///< may be wrong: weighs less where it disagrees (Cauchy)
};

/// The most probable poses T_map_node of all nodes given the edges and the first node's pose, which
/// stays, and the covariance of the last one: nonlinear least squares over xi by Ceres (G.
/// Grisetti, R. Kuemmerle, C. Stachniss, W. Burgard, A Tutorial on Graph-Based SLAM, 2010). `nodes`
/// are the start of the search and must be connected. Deterministic. Throws Error when an edge
/// names no node or its covariance is singular.
struct OptimisedPoses {
  std::vector<Pose> nodes;
  Covariance6 last_covariance = Covariance6::Zero();  ///< in the axes of the last node
};
[[nodiscard]] OptimisedPoses optimised(std::vector<Pose> nodes, const std::vector<PoseEdge>& edges);

}  // namespace mapscore
