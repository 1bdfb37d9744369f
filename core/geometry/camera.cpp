// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/camera.hpp"

#include <cmath>

namespace mapscore {

CameraModel CameraModel::from_hfov(int width_px, int height_px, double hfov_rad) {
  const double focal = 0.5 * width_px / std::tan(0.5 * hfov_rad);
  return {width_px, height_px, focal, focal, 0.5 * (width_px - 1), 0.5 * (height_px - 1)};
}

}  // namespace mapscore
