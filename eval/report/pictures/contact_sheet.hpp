// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/recording/recording.hpp"
#include "eval/study/study.hpp"

#include <opencv2/core.hpp>

#include <vector>

namespace mapscore::eval {

/// Frames of a recording, one a row: `chosen`, or, without any, the four that are fullest with
/// objects of each quarter of the drive.
/// Columns: colour, depth, labels, and the labels as registration hands them to the depth pixels,
/// with no fault and with the study's largest misregistration of seed 0; the last only where the
/// study has one. At most 1600 pixels wide. `table` has the study's detected set. Throws Error when
/// an image cannot be read.
[[nodiscard]] cv::Mat3b contact_sheet(const Study& study, const ClassTable& table,
                                      const Recording& recording,
                                      const std::vector<int>& chosen = {});

}  // namespace mapscore::eval
