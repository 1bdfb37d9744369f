// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/distances/thin_score.hpp"

#include "eval/truth/shapes/shape_tests.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace mapscore::eval {
namespace {

constexpr double kSame_m = 1e-9;  // distances that differ by less are equal

/// Widths along the axes of the shape's own frame.
Eigen::Vector3d extents_of(const Shape& shape) {
  const Eigen::Vector3d& s = shape.size;
  switch (shape.kind) {
    case ShapeKind::plane:
      return {2 * s.x(), 2 * s.y(), 0.0};
    case ShapeKind::sphere:
      return Eigen::Vector3d::Constant(2 * s.x());
    case ShapeKind::capsule:
      return {2 * s.x(), 2 * s.x(), 2 * (s.x() + s.y())};
    case ShapeKind::cylinder:
      return {2 * s.x(), 2 * s.x(), 2 * s.y()};
    case ShapeKind::ellipsoid:
    case ShapeKind::box:
      return 2 * s;
    case ShapeKind::mesh:
      break;
  }
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : shape.triangles)
    for (const Eigen::Vector3d& corner : triangle) box.extend(corner);
  return box.sizes();
}

}  // namespace

bool is_thin(const Shape& shape) {
  return (extents_of(shape).array() < kThin_m).count() >= 2;
}

CubeDistance distance_to_thin(const std::vector<Shape>& shapes, const ClassTable& table,
                              const Pose& T_map_world, double edge_m) {
  std::vector<Shape> thin;
  std::copy_if(shapes.begin(), shapes.end(), std::back_inserter(thin), is_thin);
  return cube_distance(prepare(thin, T_map_world), table, edge_m);
}

void score_thin(const MapSnapshot& map, double threshold, const SurfaceTruth& surface,
                const VisibleTruth& visible, const ThinDistances& distances, Counts& counts) {
  for (ClassCounts& of_class : counts) of_class.thin.emplace();
  const auto is_thin_part = [&](const VoxelKey& key, ClassId class_id) {
    const double to_thin = distances.to_thin(key, class_id);
    return std::isfinite(to_thin) && to_thin <= distances.to_class(key, class_id) + kSame_m;
  };
  for (const MapVoxel& voxel : map.voxels()) {
    if (!predicted(voxel, threshold) || !is_thin_part(voxel.key, voxel.best_class)) continue;
    ThinCounts& thin = *counts.at(voxel.best_class).thin;
    ++thin.predicted;
    thin.true_predicted += surface.contains(voxel.key, voxel.best_class);
  }
  for (const VisibleVoxel& truth : visible.voxels()) {
    if (!is_thin_part(truth.key, truth.owner)) continue;
    ThinCounts& thin = *counts.at(truth.owner).thin;
    ++thin.visible;
    const MapVoxel* voxel = map.find(truth.key);
    thin.found +=
        voxel != nullptr && predicted(*voxel, threshold) && voxel->best_class == truth.owner;
  }
}

}  // namespace mapscore::eval
