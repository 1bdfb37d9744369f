// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"

#include <opencv2/core.hpp>

#include <cmath>
#include <numbers>

namespace mapscore::testing {

constexpr double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

/// The depth camera of the robot.
inline CameraModel depth_camera() {
  return CameraModel::from_hfov(640, 480, radians(58.4));
}
inline const CameraModel kCamera = depth_camera();

/// The plane through (0, 0, z_m) turned about the optical y axis by `tilt_rad`: z = z_m + tan(tilt)
/// x.
struct TiltedPlane {
  double z_m, tilt_rad;

  [[nodiscard]] double depth_m(const CameraModel& camera, int u) const {
    return z_m / (1.0 - std::tan(tilt_rad) * camera.back_project(u, 0, 1.0).x());
  }
  [[nodiscard]] double incidence_rad(const CameraModel& camera, int u, int v) const {
    const Eigen::Vector3d ray = camera.back_project(u, v, 1.0).normalized();
    const Eigen::Vector3d normal(-std::sin(tilt_rad), 0.0, std::cos(tilt_rad));
    return std::acos(std::min(1.0, ray.dot(normal)));
  }
  /// None where the plane lies behind the camera or beyond 13 m.
  [[nodiscard]] cv::Mat1w image(const CameraModel& camera) const {
    cv::Mat1w depth(camera.height_px, camera.width_px);
    for (int u = 0; u < depth.cols; ++u) {
      const double z = depth_m(camera, u);
      const bool seen = z > 0.0 && z < 13.0;
      depth.col(u).setTo(seen ? std::lround(z * kDepthUnitsPerMetre) : 0);
    }
    return depth;
  }
};

/// `near_m` in the columns [first, end), `far_m` elsewhere.
inline cv::Mat1w plate_before_wall(const CameraModel& camera, int first, int end, double near_m,
                                   double far_m) {
  cv::Mat1w depth = TiltedPlane{far_m, 0.0}.image(camera);
  depth.colRange(first, end).setTo(std::lround(near_m * kDepthUnitsPerMetre));
  return depth;
}

inline bool same_pixels(const cv::Mat1w& a, const cv::Mat1w& b) {
  return a.size() == b.size() && cv::countNonZero(a != b) == 0;
}

/// Mean and standard deviation of what was added.
class Moments {
 public:
  void add(double value) {
    ++count_;
    sum_ += value;
    squares_ += value * value;
  }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] double mean() const { return sum_ / count_; }
  [[nodiscard]] double sd() const { return std::sqrt(squares_ / count_ - mean() * mean()); }

 private:
  int count_ = 0;
  double sum_ = 0.0, squares_ = 0.0;
};

}  // namespace mapscore::testing
