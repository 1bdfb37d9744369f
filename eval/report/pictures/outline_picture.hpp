// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/camera.hpp"
#include "core/segmentation/sight.hpp"

#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace mapscore::eval {

/// A calibration and what it is called above its column.
struct TitledCalibration {
  std::string title;
  Calibration calibration;
};

/// The outlines of a frame's masks, in the colours of their classes, and the steps of its depth
/// image where each calibration puts them, in black: a column a calibration, the whole image above
/// a part of it, four times as large, where most steps lie near outlines. A grey rectangle shows
/// where the part lies.
[[nodiscard]] cv::Mat3b outline_picture(const Sight& sight, const ClassTable& table,
                                        const std::vector<TitledCalibration>& calibrations);

}  // namespace mapscore::eval
