// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/frame.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/depth_rays.hpp"
#include "eval/truth/sample_counter.hpp"

#include <cstdint>

namespace mapscore::eval {

/// act(class, p_depth) for each depth sample of a detected class, noise-free and within the
/// camera's range, in the order of the pixels; p_depth in depth_optical, metres. Throws as
/// check_depth_images.
void for_each_detected_sample(const Frame& frame, const Calibration& calibration,
                              const ClassTable& table, auto&& act) {
  check_depth_images(frame, calibration.depth);
  const DepthRays rays(calibration.depth);
  for (int v = 0; v < frame.depth.rows; ++v) {
    const std::uint16_t *depth = frame.depth[v], *label = frame.depth_label[v];
    for (int u = 0; u < frame.depth.cols;) {
      int end = u;  // of the run of one instance
      while (end < frame.depth.cols && label[end] == label[u]) ++end;
      const ClassId class_id = table.class_of(label[u]);
      if (!table.detected(class_id)) u = end;
      for (; u < end; ++u) {
        const double z = depth[u] / kDepthUnitsPerMetre;
        if (z != 0.0 && z >= calibration.range_min_m && z <= calibration.range_max_m)
          act(class_id, rays.point(u, v, z));
      }
    }
  }
}

}  // namespace mapscore::eval
