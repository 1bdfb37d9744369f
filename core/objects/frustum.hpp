// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/objects/object_box.hpp"

#include <array>

namespace mapscore {

/// What a camera frames between two planar depths: the closed hexahedron from the outer edges of
/// its outer pixels (u = -1/2 and width - 1/2, v likewise). Camera's frame, metres. Immutable.
class Frustum {
 public:
  /// 0 < near_m <= far_m.
  Frustum(const CameraModel& camera, double near_m, double far_m);

  /// True when the box, in the camera's frame, and the frustum have a point in common: no axis
  /// separates them, of the normals of both and the products of their edges (separating axis
  /// theorem, which is exact for convex bodies).
  [[nodiscard]] bool meets(const ObjectBox& box) const;

  /// Of the near plane, then of the far one.
  [[nodiscard]] const std::array<Eigen::Vector3d, 8>& corners() const { return corners_; }

 private:
  std::array<Eigen::Vector3d, 8> corners_;
  std::array<Eigen::Vector3d, 5> normals_;
  std::array<Eigen::Vector3d, 6> edges_;
};

}  // namespace mapscore
