// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/key_frames.hpp"

#include "core/odometry/key_view.hpp"

#include <Eigen/Geometry>

namespace mapscore {
namespace {

constexpr int kStride = 16;

}  // namespace

double overlap(const cv::Mat1w& depth, const Calibration& believed, const Pose& T_other_base) {
  const Pose T_other_depth = believed.T_base_depth.inverse() * T_other_base * believed.T_base_depth;
  int seen = 0, shared = 0;
  for (int v = kStride / 2; v < depth.rows; v += kStride)
    for (int u = kStride / 2; u < depth.cols; u += kStride) {
      if (depth(v, u) == 0) continue;
      ++seen;
      const double z_m = depth(v, u) / kDepthUnitsPerMetre;
      if (pixel_in_view(T_other_depth * believed.depth.back_project(u, v, z_m), believed)) ++shared;
    }
  return seen == 0 ? 0.0 : static_cast<double>(shared) / seen;
}

bool is_key_frame(const KeyFrameRule& rule, const cv::Mat1w& depth, const Calibration& believed,
                  const Pose& T_key_base) {
  return T_key_base.translation().norm() >= rule.key_way_m ||
         Eigen::AngleAxisd(T_key_base.linear()).angle() >= rule.key_turn_deg.rad() ||
         overlap(depth, believed, T_key_base) < rule.key_overlap;
}

}  // namespace mapscore
