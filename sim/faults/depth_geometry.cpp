// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/depth_geometry.hpp"

#include "core/geometry/depth_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

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

/// Parts of a pixel in which a projector's ray is told apart; even, so that a pixel's interval is
/// centred.
constexpr int kParts = 8;

/// One row of the projector's depth buffer.
class ProjectorRow {
 public:
  /// `shift_px`: f b, disparity times depth.
  ProjectorRow(int width_px, double shift_px, double nearest_m)
      : shift_px_(shift_px),
        before_(static_cast<int>(std::ceil(shift_px / nearest_m)) + 1),
        nearest_m_(static_cast<std::size_t>((width_px + before_ + 1) * kParts)) {}

  void clear() { std::ranges::fill(nearest_m_, std::numeric_limits<double>::infinity()); }

  /// The surface at z_m that pixel u sees covers the ray's pixel, half to either side.
  void cover(int u, double z_m) {
    const int centre = part_of(u, z_m);
    for (int part = centre - kParts / 2; part < centre + kParts / 2; ++part) {
      double& nearest = nearest_m_[static_cast<std::size_t>(part)];
      nearest = std::min(nearest, z_m);
    }
  }
  /// Least z of what the projector's ray to pixel u's surface meets.
  [[nodiscard]] double nearest(int u, double z_m) const {
    return nearest_m_[static_cast<std::size_t>(part_of(u, z_m))];
  }

 private:
  [[nodiscard]] int part_of(int u, double z_m) const {
    return static_cast<int>(std::floor((u + before_ - shift_px_ / z_m) * kParts));
  }

  double shift_px_;
  int before_;
  std::vector<double> nearest_m_;
};

double nearest_of(const cv::Mat1d& z_m) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const double z : z_m)
    if (z > 0.0) nearest = std::min(nearest, z);
  return nearest;
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

cv::Mat1b projector_shadow(const cv::Mat1d& z_m, const CameraModel& camera, double baseline_m) {
  cv::Mat1b shadow(z_m.size(), std::uint8_t{0});
  const double nearest_m = nearest_of(z_m);
  if (baseline_m == 0.0 || std::isinf(nearest_m)) return shadow;
  const StepRule rule(camera);
  ProjectorRow row(z_m.cols, camera.fx_px * baseline_m, nearest_m);
  for (int v = 0; v < z_m.rows; ++v) {
    row.clear();
    for (int u = 0; u < z_m.cols; ++u)
      if (z_m(v, u) > 0.0) row.cover(u, z_m(v, u));
    for (int u = 0; u < z_m.cols; ++u) {
      const double z = z_m(v, u);
      if (z > 0.0 && row.nearest(u, z) < z && rule.is_step(z, row.nearest(u, z)))
        shadow(v, u) = 255;
    }
  }
  return shadow;
}

}  // namespace mapscore::sim
