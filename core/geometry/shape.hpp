// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/pose.hpp"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace mapscore {

/// Kinds of drawn surface. `size` follows MuJoCo: plane (half x, half y), sphere (radius), capsule
/// and cylinder (radius, half length along z; a capsule's without its caps), ellipsoid and box
/// (half extents).
enum class ShapeKind { plane, sphere, capsule, ellipsoid, cylinder, box, mesh };

[[nodiscard]] constexpr const char* name_of(ShapeKind kind) {
  constexpr std::array kNames{"plane", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh"};
  return kNames[static_cast<std::size_t>(kind)];
}

/// How many of the three sizes a kind uses; these must be above 0.
[[nodiscard]] constexpr int sizes_of(ShapeKind kind) {
  constexpr std::array kSizes{2, 1, 2, 3, 2, 3, 0};
  return kSizes[static_cast<std::size_t>(kind)];
}

using Triangle = std::array<Eigen::Vector3d, 3>;

/// One drawn surface of the scene, exact. Box, sphere, ellipsoid, cylinder and capsule are solids;
/// planes (finite, z = 0 of their frame) and meshes have no inside. Metres.
struct Shape {
  ShapeKind kind = ShapeKind::box;
  InstanceId instance = 0;  ///< 0: background
  std::string name;         ///< geom name in the scene, may be empty
  Pose T_world_shape = Pose::Identity();
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  std::vector<Triangle> triangles;  ///< mesh only, in the shape's frame

  [[nodiscard]] bool solid() const { return kind != ShapeKind::plane && kind != ShapeKind::mesh; }
};

}  // namespace mapscore
