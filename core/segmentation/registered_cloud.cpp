// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/registered_cloud.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace mapscore {
namespace {

/// floor and ceil of values within the range of int; library calls would dominate the loop.
int floor_int(double x) {
  const int truncated = static_cast<int>(x);
  return truncated - (truncated > x ? 1 : 0);
}
int ceil_int(double x) {
  const int truncated = static_cast<int>(x);
  return truncated + (truncated < x ? 1 : 0);
}

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Whole numbers, limits included; empty when first > last.
struct Span {
  std::int32_t first = 0, last = -1;

  [[nodiscard]] std::int32_t size() const { return std::max(0, last - first + 1); }
};

/// Columns and rows of the colour image that matter.
struct Window {
  Span columns, rows;
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

/// One row of depth pixels as the colour camera sees them, whether or not they hold a usable depth:
/// z_color, projection (u, v), and z_depth / z_color.
struct ProjectedRow {
  explicit ProjectedRow(std::size_t width) : z_color(width), u(width), v(width), z_ratio(width) {}
  std::vector<double> z_color, u, v, z_ratio;
};

/// Between parallel cameras R * p = p exactly, which saves the product. Without branches, so that
/// the loop becomes wide vectors.
template <bool kParallel>
void project_row(const std::uint16_t* values, const double* ray_x, double ray_y,
                 const Calibration& believed, ProjectedRow& out) {
  const Eigen::Matrix3d R = believed.T_color_depth.linear();
  const Eigen::Vector3d t = believed.T_color_depth.translation();
  const double fx = believed.color.fx_px, fy = believed.color.fy_px;
  const double cx = believed.color.cx_px, cy = believed.color.cy_px;
  double *z_out = out.z_color.data(), *u_out = out.u.data();
  double *v_out = out.v.data(), *ratio_out = out.z_ratio.data();
  const std::size_t width = out.u.size();
  for (std::size_t i = 0; i < width; ++i) {
    const double z = values[i] / kDepthUnitsPerMetre;
    const double x = z * ray_x[i], y = z * ray_y;
    const double x_color = (kParallel ? x : R(0, 0) * x + R(0, 1) * y + R(0, 2) * z) + t.x();
    const double y_color = (kParallel ? y : R(1, 0) * x + R(1, 1) * y + R(1, 2) * z) + t.y();
    const double z_color = (kParallel ? z : R(2, 0) * x + R(2, 1) * y + R(2, 2) * z) + t.z();
    z_out[i] = z_color;
    u_out[i] = fx * x_color / z_color + cx;
    v_out[i] = fy * y_color / z_color + cy;
    ratio_out[i] = z / z_color;
  }
}

/// Least and greatest stored depth within the camera's range, limits included; none if first >
/// last.
Span values_in_range(const Calibration& believed) {
  const auto in_metres = [](std::int32_t value) { return value / kDepthUnitsPerMetre; };
  Span span{1, 65535};
  while (span.first <= 65535 && !(in_metres(span.first) >= believed.range_min_m)) ++span.first;
  while (span.last >= span.first && !(in_metres(span.last) <= believed.range_max_m)) --span.last;
  return span;
}

/// The pixels of `window` whose centres lie within `reach` of `at` on one axis, |pixel - at| <=
/// reach as docs/methods.md says it: at - reach and at + reach are rounded, so the pixels at either
/// end are asked again.
Span covered(double at, double reach, const Span& window) {
  if (!(at + reach >= window.first - 1 && at - reach <= window.last + 1)) return {};
  const auto within = [&](int pixel) { return std::abs(pixel - at) <= reach; };
  Span span{at - reach <= window.first ? window.first : ceil_int(at - reach),
            at + reach >= window.last ? window.last : floor_int(at + reach)};
  if (span.first > window.first && within(span.first - 1)) --span.first;
  if (span.last < window.last && within(span.last + 1)) ++span.last;
  if (!within(span.first)) ++span.first;
  if (!within(span.last)) --span.last;
  return span;
}

/// Whether a pixel of the window may lie within half a pixel of `at`; false for NaN.
bool touches(double at, const Span& window) {
  return at >= window.first - 0.5 && at <= window.last + 0.5;
}

/// Keeps the nearest depth pixel per colour pixel. Depth pixels arrive in row-major order, so
/// "strictly nearer" leaves ties to the lower row, then column. Pixels that do not matter start out
/// nearer than everything.
class ZBuffer {
 public:
  ZBuffer(const Calibration& believed, const cv::Mat1b& wanted)
      : window_(window_of(wanted, believed.color)),
        values_(values_in_range(believed)),
        ratio_u_(believed.color.fx_px / believed.depth.fx_px),
        ratio_v_(believed.color.fy_px / believed.depth.fy_px),
        ratio_max_(std::max(ratio_u_, ratio_v_)),
        nearest_(window_.rows.size(), window_.columns.size(), kFar),
        source_(believed.color.height_px, believed.color.width_px, RegisteredCloud::kNone) {
    if (!wanted.empty() && !nearest_.empty()) nearest_.setTo(-kFar, within_window(wanted) == 0);
  }

  void cover(const std::uint16_t* values, const ProjectedRow& row, int first_depth_pixel) {
    for (std::size_t i = 0; i < row.u.size(); ++i) {
      if (values[i] < values_.first || values[i] > values_.last || !(row.z_color[i] > 0)) continue;
      const int depth_pixel = first_depth_pixel + static_cast<int>(i);
      if (ratio_max_ * row.z_ratio[i] <= 1.0) {  // covers one pixel, save when it lies half-way
        if (!touches(row.u[i], window_.columns) || !touches(row.v[i], window_.rows)) continue;
        const int u = static_cast<int>(row.u[i] + 0.5), v = static_cast<int>(row.v[i] + 0.5);
        if (std::abs(row.u[i] - u) < 0.5 && std::abs(row.v[i] - v) < 0.5) {
          offer(u, v, row.z_color[i], depth_pixel);
          continue;
        }
      }
      cover_block(row, i, depth_pixel);
    }
  }

  [[nodiscard]] cv::Mat1i take() { return std::move(source_); }

 private:
  void cover_block(const ProjectedRow& row, std::size_t i, int depth_pixel) {
    const double s = row.z_ratio[i];
    const Span columns = covered(row.u[i], 0.5 * std::max(1.0, ratio_u_ * s), window_.columns);
    const Span rows = covered(row.v[i], 0.5 * std::max(1.0, ratio_v_ * s), window_.rows);
    for (int v = rows.first; v <= rows.last; ++v)
      for (int u = columns.first; u <= columns.last; ++u) offer(u, v, row.z_color[i], depth_pixel);
  }

  void offer(int u, int v, double z_color, int depth_pixel) {
    double& nearest = nearest_(v - window_.rows.first, u - window_.columns.first);
    if (z_color >= nearest) return;
    nearest = z_color;
    source_(v, u) = depth_pixel;
  }

  [[nodiscard]] cv::Mat1b within_window(const cv::Mat1b& wanted) const {
    return wanted(cv::Rect(window_.columns.first, window_.rows.first, window_.columns.size(),
                           window_.rows.size()));
  }

  Window window_;
  Span values_;
  double ratio_u_, ratio_v_, ratio_max_;
  cv::Mat1d nearest_;  ///< z_color of the winners, in the window
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
  const bool parallel = believed.T_color_depth.linear() == Eigen::Matrix3d::Identity();
  const auto project = parallel ? project_row<true> : project_row<false>;
  ProjectedRow row(rays.x().size());
  ZBuffer buffer(believed, wanted);
  for (int v = 0; v < depth.rows; ++v) {
    project(depth[v], rays.x().data(), rays.y()[static_cast<std::size_t>(v)], believed, row);
    buffer.cover(depth[v], row, v * depth.cols);
  }
  return {depth, believed.depth, buffer.take()};
}

}  // namespace mapscore
