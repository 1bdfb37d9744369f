// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"

#include <Eigen/Core>
#include <vector>

namespace mapscore {

/// Slopes of a camera's rays, divided once: x(u) = (u - cx) / fx of each column, y(v) = (v - cy) /
/// fy of each row. Points come out bit for bit as from CameraModel::back_project. Immutable.
class DepthRays {
 public:
  explicit DepthRays(const CameraModel& camera)
      : x_(static_cast<std::size_t>(camera.width_px)),
        y_(static_cast<std::size_t>(camera.height_px)) {
    for (std::size_t u = 0; u < x_.size(); ++u)
      x_[u] = (static_cast<double>(u) - camera.cx_px) / camera.fx_px;
    for (std::size_t v = 0; v < y_.size(); ++v)
      y_[v] = (static_cast<double>(v) - camera.cy_px) / camera.fy_px;
  }

  [[nodiscard]] const std::vector<double>& x() const { return x_; }
  [[nodiscard]] const std::vector<double>& y() const { return y_; }

  /// Point at planar depth z_m (metres) seen by pixel (u, v) of the image: z * (x(u), y(v), 1).
  [[nodiscard]] Eigen::Vector3d point(int u, int v, double z_m) const {
    return {z_m * x_[static_cast<std::size_t>(u)], z_m * y_[static_cast<std::size_t>(v)], z_m};
  }

 private:
  std::vector<double> x_, y_;
};

}  // namespace mapscore
