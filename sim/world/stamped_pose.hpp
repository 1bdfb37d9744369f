// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

namespace mapscore::sim {

/// Where the robot is at an instant.
struct StampedPose {
  double stamp_s = 0.0;
  Pose T_world_base = Pose::Identity();
};

}  // namespace mapscore::sim
