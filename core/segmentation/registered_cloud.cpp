// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/registered_cloud.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

namespace mapscore {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Pixels of the colour image, limits included; empty when first > last.
struct PixelSpan {
  std::int32_t first = 0, last = -1;
};

/// Columns and rows of the colour image that matter.
struct Window {
  PixelSpan columns, rows;
};

/// Least window that holds every wanted pixel; all of the image when `wanted` is empty.
Window window_of(const cv::Mat1b& wanted, const CameraModel& color) {
  if (wanted.empty()) return {{0, color.width_px - 1}, {0, color.height_px - 1}};
  Window window{{color.width_px, -1}, {color.height_px, -1}};
  for (int v = 0; v < wanted.rows; ++v) {
    const std::uint8_t* row = wanted[v];
    const std::uint8_t* end = row + wanted.cols;
    const std::uint8_t* first = std::find_if(row, end, [](std::uint8_t p) { return p != 0; });
    if (first == end) continue;
    int last = wanted.cols - 1;
    while (row[last] == 0) --last;
    window.columns.first = std::min(window.columns.first, static_cast<std::int32_t>(first - row));
    window.columns.last = std::max(window.columns.last, last);
    window.rows.first = std::min(window.rows.first, v);
    window.rows.last = v;
  }
  return window;
}

/// One row of depth pixels as the colour camera sees them: z_color, and the colour pixels that each
/// covers, none where it has no usable depth.
struct CoverRow {
  explicit CoverRow(std::size_t width)
      : z_color(width), u_first(width), u_last(width), v_first(width), v_last(width) {}
  std::vector<double> z_color;
  std::vector<std::int32_t> u_first, u_last, v_first, v_last;
};

/// Smallest and largest whole numbers of a span within [low, high]; none is within it when the first
/// exceeds the last. NaN counts as below the span: operands stand so that comparing with it keeps the
/// limit. Without branches or library calls, so that the loop around it becomes wide vectors.
struct Clamp {
  double first, last;

  explicit Clamp(const PixelSpan& span) : first(span.first), last(span.last) {}
  [[nodiscard]] std::int32_t round_up(double low) const {
    const double inside = std::min(std::max(first, low), last + 1.0);
    const auto down = static_cast<std::int32_t>(inside);
    return down + static_cast<std::int32_t>(inside > down);
  }
  [[nodiscard]] std::int32_t round_down(double high) const {
    return static_cast<std::int32_t>(std::min(std::max(first - 1.0, high), last) + 1.0) - 1;
  }
};

class Projector {
 public:
  Projector(const Calibration& believed, const DepthRays& rays, const Window& window)
      : believed_(believed),
        rays_(rays),
        columns_(window.columns),
        rows_(window.rows),
        parallel_(believed.T_color_depth.linear() == Eigen::Matrix3d::Identity()) {}

  void project(const std::uint16_t* values, int row, CoverRow& out) const {
    parallel_ ? project_row<true>(values, row, out) : project_row<false>(values, row, out);
  }

 private:
  /// Between parallel cameras R * p = p exactly, which saves the product.
  template <bool kParallel>
  void project_row(const std::uint16_t* values, int row, CoverRow& out) const {
    const Eigen::Matrix3d R = believed_.T_color_depth.linear();
    const Eigen::Vector3d t = believed_.T_color_depth.translation();
    const CameraModel color = believed_.color, depth = believed_.depth;
    const double ratio_u = color.fx_px / depth.fx_px, ratio_v = color.fy_px / depth.fy_px;
    const double range_min_m = believed_.range_min_m, range_max_m = believed_.range_max_m;
    const Clamp columns = columns_, rows = rows_;
    const double* ray_x = rays_.x().data();
    const double ray_y = rays_.y()[static_cast<std::size_t>(row)];
    double* z_out = out.z_color.data();
    std::int32_t *u_first = out.u_first.data(), *u_last = out.u_last.data();
    std::int32_t *v_first = out.v_first.data(), *v_last = out.v_last.data();
    const std::size_t width = out.z_color.size();
    for (std::size_t i = 0; i < width; ++i) {
      const double z = values[i] / kDepthUnitsPerMetre;
      const double x = z * ray_x[i], y = z * ray_y;
      const double x_color = (kParallel ? x : R(0, 0) * x + R(0, 1) * y + R(0, 2) * z) + t.x();
      const double y_color = (kParallel ? y : R(1, 0) * x + R(1, 1) * y + R(1, 2) * z) + t.y();
      const double z_color = (kParallel ? z : R(2, 0) * x + R(2, 1) * y + R(2, 2) * z) + t.z();
      const double z_ratio = z / z_color;
      const double u = color.fx_px * x_color / z_color + color.cx_px;
      const double v = color.fy_px * y_color / z_color + color.cy_px;
      const double h_u = 0.5 * std::max(1.0, ratio_u * z_ratio);
      const double h_v = 0.5 * std::max(1.0, ratio_v * z_ratio);
      u_first[i] = columns.round_up(u - h_u);
      u_last[i] = columns.round_down(u + h_u);
      const bool usable = (z > 0) & (z >= range_min_m) & (z <= range_max_m) & (z_color > 0);
      v_first[i] = rows.round_up(v - h_v);
      v_last[i] = rows.round_down(usable ? v + h_v : -kFar);
      z_out[i] = z_color;
    }
  }

  const Calibration& believed_;
  const DepthRays& rays_;
  Clamp columns_, rows_;
  bool parallel_;
};

/// Keeps the nearest depth pixel per colour pixel. Depth pixels arrive in row-major order, so
/// "strictly nearer" leaves ties to the lower row, then column. Pixels that do not matter start out
/// nearer than everything.
class ZBuffer {
 public:
  ZBuffer(const CameraModel& color, const cv::Mat1b& wanted)
      : nearest_(color.height_px, color.width_px, kFar),
        source_(color.height_px, color.width_px, RegisteredCloud::kNone) {
    if (!wanted.empty()) nearest_.setTo(-kFar, wanted == 0);
  }

  void cover(const CoverRow& row, int first_depth_pixel) {
    for (std::size_t i = 0; i < row.z_color.size(); ++i) {
      const int depth_pixel = first_depth_pixel + static_cast<int>(i);
      for (int v = row.v_first[i]; v <= row.v_last[i]; ++v)
        for (int u = row.u_first[i]; u <= row.u_last[i]; ++u)
          offer(u, v, row.z_color[i], depth_pixel);
    }
  }

  [[nodiscard]] cv::Mat1i take() { return std::move(source_); }

 private:
  void offer(int u, int v, double z_color, int depth_pixel) {
    double& nearest = nearest_(v, u);
    if (z_color >= nearest) return;
    nearest = z_color;
    source_(v, u) = depth_pixel;
  }

  cv::Mat1d nearest_;
  cv::Mat1i source_;
};

bool has_size(const cv::Mat& image, const CameraModel& camera) {
  return image.cols == camera.width_px && image.rows == camera.height_px;
}

}  // namespace

RegisteredCloud::RegisteredCloud(cv::Mat1w depth, const CameraModel& depth_camera, cv::Mat1i source)
    : depth_(std::move(depth)), rays_(depth_camera), source_(std::move(source)) {}

RegisteredCloud register_depth(const cv::Mat1w& depth, const Calibration& believed,
                               const cv::Mat1b& wanted) {
  if (!has_size(depth, believed.depth))
    throw Error(
        "depth image: not of the depth camera's size; give the intrinsics it was taken with");
  if (!wanted.empty() && !has_size(wanted, believed.color))
    throw Error(
        "label image: not of the colour camera's size; give the intrinsics it was taken with");
  const DepthRays rays(believed.depth);
  const Projector projector(believed, rays, window_of(wanted, believed.color));
  CoverRow row(rays.x().size());
  ZBuffer buffer(believed.color, wanted);
  for (int v = 0; v < depth.rows; ++v) {
    projector.project(depth[v], v, row);
    buffer.cover(row, v * depth.cols);
  }
  return {depth, believed.depth, buffer.take()};
}

}  // namespace mapscore
