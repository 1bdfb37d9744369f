// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/depth_geometry.hpp"

#include "core/geometry/depth_rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mapscore::sim {
namespace {

/// Slope per pixel of the inverse depth `w`, a function of the position along a line of `count`
/// pixels, at `at`. 0 where no neighbour lies on the same surface.
template <class InverseDepth>
double slope_of(const InverseDepth& w, int at, int count, const StepRule& rule) {
  const double here = w(at);
  const auto side = [&](int direction) {
    for (const int apart : {2, 1}) {
      const int other = at + direction * apart;
      if (other < 0 || other >= count || w(other) == 0.0) continue;
      if (!rule.is_step(here, w(other), apart)) return direction * apart;
    }
    return 0;
  };
  const int before = side(-1), after = side(1);
  if (before == after) return 0.0;
  const auto slope = [&](int from, int to) { return (w(at + to) - w(at + from)) / (to - from); };
  if (before == 0 || after == 0) return slope(before, after);
  const double left = slope(before, 0), right = slope(0, after);
  const bool agree = std::abs(left - right) <= 0.5 * std::max(std::abs(left), std::abs(right));
  if (agree) return slope(before, after);
  return std::abs(left) < std::abs(right) ? left : right;
}

}  // namespace

cv::Mat1d metres_of(const cv::Mat1w& depth) {
  cv::Mat1d z_m(depth.size());
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) z_m(v, u) = depth(v, u) / kDepthUnitsPerMetre;
  return z_m;
}

StepRule::StepRule(const CameraModel& camera)
    : limit(std::tan(87.0 * std::numbers::pi / 180.0) / (0.5 * (camera.fx_px + camera.fy_px))) {}

cv::Mat1f incidence_angles(const cv::Mat1d& z_m, const CameraModel& camera) {
  const StepRule rule(camera);
  const DepthRays rays(camera);
  cv::Mat1f angles(z_m.size(), 0.0F);
  cv::Mat1d inverse = z_m.clone();
  for (double& w : inverse)
    if (w != 0.0) w = 1.0 / w;
  for (int v = 0; v < z_m.rows; ++v) {
    const double y = rays.y()[static_cast<std::size_t>(v)];
    for (int u = 0; u < z_m.cols; ++u) {
      const double w = inverse(v, u);
      if (w == 0.0) continue;
      const auto along_row = [&](int column) { return inverse(v, column); };
      const auto along_column = [&](int row) { return inverse(row, u); };
      // The plane a x + b y + c = 1/z has the normal (a, b, c); the ray is (x, y, 1).
      const double x = rays.x()[static_cast<std::size_t>(u)];
      const double a = camera.fx_px * slope_of(along_row, u, z_m.cols, rule);
      const double b = camera.fy_px * slope_of(along_column, v, z_m.rows, rule);
      const double c = w - a * x - b * y;
      const double cosine = w / std::sqrt((a * a + b * b + c * c) * (x * x + y * y + 1.0));
      angles(v, u) = static_cast<float>(std::acos(std::min(1.0, cosine)));
    }
  }
  return angles;
}

}  // namespace mapscore::sim
