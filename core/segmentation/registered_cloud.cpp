// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/registered_cloud.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace mapscore {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// floor and ceil of values well inside the range of int; a library call each would dominate the
/// loop.
int floor_int(double x) {
  const int truncated = static_cast<int>(x);
  return truncated - (truncated > x ? 1 : 0);
}
int ceil_int(double x) {
  const int truncated = static_cast<int>(x);
  return truncated + (truncated < x ? 1 : 0);
}

/// One row of depth pixels seen by the colour camera; z = kFar where a pixel has no usable depth.
struct ProjectedRow {
  explicit ProjectedRow(int width) : u(width), v(width), z(width), reach_u(width), reach_v(width) {}
  std::vector<double> u, v, z, reach_u, reach_v;
};

class Projector {
 public:
  explicit Projector(const Calibration& believed)
      : color_(believed.color),
        depth_(believed.depth),
        R_(believed.T_color_depth.linear()),
        t_(believed.T_color_depth.translation()),
        range_min_m_(believed.range_min_m),
        range_max_m_(believed.range_max_m),
        ray_x_(static_cast<std::size_t>(believed.depth.width_px)) {
    for (std::size_t u = 0; u < ray_x_.size(); ++u)
      ray_x_[u] = (static_cast<double>(u) - depth_.cx_px) / depth_.fx_px;
  }

  void project(const std::uint16_t* values, int row, ProjectedRow& out) const {
    const double ray_y = (row - depth_.cy_px) / depth_.fy_px;
    const double ratio_u = color_.fx_px / depth_.fx_px, ratio_v = color_.fy_px / depth_.fy_px;
    for (std::size_t i = 0; i < ray_x_.size(); ++i) {
      const double z = values[i] / kDepthUnitsPerMetre;
      const double x = z * ray_x_[i], y = z * ray_y;
      const double x_color = R_(0, 0) * x + R_(0, 1) * y + R_(0, 2) * z + t_.x();
      const double y_color = R_(1, 0) * x + R_(1, 1) * y + R_(1, 2) * z + t_.y();
      const double z_color = R_(2, 0) * x + R_(2, 1) * y + R_(2, 2) * z + t_.z();
      const bool usable =
          (values[i] != 0) & (z >= range_min_m_) & (z <= range_max_m_) & (z_color > 0);
      out.u[i] = color_.fx_px * x_color / z_color + color_.cx_px;
      out.v[i] = color_.fy_px * y_color / z_color + color_.cy_px;
      out.reach_u[i] = 0.5 * std::max(1.0, ratio_u * (z / z_color));
      out.reach_v[i] = 0.5 * std::max(1.0, ratio_v * (z / z_color));
      out.z[i] = usable ? z_color : kFar;
    }
  }

 private:
  CameraModel color_, depth_;
  Eigen::Matrix3d R_;
  Eigen::Vector3d t_;
  double range_min_m_, range_max_m_;
  std::vector<double> ray_x_;
};

/// Keeps the nearest depth pixel per colour pixel. Depth pixels arrive in row-major order, so
/// "strictly nearer" leaves ties to the lower row, then column.
class ZBuffer {
 public:
  ZBuffer(const CameraModel& color, const cv::Mat1b& wanted)
      : wanted_(wanted),
        nearest_(color.height_px, color.width_px, kFar),
        source_(color.height_px, color.width_px, RegisteredCloud::kNone) {}

  void cover(const ProjectedRow& row, int first_depth_pixel) {
    const double width = source_.cols, height = source_.rows;
    for (std::size_t i = 0; i < row.z.size(); ++i) {
      const double u = row.u[i], v = row.v[i], reach_u = row.reach_u[i], reach_v = row.reach_v[i];
      const bool seen = row.z[i] < kFar && u + reach_u >= 0 && u - reach_u <= width - 1 &&
                        v + reach_v >= 0 && v - reach_v <= height - 1;
      if (!seen) continue;
      const int u_first = ceil_int(std::max(0.0, u - reach_u));
      const int u_last = floor_int(std::min(width - 1, u + reach_u));
      const int v_first = ceil_int(std::max(0.0, v - reach_v));
      const int v_last = floor_int(std::min(height - 1, v + reach_v));
      for (int y = v_first; y <= v_last; ++y)
        for (int x = u_first; x <= u_last; ++x)
          offer(x, y, row.z[i], first_depth_pixel + static_cast<int>(i));
    }
  }

  [[nodiscard]] cv::Mat1i take() { return std::move(source_); }

 private:
  void offer(int x, int y, double z, int depth_pixel) {
    if (!wanted_.empty() && wanted_(y, x) == 0) return;
    double& nearest = nearest_(y, x);
    if (z >= nearest) return;
    nearest = z;
    source_(y, x) = depth_pixel;
  }

  const cv::Mat1b& wanted_;
  cv::Mat1d nearest_;
  cv::Mat1i source_;
};

bool has_size(const cv::Mat& image, const CameraModel& camera) {
  return image.cols == camera.width_px && image.rows == camera.height_px;
}

}  // namespace

RegisteredCloud::RegisteredCloud(cv::Mat1w depth, const CameraModel& depth_camera, cv::Mat1i source)
    : depth_(std::move(depth)), camera_(depth_camera), source_(std::move(source)) {}

RegisteredCloud register_depth(const cv::Mat1w& depth, const Calibration& believed,
                               const cv::Mat1b& wanted) {
  if (!has_size(depth, believed.depth))
    throw Error(
        "depth image: not of the depth camera's size; give the intrinsics it was taken with");
  if (!wanted.empty() && !has_size(wanted, believed.color))
    throw Error(
        "label image: not of the colour camera's size; give the intrinsics it was taken with");
  const Projector projector(believed);
  ProjectedRow row(depth.cols);
  ZBuffer buffer(believed.color, wanted);
  for (int v = 0; v < depth.rows; ++v) {
    projector.project(depth[v], v, row);
    buffer.cover(row, v * depth.cols);
  }
  return {depth, believed.depth, buffer.take()};
}

}  // namespace mapscore
