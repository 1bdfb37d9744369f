// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/settled_depth.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace mapscore {
namespace {

constexpr int kReach_px = 4;
constexpr float kSigmas = 4.0F;
constexpr float kNoisy = 0.0005F;  // 1/m: 4 sigma reach the least step
constexpr int kLeast = 4;
constexpr float kLeastShare = 0.5F;

/// Sums of a plane's fit, about the pixel itself.
struct PlaneSums {
  int labelled = 0, near = 0;
  float u = 0, v = 0, uu = 0, uv = 0, vv = 0, w = 0, uw = 0, vw = 0;

  void add(float du, float dv, float dw) {
    ++near;
    u += du, v += dv, uu += du * du, uv += du * dv, vv += dv * dv;
    w += dw, uw += du * dw, vw += dv * dw;
  }

  /// At the pixel; the mean where all lie in a line.
  [[nodiscard]] float at_pixel() const {
    const float n = static_cast<float>(near);
    Eigen::Matrix3f A;
    A << n, u, v, u, uu, uv, v, uv, vv;
    const float determinant = A.determinant();
    if (determinant < 1.0F) return w / n;
    const Eigen::Vector3f b(w, uw, vw);
    Eigen::Matrix3f first = A;
    first.col(0) = b;
    return first.determinant() / determinant;
  }
};

/// How much w rises from pixel to pixel.
struct WindowSlope {
  float du = 0, dv = 0;
};

PlaneSums sums_about(const cv::Mat1f& inverse, const cv::Mat1w& labels, int v, int u, float within,
                     const WindowSlope& slope) {
  PlaneSums sums;
  const std::uint16_t own = labels(v, u);
  const float here = inverse(v, u);
  const int top = std::max(v - kReach_px, 0), bottom = std::min(v + kReach_px, labels.rows - 1);
  const int left = std::max(u - kReach_px, 0), right = std::min(u + kReach_px, labels.cols - 1);
  for (int y = top; y <= bottom; ++y) {
    const std::uint16_t* label = labels[y];
    const float* w = inverse[y];
    for (int x = left; x <= right; ++x) {
      if (label[x] != own) continue;
      ++sums.labelled;
      const float du = static_cast<float>(x - u), dv = static_cast<float>(y - v);
      const float rise = w[x] - here;
      if (std::abs(rise - slope.du * du - slope.dv * dv) <= within) sums.add(du, dv, rise);
    }
  }
  return sums;
}

float median_of(float* first, float* last) {
  if (first == last) return 0.0F;
  float* const middle = first + (last - first) / 2;
  std::nth_element(first, middle, last);
  return *middle;
}

/// Medians over pairs of neighbours of the label in the window.
WindowSlope slope_about(const cv::Mat1f& inverse, const cv::Mat1w& labels, int v, int u) {
  constexpr int kSide = 2 * kReach_px + 1;
  std::array<float, kSide * kSide> across, down;
  float *end_across = across.data(), *end_down = down.data();
  const std::uint16_t own = labels(v, u);
  const int top = std::max(v - kReach_px, 0), bottom = std::min(v + kReach_px, labels.rows - 1);
  const int left = std::max(u - kReach_px, 0), right = std::min(u + kReach_px, labels.cols - 1);
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      if (labels(y, x) != own) continue;
      if (x < right && labels(y, x + 1) == own) *end_across++ = inverse(y, x + 1) - inverse(y, x);
      if (y < bottom && labels(y + 1, x) == own) *end_down++ = inverse(y + 1, x) - inverse(y, x);
    }
  return {median_of(across.data(), end_across), median_of(down.data(), end_down)};
}

/// Whether enough of the label's pixels lie near the fitted surface.
bool is_on_surface(const PlaneSums& sums) {
  return sums.near >= kLeast &&
         static_cast<float>(sums.near) >= kLeastShare * static_cast<float>(sums.labelled);
}

}  // namespace

bool is_noisy(const DepthEdges& edges) {
  return edges.noise > kNoisy;
}

cv::Mat1f settle_on_surfaces(const DepthEdges& edges, cv::Mat1w& labels) {
  const cv::Mat1f& inverse = edges.inverse_depth;
  const cv::Mat1w given = labels.clone();
  cv::Mat1f settled(inverse.rows, inverse.cols, 0.0F);
  for (int v = 0; v < given.rows; ++v)
    for (int u = 0; u < given.cols; ++u) {
      if (given(v, u) == 0) continue;
      const float within = kSigmas * edges.noise;
      PlaneSums sums = sums_about(inverse, given, v, u, within, {});
      if (!is_on_surface(sums))  // or it slopes
        sums = sums_about(inverse, given, v, u, within, slope_about(inverse, given, v, u));
      if (is_on_surface(sums))
        settled(v, u) = inverse(v, u) + sums.at_pixel();
      else
        labels(v, u) = 0;
    }
  return settled;
}

}  // namespace mapscore
