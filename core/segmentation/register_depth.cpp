// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/segmentation/depth_spans.hpp"
#include "core/segmentation/registered_cloud.hpp"
#include "core/wide_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

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

/// Whole numbers, limits included; empty when first > last.
struct Span {
  std::int32_t first = 0, last = -1;

  [[nodiscard]] std::int32_t size() const { return std::max(0, last - first + 1); }
};

/// The colour camera's view of depth pixels. Between parallel cameras R * p = p exactly, which
/// saves the product.
struct Projection {
  explicit Projection(const Calibration& believed)
      : R(believed.T_color_depth.linear()),
        t(believed.T_color_depth.translation()),
        fx(believed.color.fx_px),
        fy(believed.color.fy_px),
        cx(believed.color.cx_px),
        cy(believed.color.cy_px),
        parallel(R == Eigen::Matrix3d::Identity()) {}

  template <bool kParallel>
  [[nodiscard]] double x_color(double x, double y, double z) const {
    return (kParallel ? x : R(0, 0) * x + R(0, 1) * y + R(0, 2) * z) + t.x();
  }
  template <bool kParallel>
  [[nodiscard]] double y_color(double x, double y, double z) const {
    return (kParallel ? y : R(1, 0) * x + R(1, 1) * y + R(1, 2) * z) + t.y();
  }
  template <bool kParallel>
  [[nodiscard]] double z_color(double x, double y, double z) const {
    return (kParallel ? z : R(2, 0) * x + R(2, 1) * y + R(2, 2) * z) + t.z();
  }
  [[nodiscard]] Eigen::Vector3d in_color(const Eigen::Vector3d& p) const {
    if (parallel) return p + t;
    return {x_color<false>(p.x(), p.y(), p.z()), y_color<false>(p.x(), p.y(), p.z()),
            z_color<false>(p.x(), p.y(), p.z())};
  }
  [[nodiscard]] double z_of(const Eigen::Vector3d& p) const {
    return parallel ? p.z() + t.z() : z_color<false>(p.x(), p.y(), p.z());
  }

  Eigen::Matrix3d R;
  Eigen::Vector3d t;
  double fx, fy, cx, cy;
  bool parallel;
};

// What a depth pixel covers, in place of the index of the one colour pixel.
constexpr std::int32_t kNothing = -1;    ///< no usable depth, or outside the image
constexpr std::int32_t kUndecided = -2;  ///< perhaps several pixels, or an edge between two

/// Least and greatest stored depth within the camera's range, limits included; none if first >
/// last.
Span values_in_range(const Calibration& believed) {
  const auto in_metres = [](std::int32_t value) { return value / kDepthUnitsPerMetre; };
  Span span{1, 65535};
  while (span.first <= 65535 && !(in_metres(span.first) >= believed.range_min_m)) ++span.first;
  while (span.last >= span.first && !(in_metres(span.last) <= believed.range_max_m)) --span.last;
  return span;
}

/// The pixels of `image` whose centres lie within `reach` of `at` on one axis, |pixel - at| <=
/// reach as docs/methods.md says it: at - reach and at + reach are rounded, so the pixels at either
/// end are asked again.
Span covered(double at, double reach, const Span& image) {
  if (!(at + reach >= image.first - 1 && at - reach <= image.last + 1)) return {};
  const auto within = [&](int pixel) { return std::abs(pixel - at) <= reach; };
  Span span{at - reach <= image.first ? image.first : ceil_int(at - reach),
            at + reach >= image.last ? image.last : floor_int(at + reach)};
  if (span.first > image.first && within(span.first - 1)) --span.first;
  if (span.last < image.last && within(span.last + 1)) ++span.last;
  if (!within(span.first)) ++span.first;
  if (!within(span.last)) --span.last;
  return span;
}

/// What is sure of a row of depth pixels after one division for each, where the definition asks for
/// three: the quotients here are off by a few last bits, and whatever lies that near an edge, or
/// may cover more than one pixel, stays undecided. Without branches, so that the loop becomes wide
/// vectors.
struct Sieve {
  explicit Sieve(const Calibration& believed)
      : values(values_in_range(believed)),
        columns{0, believed.color.width_px - 1},
        rows{0, believed.color.height_px - 1},
        width_px(believed.color.width_px),
        ratio_max(std::max(believed.color.fx_px / believed.depth.fx_px,
                           believed.color.fy_px / believed.depth.fy_px)),
        half_u(0.5 - 1e-12 * (1.0 + std::abs(believed.color.cx_px) + believed.color.width_px)),
        half_v(0.5 - 1e-12 * (1.0 + std::abs(believed.color.cy_px) + believed.color.height_px)) {}

  template <bool kParallel>
  [[gnu::always_inline]] void sort(const Projection& projection, const std::uint16_t* row,
                                   const double* ray_x, double ray_y, std::size_t width,
                                   std::int32_t* target) const {
    const Projection camera = projection;  // copies: what is written cannot change them
    const Sieve sieve = *this;
    const double left = columns.first - 1.0, right = columns.last + 1.0;
    const double top = rows.first - 1.0, bottom = rows.last + 1.0;
    for (std::size_t i = 0; i < width; ++i) {
      const std::int32_t value = row[i];
      const double z = value / kDepthUnitsPerMetre, x = z * ray_x[i], y = z * ray_y;
      const double z_color = camera.z_color<kParallel>(x, y, z), inverse = 1.0 / z_color;
      double u = camera.fx * camera.x_color<kParallel>(x, y, z) * inverse + camera.cx;
      double v = camera.fy * camera.y_color<kParallel>(x, y, z) * inverse + camera.cy;
      u = u > left ? u : left;  // left for NaN
      u = u < right ? u : right;
      v = v > top ? v : top;
      v = v < bottom ? v : bottom;
      const auto pixel_u = static_cast<std::int32_t>(u + 1.5) - 1;
      const auto pixel_v = static_cast<std::int32_t>(v + 1.5) - 1;
      const double off_u = std::abs(u - pixel_u), off_v = std::abs(v - pixel_v);
      const double ratio = sieve.ratio_max * (z * inverse);
      std::int32_t result = pixel_v * sieve.width_px + pixel_u;
      result = pixel_u < sieve.columns.first ? kNothing : result;
      result = pixel_u > sieve.columns.last ? kNothing : result;
      result = pixel_v < sieve.rows.first ? kNothing : result;
      result = pixel_v > sieve.rows.last ? kNothing : result;
      result = off_u <= sieve.half_u ? result : kUndecided;
      result = off_v <= sieve.half_v ? result : kUndecided;
      result = ratio <= 1.0 - 1e-12 ? result : kUndecided;
      result = z_color > 0 ? result : kNothing;
      result = value < sieve.values.first ? kNothing : result;
      target[i] = value > sieve.values.last ? kNothing : result;
    }
  }

  Span values, columns, rows;
  std::int32_t width_px;
  double ratio_max;
  double half_u, half_v;  ///< half a pixel, less what rounding may move
};

MAPSCORE_WIDE_VECTORS
void sort_row(const Sieve& sieve, const Projection& projection, const std::uint16_t* row,
              const double* ray_x, double ray_y, std::size_t width, std::int32_t* target) {
  if (projection.parallel)
    sieve.sort<true>(projection, row, ray_x, ray_y, width, target);
  else
    sieve.sort<false>(projection, row, ray_x, ray_y, width, target);
}

/// Keeps the nearest depth pixel per colour pixel. Depth pixels arrive in row-major order, so
/// "strictly nearer" leaves ties to the lower row, then column. The winners so far stand in for a
/// buffer of distances: most colour pixels are asked for once.
class ZBuffer {
 public:
  ZBuffer(const cv::Mat1w& depth, const Calibration& believed, const cv::Mat1b& wanted)
      : depth_(depth),
        rays_(believed.depth),
        projection_(believed),
        sieve_(believed),
        ratio_u_(believed.color.fx_px / believed.depth.fx_px),
        ratio_v_(believed.color.fy_px / believed.depth.fy_px),
        wanted_(wanted.isContinuous() ? wanted : wanted.clone()),
        spans_(spans_that_may_cover(wanted, believed)),
        source_(believed.color.height_px, believed.color.width_px) {
    std::fill_n(source_.ptr<int>(), source_.total(), RegisteredCloud::kNone);
  }

  void cover() {
    const bool all = wanted_.empty();
    std::vector<std::int32_t> targets(static_cast<std::size_t>(depth_.cols));
    for (int v = 0; v < depth_.rows; ++v) {
      const auto [first, last] = spans_[static_cast<std::size_t>(v)];
      if (first > last) continue;
      const double ray_y = rays_.y()[static_cast<std::size_t>(v)];
      const auto width = static_cast<std::size_t>(last - first + 1);
      sort_row(sieve_, projection_, depth_[v] + first, rays_.x().data() + first, ray_y, width,
               targets.data());
      for (std::size_t i = 0; i < width; ++i) {
        const int depth_pixel = v * depth_.cols + first + static_cast<int>(i);
        if (targets[i] >= 0) {
          if (all || wanted_.data[targets[i]] != 0) offer(targets[i], depth_pixel);
        } else if (targets[i] == kUndecided)
          cover_block(depth_pixel);
      }
    }
  }

  [[nodiscard]] cv::Mat1i take() { return std::move(source_); }

 private:
  /// The definition, by itself.
  void cover_block(int depth_pixel) {
    const Eigen::Vector3d p_depth = point(depth_pixel), p = projection_.in_color(p_depth);
    const double u = projection_.fx * p.x() / p.z() + projection_.cx;
    const double v = projection_.fy * p.y() / p.z() + projection_.cy;
    const double s = p_depth.z() / p.z();
    const Span columns = covered(u, 0.5 * std::max(1.0, ratio_u_ * s), sieve_.columns);
    const Span rows = covered(v, 0.5 * std::max(1.0, ratio_v_ * s), sieve_.rows);
    for (int row = rows.first; row <= rows.last; ++row)
      for (int column = columns.first; column <= columns.last; ++column)
        if (wanted_.empty() || wanted_(row, column) != 0)
          offer(row * source_.cols + column, depth_pixel);
  }

  void offer(int color_pixel, int depth_pixel) {
    int& source = source_.ptr<int>()[color_pixel];
    if (source == RegisteredCloud::kNone || z_color(depth_pixel) < z_color(source))
      source = depth_pixel;
  }

  [[nodiscard]] Eigen::Vector3d point(int depth_pixel) const {
    const int v = depth_pixel / depth_.cols, u = depth_pixel % depth_.cols;
    return rays_.point(u, v, depth_(v, u) / kDepthUnitsPerMetre);
  }
  [[nodiscard]] double z_color(int depth_pixel) const {
    return projection_.z_of(point(depth_pixel));
  }

  const cv::Mat1w depth_;
  DepthRays rays_;
  Projection projection_;
  Sieve sieve_;
  double ratio_u_, ratio_v_;
  cv::Mat1b wanted_;
  std::vector<ColumnSpan> spans_;
  cv::Mat1i source_;
};

bool has_size(const cv::Mat& image, const CameraModel& camera) {
  return image.cols == camera.width_px && image.rows == camera.height_px;
}

}  // namespace

RegisteredCloud register_depth(const cv::Mat1w& depth, const Calibration& believed,
                               const cv::Mat1b& wanted) {
  check(believed);
  if (!has_size(depth, believed.depth))
    throw Error(
        "depth image: not of the depth camera's size; give the intrinsics it was taken with");
  if (!wanted.empty() && !has_size(wanted, believed.color))
    throw Error(
        "label image: not of the colour camera's size; give the intrinsics it was taken with");
  ZBuffer buffer(depth, believed, wanted);
  buffer.cover();
  return {depth, believed.depth, buffer.take()};
}

}  // namespace mapscore
