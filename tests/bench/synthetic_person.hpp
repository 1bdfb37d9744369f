// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/camera.hpp"

#include <opencv2/core.hpp>

namespace mapscore::testing {

/// A person of ellipsoids 2 m before the camera pair and a wall 1.5 m behind, exact ray-cast
/// images: about 54 thousand mask pixels at 640 x 480. Instance 1 of the detected class 1.
struct SyntheticPerson {
  Calibration calibration;
  cv::Mat1w depth;  ///< depth camera, 1/5000 m
  cv::Mat1w label;  ///< colour camera, instance ids
  ClassTable table;
};

[[nodiscard]] SyntheticPerson synthetic_person();

/// The same, made once.
inline const SyntheticPerson& person() {
  static const SyntheticPerson kPerson = synthetic_person();
  return kPerson;
}

}  // namespace mapscore::testing
