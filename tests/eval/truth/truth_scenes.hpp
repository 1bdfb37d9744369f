// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/shape.hpp"
#include "eval/truth/surface_truth.hpp"

#include <vector>

namespace mapscore::eval::test {

inline constexpr double kEdge = 0.1;

/// Classes 0 background, 1 red, 2 green, 3 blue; instance n is of class n.
inline ClassTable four_classes() {
  ClassTable table;
  table.classes = {{0, "background", {128, 128, 128}, false},
                   {1, "red", {255, 0, 0}, true},
                   {2, "green", {0, 255, 0}, true},
                   {3, "blue", {0, 0, 255}, true}};
  table.instances = {{0, "background", 0}, {1, "red_1", 1}, {2, "green_1", 2}, {3, "blue_1", 3}};
  return table;
}

/// Axis-aligned box from corner to corner.
inline Shape box_shape(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                       InstanceId instance) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.instance = instance;
  shape.size = 0.5 * (high - low);
  shape.T_world_shape.translation() = 0.5 * (low + high);
  return shape;
}

/// Surface truth in the world's own frame.
inline SurfaceTruth truth_of(const std::vector<Shape>& shapes, double edge_m,
                             double epsilon_m = 0) {
  return surface_truth(shapes, four_classes(), Pose::Identity(), {edge_m, epsilon_m, 1});
}

inline std::size_t touch_only_count(const SurfaceTruth& truth) {
  std::size_t count = 0;
  for (const SurfaceVoxel& voxel : truth.voxels()) count += voxel.touch_only;
  return count;
}

}  // namespace mapscore::eval::test
