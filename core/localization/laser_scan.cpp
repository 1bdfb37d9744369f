// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/laser_scan.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace mapscore {
namespace {

void check(const LaserScan& scan) {
  const PlanarPose& T = scan.T_base_lidar;
  if (!(std::isfinite(T.x_m) && std::isfinite(T.y_m) && std::isfinite(T.yaw_rad)))
    throw Error("T_base_lidar: is not finite; give the lidar's mount in metres and radians");
  if (!(std::isfinite(scan.first_angle_rad) && std::isfinite(scan.angle_step_rad)))
    throw Error("scan: its angles are not finite; give first angle and step in radians");
  if (!(scan.range_min_m >= 0 && scan.range_max_m > scan.range_min_m &&
        std::isfinite(scan.range_max_m)))
    throw Error("scan: range " + std::to_string(scan.range_min_m) + " to " +
                std::to_string(scan.range_max_m) + " m; give 0 <= range_min_m < range_max_m");
}

}  // namespace

std::vector<Beam> beams_of(const LaserScan& scan, std::size_t count) {
  check(scan);
  const std::size_t size = scan.ranges_m.size();
  const std::size_t used = std::min(count, size);
  std::vector<Beam> beams;
  beams.reserve(used);
  for (std::size_t n = 0; n < used; ++n) {
    const std::size_t at = n * size / used;
    const double range = scan.ranges_m[at];
    if (!(range >= scan.range_min_m)) continue;  // not a number, too
    const double angle = scan.first_angle_rad + static_cast<double>(at) * scan.angle_step_rad;
    const bool hit = range < scan.range_max_m;
    beams.push_back({angle, hit ? range : scan.range_max_m, hit});
  }
  return beams;
}

}  // namespace mapscore
