// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/rivals/surface_normals.hpp"

#include "core/geometry/depth_rays.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace mapscore {
namespace {

/// Differences of w along one axis, kept by the first pixel of each pair, and which pairs count.
struct Slopes {
  explicit Slopes(cv::Size size) : rise(size, 0.0F), pairs(size, 0.0F) {}

  /// `ahead`: how many pixels the second of a pair lies after the first in memory.
  void read_row(const float* z, const float* w, int ahead, int count, int v) {
    float *rise_row = rise[v], *pairs_row = pairs[v];
    for (int u = 0; u < count; ++u) {
      const float near = std::min(z[u], z[u + ahead]);
      const bool one_surface = (near > 0) & (std::abs(z[u] - z[u + ahead]) <= kOneSurface * near);
      rise_row[u] = one_surface ? w[u + ahead] - w[u] : 0.0F;
      pairs_row[u] = one_surface ? 1.0F : 0.0F;
    }
  }
  /// Sums over a window that begins `before` pixels left of and above a pixel. Beyond the image's
  /// edge there are no pairs.
  void sum(cv::Size window, cv::Point before) {
    for (cv::Mat1f* image : {&rise, &pairs})
      cv::boxFilter(*image, *image, CV_32F, window, before, false, cv::BORDER_CONSTANT);
  }

  cv::Mat1f rise, pairs;
};

}  // namespace

cv::Mat1f depth_in_range(const cv::Mat1w& depth, const Calibration& believed) {
  cv::Mat1f depth_m(depth.size());
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) {
      const double z = depth(v, u) / kDepthUnitsPerMetre;
      const bool in_range =
          depth(v, u) != 0 && z >= believed.range_min_m && z <= believed.range_max_m;
      depth_m(v, u) = in_range ? static_cast<float>(z) : 0.0F;
    }
  return depth_m;
}

VectorImage points_of(const cv::Mat1f& depth_m, const CameraModel& camera) {
  const DepthRays rays(camera);
  VectorImage points{cv::Mat1f(depth_m.size()), cv::Mat1f(depth_m.size()), depth_m};
  for (int v = 0; v < depth_m.rows; ++v) {
    const auto ray_y = static_cast<float>(rays.y()[static_cast<std::size_t>(v)]);
    const float* z = depth_m[v];
    float *x = points.x[v], *y = points.y[v];
    for (int u = 0; u < depth_m.cols; ++u) {
      x[u] = z[u] * static_cast<float>(rays.x()[static_cast<std::size_t>(u)]);
      y[u] = z[u] * ray_y;
    }
  }
  return points;
}

VectorImage surface_normals(const cv::Mat1f& depth_m, const CameraModel& camera, int window_px) {
  const cv::Size size = depth_m.size();
  cv::Mat1f w(size);
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u) w(v, u) = depth_m(v, u) > 0 ? 1.0F / depth_m(v, u) : 0.0F;
  Slopes along_row(size), along_column(size);
  for (int v = 0; v < size.height; ++v) {
    along_row.read_row(depth_m[v], w[v], 1, size.width - 1, v);
    if (v + 1 < size.height) along_column.read_row(depth_m[v], w[v], size.width, size.width, v);
  }
  // Both pixels of a pair lie in the window, so there is one pair less than pixels along its axis.
  const int half = window_px / 2;
  along_row.sum({window_px - 1, window_px}, {half, half});
  along_column.sum({window_px, window_px - 1}, {half, half});
  // The slopes' images become the normals': fresh memory costs more than what is computed.
  VectorImage normals{along_row.rise, along_column.rise, w};
  const DepthRays rays(camera);
  const auto fx = static_cast<float>(camera.fx_px), fy = static_cast<float>(camera.fy_px);
  for (int v = 0; v < size.height; ++v) {
    const auto ray_y = static_cast<float>(rays.y()[static_cast<std::size_t>(v)]);
    for (int u = 0; u < size.width; ++u) {
      const float pairs_u = along_row.pairs(v, u), pairs_v = along_column.pairs(v, u);
      const bool found = (w(v, u) > 0) & (pairs_u > 0.5F) & (pairs_v > 0.5F);
      const float a = fx * along_row.rise(v, u) / std::max(pairs_u, 1.0F);
      const float b = fy * along_column.rise(v, u) / std::max(pairs_v, 1.0F);
      const float c =
          w(v, u) - a * static_cast<float>(rays.x()[static_cast<std::size_t>(u)]) - b * ray_y;
      const float length = std::sqrt(a * a + b * b + c * c);
      const float scale = found & (length > 0) ? -1.0F / length : 0.0F;
      normals.x(v, u) = scale * a;
      normals.y(v, u) = scale * b;
      normals.z(v, u) = scale * c;
    }
  }
  return normals;
}

}  // namespace mapscore
