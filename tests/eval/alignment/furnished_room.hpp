// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"
#include "core/random_stream.hpp"

#include <Eigen/Geometry>
#include <vector>

namespace mapscore::testing {

inline Shape box_at(const Eigen::Vector3d& centre, const Eigen::Vector3d& half) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.T_world_shape.translation() = centre;
  shape.size = half;
  return shape;
}

/// Four walls and a floor, 10 cm thick: 4 m by 3 m by 2 m within.
inline std::vector<Shape> empty_room() {
  return {box_at({2, 1.5, -0.05}, {2.1, 1.6, 0.05}), box_at({-0.05, 1.5, 1}, {0.05, 1.6, 1}),
          box_at({4.05, 1.5, 1}, {0.05, 1.6, 1}), box_at({2, -0.05, 1}, {2, 0.05, 1}),
          box_at({2, 3.05, 1}, {2, 0.05, 1})};
}

/// The room with things in it that no turn and no mirror leaves as they are.
inline std::vector<Shape> furnished_room() {
  std::vector<Shape> shapes = empty_room();
  shapes.push_back(box_at({0.412, 0.613, 0.453}, {0.407, 0.609, 0.449}));
  shapes.push_back(box_at({2.933, 2.711, 0.871}, {0.318, 0.284, 0.866}));
  shapes.push_back(box_at({1.737, 1.218, 0.737}, {0.511, 0.302, 0.018}));
  return shapes;
}

/// Points of the faces that look into the room: of the walls, the floor and the things on it.
inline std::vector<Eigen::Vector3d> inside_points(const std::vector<Shape>& shapes,
                                                  std::size_t count) {
  RandomStream random(7, "points");
  const auto below = [&](std::size_t most) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(most));
  };
  const auto side = [&] { return 2 * random.uniform() - 1; };
  std::vector<Eigen::Vector3d> points;
  while (points.size() < count) {
    const Shape& shape = shapes[below(shapes.size())];
    Eigen::Vector3d p(side(), side(), side());
    const auto axis = static_cast<Eigen::Index>(below(3));
    p[axis] = p[axis] < 0 ? -1 : 1;
    p = shape.T_world_shape * p.cwiseProduct(shape.size).eval();
    constexpr double kSlack_m = 1e-9;
    const bool is_inside = p.x() > -kSlack_m && p.x() < 4 + kSlack_m && p.y() > -kSlack_m &&
                           p.y() < 3 + kSlack_m && p.z() > -kSlack_m;
    if (is_inside) points.push_back(p);
  }
  return points;
}

}  // namespace mapscore::testing
