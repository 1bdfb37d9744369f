// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/objects/true_objects.hpp"

#include "core/error.hpp"
#include "core/geometry/depth_rays.hpp"
#include "eval/truth/shapes/shape_tests.hpp"

#include <fmt/format.h>

namespace mapscore::eval {
namespace {

/// Half lengths of a primitive's least box along its own axes.
Eigen::Vector3d half_of(const Shape& shape) {
  const Eigen::Vector3d& s = shape.size;
  switch (shape.kind) {
    case ShapeKind::plane:
      return {s.x(), s.y(), 0.0};
    case ShapeKind::sphere:
      return Eigen::Vector3d::Constant(s.x());
    case ShapeKind::capsule:
      return {s.x(), s.x(), s.y() + s.x()};
    case ShapeKind::cylinder:
      return {s.x(), s.x(), s.y()};
    case ShapeKind::ellipsoid:
    case ShapeKind::box:
    case ShapeKind::mesh:
      break;
  }
  return s;
}

}  // namespace

ObjectBox box_about(const Shape& shape) {
  if (shape.kind != ShapeKind::mesh) return {shape.T_world_shape, 2.0 * half_of(shape)};
  Eigen::AlignedBox3d bounds;
  for (const Triangle& triangle : shape.triangles)
    for (const Eigen::Vector3d& corner : triangle) bounds.extend(corner);
  if (bounds.isEmpty()) return {shape.T_world_shape, Eigen::Vector3d::Zero()};
  return moved(shape.T_world_shape, oriented(bounds));
}

std::vector<Eigen::AlignedBox3d> surface_boxes(const std::vector<Shape>& shapes,
                                               const Pose& T_map_world,
                                               std::size_t instance_count) {
  std::vector<Eigen::AlignedBox3d> boxes(instance_count);
  for (const PreparedShape& piece : prepare(shapes, T_map_world))
    if (piece.instance() < instance_count) boxes[piece.instance()].extend(piece.bounds());
  return boxes;
}

void SeenInstances::add(const Frame& frame, const Calibration& true_calibration,
                        const Pose& T_map_base) {
  const cv::Size size(true_calibration.depth.width_px, true_calibration.depth.height_px);
  if (frame.depth.size() != size || frame.depth_label.size() != size)
    throw Error(
        fmt::format("frame {}: depth and depth_label must have the depth camera's size, "
                    "{} x {}; check recording.yaml and that both images were read",
                    frame.index, size.width, size.height));
  const DepthRays rays(true_calibration.depth);
  const Pose T_map_depth = T_map_base * true_calibration.T_base_depth;
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u) {
      const InstanceId instance = frame.depth_label(v, u);
      if (frame.depth(v, u) == 0 || instance == 0 || instance >= samples_.size()) continue;
      const double z = frame.depth(v, u) / kDepthUnitsPerMetre;
      if (z < true_calibration.range_min_m || z > true_calibration.range_max_m) continue;
      ++samples_[instance];
      boxes_[instance].extend(T_map_depth * rays.point(u, v, z));
    }
}

std::vector<TrueObject> visible_objects(const std::vector<Eigen::AlignedBox3d>& boxes,
                                        const SeenInstances& seen, const ClassTable& table,
                                        std::int64_t min_samples) {
  std::vector<TrueObject> objects;
  for (const Instance& instance : table.instances)
    if (table.detected(instance.class_id) && seen.samples().at(instance.id) >= min_samples &&
        !boxes.at(instance.id).isEmpty())
      objects.push_back({instance.id, instance.class_id, oriented(boxes[instance.id])});
  return objects;
}

std::vector<PerceivedModel> models_of(const std::vector<Shape>& shapes, const Pose& T_map_world,
                                      const ClassTable& table, bool by_surface) {
  std::vector<std::vector<ObjectBox>> parts(table.instances.size());
  if (by_surface) {
    for (const Shape& shape : shapes)
      if (shape.instance < parts.size())
        parts[shape.instance].push_back(moved(T_map_world, box_about(shape)));
  } else {
    const auto boxes = surface_boxes(shapes, T_map_world, table.instances.size());
    for (std::size_t n = 0; n < boxes.size(); ++n)
      if (!boxes[n].isEmpty()) parts[n].push_back(oriented(boxes[n]));
  }
  std::vector<PerceivedModel> models;
  for (const Instance& instance : table.instances)
    if (table.detected(instance.class_id) && !parts[instance.id].empty())
      models.push_back({instance.id, std::move(parts[instance.id])});
  return models;
}

}  // namespace mapscore::eval
