// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/planar_pose.hpp"

#include <cstddef>
#include <vector>

namespace mapscore {

/// One turn of a planar lidar, as sensor_msgs/LaserScan has it. Beam n points along first_angle_rad
/// + n angle_step_rad in the lidar's frame. A range that is not a number, or below range_min_m, is
/// no measurement; one of range_max_m or more (infinity too) says that nothing was hit.
struct LaserScan {
  PlanarPose T_base_lidar;
  double first_angle_rad = 0.0, angle_step_rad = 0.0;
  double range_min_m = 0.0, range_max_m = 12.0;
  std::vector<float> ranges_m;
};

/// One beam as a model uses it: direction in the lidar's frame; `hit` false when nothing was hit
/// within the lidar's range, which is then `range_m`.
struct Beam {
  double angle_rad = 0.0, range_m = 0.0;
  bool hit = true;
};

/// At most `count` beams, evenly spread over the scan: beams floor(n size / count). Of these, those
/// that measured nothing are left out. Throws Error when the scan's numbers are not usable.
[[nodiscard]] std::vector<Beam> beams_of(const LaserScan& scan, std::size_t count);

}  // namespace mapscore
