// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/frame.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/shape.hpp"
#include "core/objects/map_object.hpp"
#include "core/objects/simulated_perception.hpp"

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mapscore::eval {

/// One object that is really there, in the map frame.
struct TrueObject {
  InstanceId instance = 0;
  ClassId class_id = kBackground;
  ObjectBox box;
};

/// Bounds of the exact surfaces of each instance along the map's axes, by instance id; empty for
/// instances without a surface.
[[nodiscard]] std::vector<Eigen::AlignedBox3d> surface_boxes(const std::vector<Shape>& shapes,
                                                             const Pose& T_map_world,
                                                             std::size_t instance_count);

/// What frames saw of each instance: bounds of its noise-free depth samples along the map's axes.
/// Not thread-safe.
class SeenInstances {
 public:
  explicit SeenInstances(std::size_t instance_count) : boxes_(instance_count) {}

  /// Reads `depth` and `depth_label`; samples as SampleCounter takes them. Throws Error naming the
  /// frame when an image has another size than the camera.
  void add(const Frame& frame, const Calibration& true_calibration, const Pose& T_map_base);

  /// By instance id; empty where nothing was seen.
  [[nodiscard]] const std::vector<Eigen::AlignedBox3d>& boxes() const { return boxes_; }

 private:
  std::vector<Eigen::AlignedBox3d> boxes_;
};

/// The instances of detected classes that were seen, ascending, with these boxes (by instance id),
/// of which empty ones are left out.
[[nodiscard]] std::vector<TrueObject> visible_objects(const std::vector<Eigen::AlignedBox3d>& boxes,
                                                      const SeenInstances& seen,
                                                      const ClassTable& table);

/// The true boxes that simulated perception knows: one about each instance of a detected class or,
/// with `by_surface`, about each of its drawn surfaces, along the surface's own axes.
[[nodiscard]] std::vector<PerceivedModel> models_of(const std::vector<Shape>& shapes,
                                                    const Pose& T_map_world,
                                                    const ClassTable& table, bool by_surface);

/// Counts of one class or of several together, and sums of errors over the found ones.
struct ObjectCounts {
  std::int64_t truth = 0, found = 0, objects = 0;
  double iou_sum = 0.0, centre_sum_m = 0.0, centre_max_m = 0.0;
  Eigen::Vector3d size_sum_m = Eigen::Vector3d::Zero();      ///< of absolute errors, by axis
  Eigen::Vector3d size_share_sum = Eigen::Vector3d::Zero();  ///< of absolute shares, by axis

  [[nodiscard]] std::int64_t missed() const { return truth - found; }
  [[nodiscard]] std::int64_t falsely() const { return objects - found; }
  /// A sum over the found ones as their mean; none where nothing was found.
  [[nodiscard]] std::optional<double> mean(double sum) const {
    return found ? std::optional(sum / static_cast<double>(found)) : std::nullopt;
  }
  ObjectCounts& operator+=(const ObjectCounts& other);
};

/// By class id. An object may stand for a true one of its class when their boxes, each 25 mm wider
/// on every side, have an IoU of 0.1 or more, or their centres lie within 0.1 m. Such pairs are
/// taken from the greatest IoU on, then the least distance of centres; ties to the lower position
/// of truth, then object. Each once. Sizes are those of the bounds along the map's axes; shares are
/// of the true size, widened as for the IoU.
[[nodiscard]] std::vector<ObjectCounts> score_objects(std::span<const MapObject> objects,
                                                      std::span<const TrueObject> truth,
                                                      std::size_t class_count);

}  // namespace mapscore::eval
