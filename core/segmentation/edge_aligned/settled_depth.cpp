// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/settled_depth.hpp"

#include "core/wide_vectors.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace mapscore {
namespace {

constexpr int kReach_px = 4;
constexpr float kSigmas = 4.0F, kLeastSigmas = 1.5F;
constexpr float kLeast = 4;
constexpr float kLeastShare = 0.5F;

/// Of one fit, in metres of depth: the band in which pixels lie on one surface, at least
/// kLeastSigmas and at most kSigmas wide, and how uncertain a depth may be.
struct Limits {
  float band_m, error_m;
};
constexpr Limits kFirst{1e6F, 1e6F}, kSecond{0.02F, 0.01F};

/// How many neighbouring pixels of a row are fitted at once.
constexpr int kFitted = 16;
using Fitted = std::array<float, kFitted>;

/// Sums of planes' fits, each about its pixel.
struct PlaneSums {
  Fitted labelled{}, near{}, u{}, v{}, uu{}, uv{}, vv{}, w{}, uw{}, vw{};
};

/// How much w rises from pixel to pixel.
struct WindowSlopes {
  Fitted du{}, dv{};
};

/// The images with a rim as wide as the window's reach, so that no window leaves them; labels as
/// floats, which hold them exactly.
struct RimmedImages {
  cv::Mat1f labels, inverse;
};

/// Sums about kFitted pixels from a place of the rimmed images on.
MAPSCORE_WIDE_VECTORS
PlaneSums sums_about(const RimmedImages& images, int row, int column, const Fitted& within,
                     const WindowSlopes& slopes) {
  PlaneSums sums;
  const float* const own = images.labels[row] + column;
  const float* const here = images.inverse[row] + column;
  for (int y = -kReach_px; y <= kReach_px; ++y)
    for (int x = -kReach_px; x <= kReach_px; ++x) {
      const float* const label = images.labels[row + y] + column + x;
      const float* const w = images.inverse[row + y] + column + x;
      const float du = static_cast<float>(x), dv = static_cast<float>(y);
      for (std::size_t n = 0; n < kFitted; ++n) {
        const float rise = w[n] - here[n];
        const float off = std::abs(rise - slopes.du[n] * du - slopes.dv[n] * dv);
        const float same = label[n] == own[n] ? 1.0F : 0.0F;
        const float near = off <= within[n] ? same : 0.0F;
        sums.labelled[n] += same;
        sums.near[n] += near;
        sums.u[n] += near * du, sums.v[n] += near * dv;
        sums.uu[n] += near * (du * du), sums.uv[n] += near * (du * dv);
        sums.vv[n] += near * (dv * dv);
        sums.w[n] += near * rise;
        sums.uw[n] += near * (du * rise), sums.vw[n] += near * (dv * rise);
      }
    }
  return sums;
}

/// Whether enough of the label's pixels lie near the fitted surface.
bool is_on_surface(const PlaneSums& sums, std::size_t n) {
  return sums.near[n] >= kLeast && sums.near[n] >= kLeastShare * sums.labelled[n];
}

/// A fitted plane at its pixel.
struct PlaneAtPixel {
  float rise;   ///< of w from the pixel's own
  float error;  ///< standard error of w, in standard deviations of the noise of one pixel
};

/// The mean where all pixels lie in a line.
PlaneAtPixel at_pixel(const PlaneSums& sums, std::size_t n) {
  Eigen::Matrix3f A;
  A << sums.near[n], sums.u[n], sums.v[n], sums.u[n], sums.uu[n], sums.uv[n], sums.v[n], sums.uv[n],
      sums.vv[n];
  const float determinant = A.determinant();
  if (determinant < 1.0F) return {sums.w[n] / sums.near[n], 1.0F / std::sqrt(sums.near[n])};
  const float cofactor = A(1, 1) * A(2, 2) - A(1, 2) * A(2, 1);
  A.col(0) = Eigen::Vector3f(sums.w[n], sums.uw[n], sums.vw[n]);
  return {A.determinant() / determinant, std::sqrt(cofactor / determinant)};
}

float median_of(float* first, float* last) {
  if (first == last) return 0.0F;
  float* const middle = first + (last - first) / 2;
  std::nth_element(first, middle, last);
  return *middle;
}

/// Medians over pairs of neighbours of the label in the window about a pixel.
void find_slope(const RimmedImages& images, int row, int column, std::size_t n,
                WindowSlopes& slopes) {
  constexpr int kSide = 2 * kReach_px + 1;
  std::array<float, kSide * kSide> across, down;
  float *end_across = across.data(), *end_down = down.data();
  const float own = images.labels(row, column);
  for (int y = row - kReach_px; y <= row + kReach_px; ++y) {
    const float *label = images.labels[y], *w = images.inverse[y];
    const float *label_below = images.labels[y + 1], *w_below = images.inverse[y + 1];
    for (int x = column - kReach_px; x <= column + kReach_px; ++x) {
      if (label[x] != own) continue;
      if (x < column + kReach_px && label[x + 1] == own) *end_across++ = w[x + 1] - w[x];
      if (y < row + kReach_px && label_below[x] == own) *end_down++ = w_below[x] - w[x];
    }
  }
  slopes.du[n] = median_of(across.data(), end_across);
  slopes.dv[n] = median_of(down.data(), end_down);
}

/// A row is fitted in blocks of kFitted pixels; the last block reaches beyond the image.
RimmedImages rimmed(const cv::Mat1f& inverse, const cv::Mat1w& labels) {
  RimmedImages images;
  cv::Mat1f as_floats;
  labels.convertTo(as_floats, CV_32F);
  const auto widen = [](const cv::Mat1f& from, cv::Mat1f& to) {
    cv::copyMakeBorder(from, to, kReach_px, kReach_px + 1, kReach_px, kReach_px + kFitted,
                       cv::BORDER_CONSTANT, 0.0);
  };
  widen(as_floats, images.labels);
  widen(inverse, images.inverse);
  return images;
}

/// How far in w from each of kFitted pixels others of its surface lie.
Fitted bands_about(const float* w, float noise, float band_m) {
  Fitted within;
  for (std::size_t n = 0; n < kFitted; ++n)
    within[n] = std::clamp(band_m * w[n] * w[n], kLeastSigmas * noise, kSigmas * noise);
  return within;
}

/// w of planes fitted about labelled pixels. Those on no surface lose their label, and those whose
/// depth is too uncertain.
cv::Mat1f fit_planes(const cv::Mat1f& inverse, float noise, const Limits& limits,
                     cv::Mat1w& labels) {
  const RimmedImages images = rimmed(inverse, labels);
  cv::Mat1f settled(labels.size(), 0.0F);
  for (int v = 0; v < labels.rows; ++v)
    for (int u = 0; u < labels.cols; u += kFitted) {
      const int row = v + kReach_px, column = u + kReach_px;
      const auto lanes = static_cast<std::size_t>(std::min(kFitted, labels.cols - u));
      const float* const label = images.labels[row] + column;
      if (std::all_of(label, label + lanes, [](float own) { return own == 0.0F; })) continue;
      const Fitted within = bands_about(images.inverse[row] + column, noise, limits.band_m);
      const PlaneSums level = sums_about(images, row, column, within, {});
      PlaneSums sloped;
      WindowSlopes slopes;
      bool any_slopes = false;
      for (std::size_t n = 0; n < lanes; ++n)
        if (label[n] != 0.0F && !is_on_surface(level, n)) {
          find_slope(images, row, column + static_cast<int>(n), n, slopes);
          any_slopes = true;
        }
      if (any_slopes) sloped = sums_about(images, row, column, within, slopes);
      for (std::size_t n = 0; n < lanes; ++n) {
        if (label[n] == 0.0F) continue;
        const PlaneSums& sums = is_on_surface(level, n) ? level : sloped;
        const int at = u + static_cast<int>(n);
        const PlaneAtPixel plane = at_pixel(sums, n);
        const float w = inverse(v, at) + plane.rise;
        if (is_on_surface(sums, n) && noise * plane.error <= limits.error_m * w * w)
          settled(v, at) = w;
        else
          labels(v, at) = 0;
      }
    }
  return settled;
}

}  // namespace

cv::Mat1f settle_on_surfaces(const DepthEdges& edges, cv::Mat1w& labels) {
  const cv::Mat1f first = fit_planes(edges.inverse_depth, edges.noise, kFirst, labels);
  return fit_planes(first, edges.noise, kSecond, labels);
}

}  // namespace mapscore
