// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/label_images.hpp"

#include <opencv2/core.hpp>

#include <vector>

namespace mapscore::eval {

/// Frames of labelled images, one a row: the colour image, the true classes and the labelled ones
/// in their colours, background left pale, and what is wrong: pixels that should have a class
/// (missed), that should have none (false) and that should have another (mislabelled). Throws Error
/// when an image cannot be read or holds an id without a class.
[[nodiscard]] cv::Mat3b label_errors(const LabelFolder& labels, const std::vector<int>& frames);

}  // namespace mapscore::eval
