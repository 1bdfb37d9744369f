// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/frame.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/shape.hpp"
#include "core/objects/simulated_perception.hpp"
#include "eval/objects/object_score.hpp"

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace mapscore::eval {

/// Bounds of the exact surfaces of each instance along the map's axes, by instance id; empty for
/// instances without a surface.
[[nodiscard]] std::vector<Eigen::AlignedBox3d> surface_boxes(const std::vector<Shape>& shapes,
                                                             const Pose& T_map_world,
                                                             std::size_t instance_count);

/// What frames saw of each instance: noise-free depth samples, and their bounds along the map's
/// axes. Not thread-safe.
class SeenInstances {
 public:
  explicit SeenInstances(std::size_t instance_count)
      : samples_(instance_count), boxes_(instance_count) {}

  /// Reads `depth` and `depth_label`; samples as SampleCounter takes them. Throws Error naming the
  /// frame when an image has another size than the camera.
  void add(const Frame& frame, const Calibration& true_calibration, const Pose& T_map_base);

  /// By instance id.
  [[nodiscard]] const std::vector<std::int64_t>& samples() const { return samples_; }
  [[nodiscard]] const std::vector<Eigen::AlignedBox3d>& boxes() const { return boxes_; }

 private:
  std::vector<std::int64_t> samples_;
  std::vector<Eigen::AlignedBox3d> boxes_;
};

/// The instances of detected classes with at least `min_samples` samples, ascending, with these
/// boxes (by instance id), of which empty ones are left out.
[[nodiscard]] std::vector<TrueObject> visible_objects(const std::vector<Eigen::AlignedBox3d>& boxes,
                                                      const SeenInstances& seen,
                                                      const ClassTable& table,
                                                      std::int64_t min_samples = 1);

/// The true boxes that simulated perception knows: one about each instance of a detected class or,
/// with `by_surface`, about each of its drawn surfaces, along the surface's own axes.
[[nodiscard]] std::vector<PerceivedModel> models_of(const std::vector<Shape>& shapes,
                                                    const Pose& T_map_world,
                                                    const ClassTable& table, bool by_surface);

/// The least box about a shape along its own axes, in the world.
[[nodiscard]] ObjectBox box_about(const Shape& shape);

}  // namespace mapscore::eval
