// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"
#include "core/random_stream.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

namespace mapscore {
/// The name by which GoogleTest prints a kind.
inline void PrintTo(ShapeKind kind, std::ostream* out) {
  *out << name_of(kind);
}
}  // namespace mapscore

/// Surfaces as parametrised patches: what the exact tests are held against. Shares no code with
/// them.
namespace mapscore::eval::test {

/// (u, v) in [0, 1]^2 -> point in the map frame (metres).
using Patch = std::function<Eigen::Vector3d(double, double)>;

inline Patch face_patch(Eigen::Vector3d centre, Eigen::Vector3d half_u, Eigen::Vector3d half_v) {
  return [=](double u, double v) -> Eigen::Vector3d {
    return centre + (2 * u - 1) * half_u + (2 * v - 1) * half_v;
  };
}

/// Sixth of an ellipsoid: a cube's face blown up to it.
inline Patch sixth_patch(int axis, double side, Eigen::Vector3d radii) {
  return [=](double u, double v) -> Eigen::Vector3d {
    Eigen::Vector3d p;
    p[axis] = side;
    p[(axis + 1) % 3] = 2 * u - 1;
    p[(axis + 2) % 3] = 2 * v - 1;
    return p.normalized().cwiseProduct(radii);
  };
}

inline Patch side_patch(double radius, double half) {
  return [=](double u, double v) -> Eigen::Vector3d {
    const double angle = 2 * std::numbers::pi * u;
    return {radius * std::cos(angle), radius * std::sin(angle), (2 * v - 1) * half};
  };
}

inline Patch disc_patch(double radius, double z) {
  return [=](double u, double v) -> Eigen::Vector3d {
    const double angle = 2 * std::numbers::pi * u;
    return {v * radius * std::cos(angle), v * radius * std::sin(angle), z};
  };
}

/// Cap of a capsule, above z = half or, with side = -1, below z = -half.
inline Patch cap_patch(double radius, double half, double side) {
  return [=](double u, double v) -> Eigen::Vector3d {
    const double angle = 2 * std::numbers::pi * u, height = 0.5 * std::numbers::pi * v;
    return {radius * std::cos(height) * std::cos(angle),
            radius * std::cos(height) * std::sin(angle), side * (half + radius * std::sin(height))};
  };
}

inline std::vector<Patch> local_patches(const Shape& shape) {
  const Eigen::Vector3d s = shape.size;
  std::vector<Patch> patches;
  const auto sixths = [&](const Eigen::Vector3d& radii) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) patches.push_back(sixth_patch(axis, side, radii));
    }
  };
  using Eigen::Vector3d;
  switch (shape.kind) {
    case ShapeKind::plane:
      patches.push_back(
          face_patch({0, 0, 0}, s.x() * Vector3d::UnitX(), s.y() * Vector3d::UnitY()));
      break;
    case ShapeKind::box:
      for (int axis = 0; axis < 3; ++axis) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        for (const double side : {-1.0, 1.0}) {
          patches.push_back(face_patch(side * s[axis] * Vector3d::Unit(axis),
                                       s[a] * Vector3d::Unit(a), s[b] * Vector3d::Unit(b)));
        }
      }
      break;
    case ShapeKind::sphere:
      sixths(Vector3d::Constant(s.x()));
      break;
    case ShapeKind::ellipsoid:
      sixths(s);
      break;
    case ShapeKind::cylinder:
      patches = {side_patch(s.x(), s.y()), disc_patch(s.x(), s.y()), disc_patch(s.x(), -s.y())};
      break;
    case ShapeKind::capsule:
      patches = {side_patch(s.x(), s.y()), cap_patch(s.x(), s.y(), 1), cap_patch(s.x(), s.y(), -1)};
      break;
    case ShapeKind::mesh:
      for (const Triangle& t : shape.triangles) {
        patches.push_back([t](double u, double v) -> Vector3d {
          return t[0] + u * ((1 - v) * (t[1] - t[0]) + v * (t[2] - t[0]));
        });
      }
      break;
  }
  return patches;
}

/// Patches of the shape's whole surface in the map frame.
inline std::vector<Patch> patches_of(const Shape& shape, const Pose& T_map_world) {
  const Pose T_map_shape = T_map_world * shape.T_world_shape;
  std::vector<Patch> patches;
  for (const Patch& local : local_patches(shape)) {
    patches.push_back(
        [=](double u, double v) -> Eigen::Vector3d { return T_map_shape * local(u, v); });
  }
  return patches;
}

inline double distance_to_box(const Eigen::Vector3d& p, const Eigen::AlignedBox3d& box) {
  return (p - p.cwiseMax(box.min()).cwiseMin(box.max())).norm();
}

/// Least distance of a patch to a box by sampling n x n points and refining the best few by a
/// pattern search. An upper bound, and for patches of gentle curvature the distance to about 1e-9
/// m.
inline double sampled_distance(const Patch& patch, const Eigen::AlignedBox3d& box, int n) {
  struct Start {
    double distance, u, v;
  };
  std::vector<Start> starts;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double u = double(i) / n, v = double(j) / n;
      starts.push_back({distance_to_box(patch(u, v), box), u, v});
    }
  }
  const std::size_t kept = std::min<std::size_t>(4, starts.size());
  std::partial_sort(starts.begin(), starts.begin() + static_cast<long>(kept), starts.end(),
                    [](const Start& a, const Start& b) { return a.distance < b.distance; });
  double least = starts[0].distance;
  for (std::size_t s = 0; s < kept; ++s) {
    Start best = starts[s];
    for (double step = 1.0 / n; step > 1e-12 && best.distance > 0;) {
      bool better = false;
      for (int direction = 0; direction < 16; ++direction) {
        const double angle = direction * std::numbers::pi / 8;
        const double u = std::clamp(best.u + step * std::cos(angle), 0.0, 1.0);
        const double v = std::clamp(best.v + step * std::sin(angle), 0.0, 1.0);
        const double d = distance_to_box(patch(u, v), box);
        if (d < best.distance) {
          best = {d, u, v};
          better = true;
        }
      }
      if (!better) step *= 0.5;
    }
    least = std::min(least, best.distance);
  }
  return least;
}

inline double sampled_distance(const std::vector<Patch>& patches, const Eigen::AlignedBox3d& box,
                               int n) {
  double least = std::numeric_limits<double>::infinity();
  for (const Patch& patch : patches) least = std::min(least, sampled_distance(patch, box, n));
  return least;
}

inline Pose random_pose(RandomStream& random, double reach_m) {
  Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
  Pose pose = Pose::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  for (int i = 0; i < 3; ++i) pose.translation()[i] = reach_m * (2 * random.uniform() - 1);
  return pose;
}

/// A shape of some 0.1 to 0.4 m at a random pose.
inline Shape random_shape(ShapeKind kind, RandomStream& random, double reach_m = 0.5) {
  Shape shape;
  shape.kind = kind;
  shape.T_world_shape = random_pose(random, reach_m);
  for (int i = 0; i < 3; ++i) shape.size[i] = 0.05 + 0.15 * random.uniform();
  if (kind == ShapeKind::mesh) {
    Triangle triangle;
    for (auto& corner : triangle) {
      for (int i = 0; i < 3; ++i) corner[i] = 0.4 * random.uniform() - 0.2;
    }
    shape.triangles = {triangle};
  }
  return shape;
}

inline constexpr std::array<ShapeKind, 7> kAllKinds{
    ShapeKind::plane,    ShapeKind::sphere, ShapeKind::capsule, ShapeKind::ellipsoid,
    ShapeKind::cylinder, ShapeKind::box,    ShapeKind::mesh};

}  // namespace mapscore::eval::test
