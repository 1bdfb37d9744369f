// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/depth_edges.hpp"
#include "core/segmentation/outline_field.hpp"

#include <Eigen/Core>

namespace mapscore {

/// How the believed registration is to be mended for one frame, and how far masks reach beyond
/// their objects: p_color = rotation * (T_believed_color_depth p_depth) + translation, and an
/// object ends where the distance to its mask's outline is `offset_px` (positive: the mask is too
/// small).
struct OutlineAlignment {
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Eigen::Vector3f translation = Eigen::Vector3f::Zero();
  float offset_px = 0;
  float sharpness = 1;  ///< that share at 1.2 px over the share at 4 px: near 1 where all is rigid
  float score = 0;      ///< share of the outline that depth edges explain, about 0 to 1
};

/// Fits the outlines of a frame to its depth edges.
[[nodiscard]] OutlineAlignment align_outlines(const DepthEdges& edges, const OutlineField& field,
                                              const Calibration& believed, double search_px);

}  // namespace mapscore
