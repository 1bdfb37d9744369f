// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/posed_depth.hpp"

#include "core/error.hpp"

#include <string>

namespace mapscore {

void check(const PosedDepth& view) {
  const CameraModel& camera = view.camera;
  if (view.depth.cols != camera.width_px || view.depth.rows != camera.height_px)
    throw Error("depth image: " + std::to_string(view.depth.cols) + " x " +
                std::to_string(view.depth.rows) + " px, but its camera has " +
                std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px) +
                "; give the image of this camera");
  if (!(view.range_min_m > 0.0 && view.range_max_m >= view.range_min_m))
    throw Error("range of the depth camera: " + std::to_string(view.range_min_m) + " to " +
                std::to_string(view.range_max_m) + " m; give 0 < least <= greatest");
}

}  // namespace mapscore
