// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"

#include <opencv2/core.hpp>

namespace mapscore::testing {

/// The rule of docs/methods.md word by word: every depth pixel against every colour pixel of a
/// generous window, |column - u| <= h and |row - v| <= h; index of the winning depth pixel per
/// colour pixel, or -1.
[[nodiscard]] cv::Mat1i register_plain(const cv::Mat1w& depth, const Calibration& believed);

}  // namespace mapscore::testing
