// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/objects/object_box.hpp"

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace mapscore {

/// Of one object of a map, from 1; never given twice by one map.
using ObjectId = std::uint32_t;

/// What one frame says of one object: a box in the map frame. `model`: a file that shows it, or
/// nothing: its box does.
struct ObjectDetection {
  ClassId class_id = kBackground;
  ObjectBox box;
  double score = 1.0;  ///< confidence of the detection, in (0, 1]
  std::string model{};
};

/// One object of a map, [N]'s <type, pose, size, model> and what is known of it: class, box in the
/// map frame, and a model file (empty: the box is the model).
struct MapObject {
  ObjectId id = 0;
  ClassId class_id = kBackground;
  ObjectBox box;
  std::string model{};
  double last_seen_s = 0.0;  ///< stamp of the last detection
  int observations = 0;      ///< detections that it is made of
  int misses = 0;            ///< frames in which it should have been seen and was not
  int age = 0;               ///< of these, since the last detection
  /// (1 + sum of its detections' scores) / (2 + observations + misses), Laplace's rule.
  double confidence = 0.5;
  /// Least covers of its latest 200 detections along the axes of `box`, in coordinates with these
  /// axes and the map's origin; what the quantile rule reads. Not in files.
  std::vector<Eigen::AlignedBox3d> views{};
};

/// How a box takes in another of the same object, face by face along its own axes; the other stands
/// in with its least cover along these.
enum class BoxUpdate {
  hull,     ///< the farther face stands: right for exact views of parts
  mean,     ///< mean of the faces, weighted by observations: wrong views wash out, parts shrink it
  quantile  ///< quantile of each face over the views, counted outwards: few wrong views and many
            ///< parts do nothing
};

/// The rule, and for `quantile` its share s in (0, 1]: of n views each face is the ceil(s n)-th,
/// counted outwards; 1: the hull of the views.
struct BoxMerge {
  BoxUpdate rule = BoxUpdate::quantile;
  double share = 0.75;
};

/// `object` after one more detection, at `stamp_s`: box, observations, confidence, age 0. Its model
/// stays unless the detection names one. An object without views (of a file) counts as
/// `observations` views of its box.
[[nodiscard]] MapObject updated(const MapObject& object, const ObjectDetection& detection,
                                double stamp_s, const BoxMerge& merge);

/// Two objects that turned out to be one: id of the lower, axes of the one with more observations
/// (ties: the lower id), counts added, the later stamp with its age (ties: the lesser age).
[[nodiscard]] MapObject merged(const MapObject& a, const MapObject& b, const BoxMerge& merge);

/// `object` after a frame in which it should have been seen and was not.
[[nodiscard]] MapObject missed(const MapObject& object);

}  // namespace mapscore
