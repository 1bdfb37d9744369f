// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

#include <Eigen/Core>
#include <vector>

namespace mapscore {

/// What one detection adds to an observation: positions in the sensor frame (depth_optical,
/// metres), either its kept points or the centres of its voxels.
struct ObservedObject {
  ClassId class_id = kBackground;
  double score = 1.0;  ///< confidence of the detection, in (0, 1]
  std::vector<Eigen::Vector3d> positions;
};

/// What one frame says of the detected objects.
using Observation = std::vector<ObservedObject>;

}  // namespace mapscore
