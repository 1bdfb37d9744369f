// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/localization/believed_trajectory.hpp"

#include <filesystem>
#include <string>

namespace mapscore::eval {

/// Text of localization.txt: for each entry its stamp, T_map_base, and the 36 numbers of the
/// covariance row by row; see docs/formats.md. Numbers are the shortest texts that read back the
/// same.
[[nodiscard]] std::string believed_text(const BelievedTrajectory& believed);

/// Reads localization.txt, or a trajectory in the format of TUM (T_map_base_footprint, 8 columns),
/// whose covariance is then 0. The poses take the place of the odometry, T_map_odom is the
/// identity: between two lines the pose is interpolated, the covariance is that of the line before.
/// Throws Error with file and line for another number of columns, stamps that do not ascend,
/// numbers that are not finite, quaternions that are not unit, and a covariance that is not
/// symmetric positive semi-definite.
[[nodiscard]] BelievedTrajectory read_believed(const std::filesystem::path& file);

}  // namespace mapscore::eval
