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
  /// Least covers of its latest detections along the axes of `box`, in coordinates with these axes
  /// and the map's origin; what the quantile rule reads (object_merge.hpp). Not in files.
  std::vector<Eigen::AlignedBox3d> views{};
};

}  // namespace mapscore
