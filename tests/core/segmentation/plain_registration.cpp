// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "plain_registration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mapscore::testing {
namespace {

/// Pixels whose centre may lie within `reach` of `at`, and one more on either side.
std::pair<int, int> window(double at, double reach, int size) {
  const double low = std::clamp(at - reach - 1.0, 0.0, size - 1.0);
  const double high = std::clamp(at + reach + 1.0, 0.0, size - 1.0);
  return {static_cast<int>(std::floor(low)), static_cast<int>(std::ceil(high))};
}

}  // namespace

cv::Mat1i register_plain(const cv::Mat1w& depth, const Calibration& believed) {
  const CameraModel& color = believed.color;
  cv::Mat1i source(color.height_px, color.width_px, -1);
  cv::Mat1d nearest(color.height_px, color.width_px, std::numeric_limits<double>::infinity());
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      const double z = depth(v, u) / kDepthUnitsPerMetre;
      if (depth(v, u) == 0 || z < believed.range_min_m || z > believed.range_max_m) continue;
      const Eigen::Vector3d p_color = believed.T_color_depth * believed.depth.back_project(u, v, z);
      if (!(p_color.z() > 0)) continue;
      const Eigen::Vector2d at = color.project(p_color);
      const double z_ratio = z / p_color.z();
      const double h_u = std::max(1.0, color.fx_px / believed.depth.fx_px * z_ratio) / 2;
      const double h_v = std::max(1.0, color.fy_px / believed.depth.fy_px * z_ratio) / 2;
      const auto [u_first, u_last] = window(at.x(), h_u, color.width_px);
      const auto [v_first, v_last] = window(at.y(), h_v, color.height_px);
      for (int row = v_first; row <= v_last; ++row) {
        for (int column = u_first; column <= u_last; ++column) {
          if (std::abs(column - at.x()) > h_u || std::abs(row - at.y()) > h_v) continue;
          if (p_color.z() >= nearest(row, column)) continue;
          nearest(row, column) = p_color.z();
          source(row, column) = v * depth.cols + u;
        }
      }
    }
  }
  return source;
}

}  // namespace mapscore::testing
