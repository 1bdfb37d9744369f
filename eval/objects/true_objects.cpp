// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/objects/true_objects.hpp"

#include "core/error.hpp"
#include "core/geometry/depth_rays.hpp"
#include "eval/truth/shapes/shape_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

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
    default:
      return s;
  }
}

/// The least box about a shape along its own axes, in the world.
ObjectBox box_about(const Shape& shape) {
  if (shape.kind != ShapeKind::mesh) return {shape.T_world_shape, 2.0 * half_of(shape)};
  Eigen::AlignedBox3d bounds;
  for (const Triangle& triangle : shape.triangles)
    for (const Eigen::Vector3d& corner : triangle) bounds.extend(corner);
  if (bounds.isEmpty()) return {shape.T_world_shape, Eigen::Vector3d::Zero()};
  return moved(shape.T_world_shape, oriented(bounds));
}

/// Of score_objects().
constexpr double kMinIou = 0.1, kMaxDistance_m = 0.1, kMargin_m = 0.025;

/// Of one pair that was matched.
struct ObjectMatch {
  std::size_t truth = 0, object = 0;  ///< positions
  double iou = 0.0;                   ///< of the widened boxes
  double centre_m = 0.0;              ///< distance of the centres
};

/// Ascending by truth.
std::vector<ObjectMatch> match_objects(std::span<const MapObject> objects,
                                       std::span<const TrueObject> truth) {
  std::vector<ObjectMatch> pairs;
  for (std::size_t t = 0; t < truth.size(); ++t) {
    for (std::size_t o = 0; o < objects.size(); ++o) {
      if (truth[t].class_id != objects[o].class_id) continue;
      const ObjectBox &real = truth[t].box, &mapped = objects[o].box;
      const ObjectMatch pair{t, o, iou(mapped.widened(kMargin_m), real.widened(kMargin_m)),
                             (mapped.centre() - real.centre()).norm()};
      if (pair.iou >= kMinIou || pair.centre_m <= kMaxDistance_m) pairs.push_back(pair);
    }
  }
  std::ranges::sort(pairs, {}, [](const ObjectMatch& pair) {
    return std::tuple(-pair.iou, pair.centre_m, pair.truth, pair.object);
  });
  std::vector<bool> truth_taken(truth.size()), object_taken(objects.size());
  std::erase_if(pairs, [&](const ObjectMatch& pair) {
    if (truth_taken[pair.truth] || object_taken[pair.object]) return true;
    truth_taken[pair.truth] = object_taken[pair.object] = true;
    return false;
  });
  std::ranges::sort(pairs, {}, &ObjectMatch::truth);
  return pairs;
}

}  // namespace

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
      if (frame.depth(v, u) == 0 || instance == 0 || instance >= boxes_.size()) continue;
      const double z = frame.depth(v, u) / kDepthUnitsPerMetre;
      if (z < true_calibration.range_min_m || z > true_calibration.range_max_m) continue;
      boxes_[instance].extend(T_map_depth * rays.point(u, v, z));
    }
}

std::vector<TrueObject> visible_objects(const std::vector<Eigen::AlignedBox3d>& boxes,
                                        const SeenInstances& seen, const ClassTable& table) {
  std::vector<TrueObject> objects;
  for (const Instance& instance : table.instances)
    if (table.detected(instance.class_id) && !seen.boxes().at(instance.id).isEmpty() &&
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

ObjectCounts& ObjectCounts::operator+=(const ObjectCounts& other) {
  truth += other.truth;
  found += other.found;
  objects += other.objects;
  iou_sum += other.iou_sum;
  centre_sum_m += other.centre_sum_m;
  centre_max_m = std::max(centre_max_m, other.centre_max_m);
  size_sum_m += other.size_sum_m;
  size_share_sum += other.size_share_sum;
  return *this;
}

std::vector<ObjectCounts> score_objects(std::span<const MapObject> objects,
                                        std::span<const TrueObject> truth,
                                        std::size_t class_count) {
  std::vector<ObjectCounts> counts(class_count);
  for (const TrueObject& real : truth) ++counts.at(real.class_id).truth;
  for (const MapObject& object : objects) ++counts.at(object.class_id).objects;
  for (const ObjectMatch& match : match_objects(objects, truth)) {
    const TrueObject& real = truth[match.truth];
    const Eigen::Vector3d true_size = real.box.bounds().sizes();
    const Eigen::Vector3d error_m = objects[match.object].box.bounds().sizes() - true_size;
    ObjectCounts& of_class = counts[real.class_id];
    ++of_class.found;
    of_class.iou_sum += match.iou;
    of_class.centre_sum_m += match.centre_m;
    of_class.centre_max_m = std::max(of_class.centre_max_m, match.centre_m);
    of_class.size_sum_m += error_m.cwiseAbs();
    of_class.size_share_sum +=
        (error_m.array() / (true_size.array() + 2.0 * kMargin_m)).abs().matrix();
  }
  return counts;
}

}  // namespace mapscore::eval
