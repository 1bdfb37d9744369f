// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/geometry/posed_depth.hpp"
#include "core/geometry/voxel.hpp"

#include <Eigen/Geometry>

namespace mapscore {

/// What one depth image says of the space in its frustum. Immutable, safe to share between threads.
class DepthView {
 public:
  /// Throws Error as check(PosedDepth).
  explicit DepthView(PosedDepth seen);

  /// Whether a voxel is in view: its centre has planar z within the range, limits included,
  /// projects into the image, onto a pixel that has a depth, and lies at most one edge behind that
  /// depth.
  [[nodiscard]] bool sees(const VoxelKey& key, double edge_m) const;

  /// Box around all that is in view, in frame map; empty when no pixel has a depth.
  [[nodiscard]] Eigen::AlignedBox3d box(double edge_m) const;

 private:
  PosedDepth seen_;
  Pose T_camera_map_;
};

}  // namespace mapscore
