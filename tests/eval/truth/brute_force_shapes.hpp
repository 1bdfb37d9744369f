// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"
#include "tests/eval/truth/surface_patches.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

/// Shapes for the brute-force check of surface truth. Metres.
namespace mapscore::eval::test {

/// Ball of 80 triangles: an icosahedron with each side cut into four, all corners at `radius`.
inline std::vector<Triangle> icosphere(double radius) {
  using Eigen::Vector3d;
  constexpr double kPhi = std::numbers::phi;
  const std::array<Vector3d, 12> corners{Vector3d{-1, kPhi, 0}, {1, kPhi, 0},   {-1, -kPhi, 0},
                                         {1, -kPhi, 0},         {0, -1, kPhi},  {0, 1, kPhi},
                                         {0, -1, -kPhi},        {0, 1, -kPhi},  {kPhi, 0, -1},
                                         {kPhi, 0, 1},          {-kPhi, 0, -1}, {-kPhi, 0, 1}};
  std::vector<Triangle> triangles;
  const auto blow_up = [radius](const Vector3d& p) -> Vector3d { return radius * p.normalized(); };
  // The sides of an icosahedron of edge 2 are its triples of corners that are 2 apart.
  const auto apart2 = [&](int a, int b) {
    return std::abs((corners[a] - corners[b]).norm() - 2) < 1e-9;
  };
  for (int a = 0; a < 12; ++a) {
    for (int b = a + 1; b < 12; ++b) {
      for (int c = b + 1; c < 12; ++c) {
        if (!apart2(a, b) || !apart2(b, c) || !apart2(a, c)) continue;
        const Vector3d p = blow_up(corners[a]), q = blow_up(corners[b]), r = blow_up(corners[c]);
        const Vector3d pq = blow_up(p + q), qr = blow_up(q + r), pr = blow_up(p + r);
        triangles.insert(triangles.end(), {{p, pq, pr}, {q, qr, pq}, {r, pr, qr}, {pq, qr, pr}});
      }
    }
  }
  return triangles;
}

/// Open strip of `count` squares of edge `step_m` along x, each of two triangles; it climbs by
/// `rise_m` at every second square.
inline std::vector<Triangle> strip(int count, double step_m, double rise_m) {
  std::vector<Triangle> triangles;
  const auto at = [&](int i, int side) {
    return Eigen::Vector3d(i * step_m, side * step_m, (i / 2) * rise_m);
  };
  for (int i = 0; i < count; ++i) {
    triangles.push_back({at(i, 0), at(i + 1, 0), at(i, 1)});
    triangles.push_back({at(i + 1, 0), at(i + 1, 1), at(i, 1)});
  }
  return triangles;
}

/// Closed mesh of a box's 12 triangles.
inline std::vector<Triangle> box_mesh(const Eigen::Vector3d& half) {
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto at = [&](double u, double v) {
        Eigen::Vector3d p;
        p[axis] = side * half[axis];
        p[(axis + 1) % 3] = u * half[(axis + 1) % 3];
        p[(axis + 2) % 3] = v * half[(axis + 2) % 3];
        return p;
      };
      triangles.push_back({at(-1, -1), at(1, -1), at(-1, 1)});
      triangles.push_back({at(1, -1), at(1, 1), at(-1, 1)});
    }
  }
  return triangles;
}

inline Shape placed(ShapeKind kind, const Eigen::Vector3d& size, const Eigen::Vector3d& centre,
                    std::vector<Triangle> triangles = {}) {
  Shape shape;
  shape.kind = kind;
  shape.instance = 1;
  shape.size = size;
  shape.T_world_shape.translation() = centre;
  shape.triangles = std::move(triangles);
  return shape;
}

/// The same shape turned by 90 degrees so that its z axis comes to lie along x; exact.
inline Shape laid_down(Shape shape) {
  shape.T_world_shape.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return shape;
}

/// Decimal sizes and places, upright: faces, tips and rims fall onto the lattices of 1 to 10 cm
/// (the first of each kind), within voxels (the second), half way, or 1.5e-9 m short of the
/// lattice.
inline std::vector<Shape> upright_shapes(ShapeKind kind) {
  constexpr double kShort = 1.5e-9;
  switch (kind) {
    case ShapeKind::box:
      return {placed(kind, {0.1, 0.05, 0.15}, {0.3, -0.15, 0.25}),
              placed(kind, {0.083, 0.047, 0.131}, {0.3004, -0.1507, 0.2481}),
              placed(kind, {0.1, 0.05, 0.15}, {0.3, -0.125, 0.2503}),
              placed(kind, {0.1 - kShort, 0.05 - kShort, 0.15 - kShort}, {0.3, -0.15, 0.25})};
    case ShapeKind::plane:
      return {placed(kind, {0.2, 0.1, 0}, {0.1, 0.3, 0}),
              placed(kind, {0.2, 0.1, 0}, {0.1, 0.3, 1e-9}),
              placed(kind, {0.187, 0.113, 0}, {0.1017, 0.2994, -0.3003})};
    case ShapeKind::sphere:
      return {placed(kind, {0.1, 0, 0}, {0.2, -0.1, 0.3}),
              placed(kind, {0.123, 0, 0}, {0.2104, -0.1007, 0.3}),
              placed(kind, {0.1 - kShort, 0, 0}, {0.2, -0.1, 0.3})};
    case ShapeKind::ellipsoid:
      return {placed(kind, {0.1, 0.2, 0.05}, {0.2, -0.1, 0.35}),
              placed(kind, {0.087, 0.212, 0.041}, {0.2031, -0.1, 0.3533}),
              placed(kind, {0.1 - kShort, 0.2 - kShort, 0.05 - kShort}, {0.2, -0.1, 0.35})};
    case ShapeKind::cylinder:
    case ShapeKind::capsule:
      return {placed(kind, {0.1, 0.15, 0}, {0.2, -0.1, 0.25}),
              placed(kind, {0.083, 0.142, 0}, {0.2011, -0.1, 0.2507}),
              placed(kind, {0.1 - kShort, 0.15 - kShort, 0}, {0.2, -0.1, 0.25})};
    case ShapeKind::mesh:
      return {placed(kind, {0, 0, 0}, {0.3, -0.15, 0.25}, box_mesh({0.1, 0.05, 0.15})),
              placed(kind, {0, 0, 0}, {0.1, 0.2, -0.3}, strip(6, 0.05, 0.05)),
              placed(kind, {0, 0, 0}, {0.2, -0.1, 0.3}, icosphere(0.1))};
  }
  return {};
}

/// The kind's shapes at any angle: tilted boxes and planes, meshes closed and open.
inline std::vector<Shape> tilted_shapes(ShapeKind kind, int count) {
  RandomStream random(31, name_of(kind));
  std::vector<Shape> shapes;
  for (int i = 0; i < count; ++i) {
    Shape shape = random_shape(kind, random);
    shape.instance = 1;
    if (kind == ShapeKind::mesh) {
      shape.triangles = i % 2 == 0 ? icosphere(0.08 + 0.05 * random.uniform())
                                   : strip(7, 0.02 + 0.05 * random.uniform(), 0.03);
    }
    shapes.push_back(shape);
  }
  return shapes;
}

}  // namespace mapscore::eval::test
