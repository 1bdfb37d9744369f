// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"

#include <Eigen/Geometry>
#include <span>

namespace mapscore::sim {

/// Least box along the world's axes that holds a shape; empty for a mesh without triangles.
[[nodiscard]] Eigen::AlignedBox3d bounds_of(const Shape& shape);
[[nodiscard]] Eigen::AlignedBox3d bounds_of(std::span<const Triangle> triangles,
                                            const Pose& T_world_mesh);

}  // namespace mapscore::sim
