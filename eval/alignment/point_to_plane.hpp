// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "eval/alignment/point_tree.hpp"
#include "eval/alignment/surface_points.hpp"

#include <span>
#include <vector>

namespace mapscore::eval {

/// Surfaces as points with normals and a tree over them. Immutable, safe to
/// share between threads.
class SurfaceIndex {
 public:
  /// `slack_m`: how much farther than asked for `nearest` looks.
  explicit SurfaceIndex(std::vector<OrientedPoint> points, double slack_m = 0.0);

  [[nodiscard]] const std::vector<OrientedPoint>& points() const { return points_; }
  /// The surface's point nearest to `p` within the reach and the slack whose normal fits `n`
  /// (to within some 45 degrees, either sign; a zero normal fits any); nullptr
  /// where there is none.
  [[nodiscard]] const OrientedPoint* nearest(const OrientedPoint& point, double reach_m) const;

 private:
  std::vector<OrientedPoint> points_;
  PointTree tree_;
  double slack_m_;
};

/// A point of a map and how much it counts.
struct WeightedPoint : OrientedPoint {
  double weight = 1.0;
};

/// How points are moved onto surfaces.
struct PointToPlane {
  double from_m = 0.3, to_m = 0.05;  ///< scale of the residuals, falling
  int iterations = 15;
  /// Of the voxels whose centres the points are, in the points' frame, else zero. A surface may lie
  /// anywhere in its voxels, so that residuals within them hardly count.
  Eigen::Matrix3d half_edges = Eigen::Matrix3d::Zero();
};

/// Moves the points from T onto the surfaces by iterated closest points: least
/// squares of the distances from the surfaces' tangent planes, weighted by
/// Geman and McClure's (s^2 / (s^2 + r^2))^2.
[[nodiscard]] Pose point_to_plane(std::span<const WeightedPoint> points,
                                  const SurfaceIndex& surface, Pose T, const PointToPlane& options);

/// The share of the points' weight that T brings to within `near_m` of the
/// surfaces.
[[nodiscard]] double share_at_surfaces(std::span<const WeightedPoint> points,
                                       const SurfaceIndex& surface, const Pose& T, double near_m,
                                       const Eigen::Matrix3d& half_edges = Eigen::Matrix3d::Zero());

}  // namespace mapscore::eval
