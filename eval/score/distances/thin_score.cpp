// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/distances/thin_score.hpp"

#include "eval/truth/shapes/shape_tests.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace mapscore::eval {
namespace {

constexpr double kSame_m = 1e-9;  // distances that differ by less are equal

/// Widths along the axes of the shape's own frame.
std::array<double, 3> extents_of(const Shape& shape) {
  const Eigen::Vector3d& s = shape.size;
  switch (shape.kind) {
    case ShapeKind::plane:
      return {2 * s.x(), 2 * s.y(), 0.0};
    case ShapeKind::sphere:
      return {2 * s.x(), 2 * s.x(), 2 * s.x()};
    case ShapeKind::capsule:
      return {2 * s.x(), 2 * s.x(), 2 * (s.x() + s.y())};
    case ShapeKind::cylinder:
      return {2 * s.x(), 2 * s.x(), 2 * s.y()};
    case ShapeKind::ellipsoid:
    case ShapeKind::box:
      return {2 * s.x(), 2 * s.y(), 2 * s.z()};
    case ShapeKind::mesh:
      break;
  }
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;
  for (const Triangle& triangle : shape.triangles)
    for (const Eigen::Vector3d& corner : triangle) {
      low = low.min(corner.array());
      high = high.max(corner.array());
    }
  return {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
}

}  // namespace

bool is_thin(const Shape& shape) {
  const std::array<double, 3> extents = extents_of(shape);
  return std::count_if(extents.begin(), extents.end(), [](double e) { return e < kThin_m; }) >= 2;
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
