// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// What all turns of a recording's lidar share. Beam n points along first_angle_rad + n
/// angle_step_rad in the lidar's frame, x forward, counter-clockwise.
struct ScanGeometry {
  double first_angle_rad = 0.0, angle_step_rad = 0.0;
  double range_min_m = 0.0, range_max_m = 0.0;
  Pose T_base_lidar = Pose::Identity();
};

/// One turn, all beams at one instant. Infinity: nothing within the range; 0: no measurement.
struct StampedScan {
  double stamp_s = 0.0;
  std::vector<float> ranges_m;
};

/// The turns of a drive.
struct ScanLog {
  ScanGeometry geometry;
  std::vector<StampedScan> scans;  ///< by stamp, all with the same number of beams, at least one
};

/// Bytes of scan/scans.bin; see docs/formats.md. Throws Error when turns differ in beams.
[[nodiscard]] std::string scan_log_bytes(const ScanLog& log);

/// Throws Error with file and reason when it is missing, truncated, of another format, or holds
/// numbers that cannot be: stamps that do not ascend, ranges that are negative or not a number.
[[nodiscard]] ScanLog read_scan_log(const std::filesystem::path& file);

}  // namespace mapscore::eval
