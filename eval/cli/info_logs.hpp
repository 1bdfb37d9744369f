// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/recording/recording.hpp"

#include <string>

namespace mapscore::eval {

/// What a recording holds of odometry and lidar, a line each: counts, span, drift at the end.
/// Empty where it has neither. Throws Error when a file cannot be read.
[[nodiscard]] std::string log_lines(const Recording& recording);

}  // namespace mapscore::eval
