// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/projector_shadow.hpp"

#include "sim/faults/depth_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mapscore::sim {
namespace {

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
