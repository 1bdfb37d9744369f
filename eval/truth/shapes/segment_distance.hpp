// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/truth/shapes/convex_forms.hpp"

#include <Eigen/Core>

namespace mapscore::eval {

/// Squared distance (m^2) between the segment a-b (a point when a = b) and a closed box.
[[nodiscard]] double squared_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                      const Box& box);

/// Squared distance (m^2) between the segment a-b and a point.
[[nodiscard]] double squared_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                      const Eigen::Vector3d& p);

}  // namespace mapscore::eval
