// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/truth/surface_truth.hpp"
#include "tests/eval/truth/shapes/closest_point.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

/// How near a closed box comes to a surface, by search: points of the box and of the surface are
/// drawn together, and the distance of the best pair is returned. It can only be too large.
namespace mapscore::eval::test {

using ClosedBox = Eigen::AlignedBox3d;

inline constexpr double kFoundEnough_m = 5e-11;  ///< near enough to stop searching
inline constexpr double kFarEnough_m = 1.2e-9;   ///< proven distance at which to stop searching

/// Distance at which a segment that starts inside a solid and ends outside crosses the boundary, by
/// halving: 0 up to the rounding of the last two points.
inline double crossing_distance(const ConvexSet& solid, Eigen::Vector3d inside,
                                Eigen::Vector3d outside) {
  for (int step = 0; step < 100; ++step) {
    const Eigen::Vector3d middle = 0.5 * (inside + outside);
    (depth_in(solid, middle) > 0 ? inside : outside) = middle;
  }
  return std::max((nearest_point(solid, outside) - outside).norm(), (inside - outside).norm());
}

/// Least distance of a point of the box to a convex set: golden sections within golden sections
/// along x, y and z, since the distance is convex and its least value over a section is convex too.
class GoldenSearch {
 public:
  GoldenSearch(const ConvexSet& set, const ClosedBox& box) : set_(set), box_(box) {
    (void)least_along(0, box.center());
  }
  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] const Eigen::Vector3d& point() const { return point_; }

 private:
  double least_along(int axis, Eigen::Vector3d p) {
    if (axis == 3) {
      const double distance = (nearest_point(set_, p) - p).norm();
      if (distance < least_) {
        least_ = distance;
        point_ = p;
      }
      return distance;
    }
    const auto at = [&](double x) {
      p[axis] = x;
      return least_along(axis + 1, p);
    };
    constexpr double kPart = 1 / std::numbers::phi;
    double low = box_.min()[axis], high = box_.max()[axis];
    double best = std::min(at(low), at(high));
    double a = high - kPart * (high - low), b = low + kPart * (high - low);
    double at_a = at(a), at_b = at(b);
    while (high - low > 1e-10 && least_ > kFoundEnough_m) {
      best = std::min({best, at_a, at_b});
      if (at_a < at_b) {
        high = std::exchange(b, a);
        at_b = at_a;
        a = high - kPart * (high - low);
        at_a = at(a);
      } else {
        low = std::exchange(a, b);
        at_a = at_b;
        b = low + kPart * (high - low);
        at_b = at(b);
      }
    }
    return std::min({best, at_a, at_b});
  }

  const ConvexSet& set_;
  const ClosedBox& box_;
  double least_ = std::numeric_limits<double>::infinity();
  Eigen::Vector3d point_;
};

struct NearPair {
  Eigen::Vector3d in_box;
  double distance = 0;
};

/// Distance of the box from the plane through q, a point nearest to p in a convex set, at right
/// angles to p - q. The set lies behind that plane, so its distance to the box is no less.
inline double proven_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                              const ClosedBox& box) {
  const Eigen::Vector3d normal = (p - q).normalized();
  const Eigen::Vector3d lowest = (normal.array() > 0).select(box.min(), box.max());
  return normal.dot(lowest - q);
}

/// Nearest pair of the closed box and the closed convex set: alternating projections, then, where
/// they creep (near tangents), golden sections. A pair found far apart may be farther apart than
/// the nearest one, but the box is then proven to be farther than `kFarEnough_m`.
inline NearPair near_pair(const ConvexSet& set, const ClosedBox& box) {
  // From the box's point nearest to the middle of the set: where tangents of upright shapes are.
  const Eigen::Vector3d middle = set.T_map_set.translation();
  Eigen::Vector3d p = middle.cwiseMax(box.min()).cwiseMin(box.max());
  double distance = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 400; ++step) {
    const Eigen::Vector3d q = nearest_point(set, p);
    const double next = (q - p).norm();
    const bool stalled = distance - next < 1e-14;  // arrived, or creeping
    if (next <= kFoundEnough_m || (stalled && next <= 1e-9)) return {p, next};
    if (proven_distance(p, q, box) > kFarEnough_m) return {p, next};
    if (stalled) break;
    distance = next;
    p = q.cwiseMax(box.min()).cwiseMin(box.max());
  }
  const GoldenSearch golden(set, box);
  return {golden.point(), golden.least()};
}

/// Distance of the closed box to the set's surface: the boundary of a solid, all of a plane or
/// triangle.
inline double distance_found(const ConvexSet& set, const ClosedBox& box) {
  if (!set.solid()) return near_pair(set, box).distance;
  double deepest = -std::numeric_limits<double>::infinity();
  double shallowest = std::numeric_limits<double>::infinity();
  Eigen::Vector3d inner, outer;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner = box.corner(static_cast<ClosedBox::CornerType>(i));
    const double depth = depth_in(set, corner);
    if (depth > deepest) inner = corner;
    if (depth < shallowest) outer = corner;
    deepest = std::max(deepest, depth);
    shallowest = std::min(shallowest, depth);
  }
  if (shallowest > 0) return shallowest;  // all within: depth is concave, so a corner is nearest
  if (deepest > 0) return crossing_distance(set, inner, outer);
  const NearPair pair = near_pair(set, box);
  return depth_in(set, pair.in_box) > 0 ? crossing_distance(set, pair.in_box, outer)
                                        : pair.distance;
}

/// Least over the sets; triangles whose bounds the box misses by more than 1e-8 m count as
/// infinitely far.
inline double distance_found(const std::vector<ConvexSet>& sets, const ClosedBox& box) {
  double least = std::numeric_limits<double>::infinity();
  for (const ConvexSet& set : sets) {
    if (set.kind == ShapeKind::mesh) {
      ClosedBox bounds(set.triangle[0]);
      bounds.extend(set.triangle[1]).extend(set.triangle[2]);
      if (bounds.exteriorDistance(box) > 1e-8) continue;
    }
    least = std::min(least, distance_found(set, box));
    if (least <= kFoundEnough_m) break;
  }
  return least;
}

inline constexpr double kNear_m = 1e-9;  ///< a voxel of the truth comes as near to its surface
/// The contact of exact tests less the rounding of a sample.
inline constexpr double kContactSlack_m = 1e-10 - 1e-13;

/// A voxel of the truth (of class 1) must be near the surface, any other must not touch it.
inline void check_voxel(const std::vector<ConvexSet>& sets, const SurfaceTruth& truth,
                        const VoxelKey& key, double epsilon_m) {
  const Eigen::Vector3d low = low_corner_of(key, truth.edge_m());
  const ClosedBox cube((low.array() - epsilon_m).matrix(),
                       (low.array() + truth.edge_m() + epsilon_m).matrix());
  const double distance = distance_found(sets, cube);
  const auto where = ::testing::Message() << key.i << " " << key.j << " " << key.k;
  if (truth.contains(key, 1)) {
    ASSERT_LE(distance, kNear_m) << where;
  } else {
    ASSERT_GT(distance, kContactSlack_m) << where;
  }
}

}  // namespace mapscore::eval::test
