// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/exploration/floor_moments.hpp"

#include <opencv2/core.hpp>

#include <optional>

namespace mapscore::eval {

/// A film strip of one exploration: a column a kept moment, with what the colour camera saw and the
/// floor as the lidar had it then, the robot and its way in it. None where the exploration kept no
/// recording. Throws Error where a file of it cannot be read.
[[nodiscard]] std::optional<cv::Mat3b> exploration_strip(const FinishedExploration& run);

}  // namespace mapscore::eval
