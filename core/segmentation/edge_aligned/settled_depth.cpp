// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/settled_depth.hpp"

#include "core/segmentation/edge_aligned/window_medians.hpp"
#include "core/wide_vectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace mapscore {
namespace {

constexpr int kReach_px = 4;
constexpr float kSigmas = 4.0F, kLeastSigmas = 1.5F;
constexpr float kLeast = 4;
constexpr float kLeastShare = 0.5F;
constexpr float kNoLabel = -1.0F;  // that no pixel has

/// Of one fit, in metres of depth: the band in which pixels lie on one surface, at least
/// kLeastSigmas and at most kSigmas wide, and how uncertain a depth may be.
struct Limits {
  float band_m, error_m;
};
constexpr Limits kFirst{1e6F, 1e6F}, kSecond{0.02F, 0.01F};

/// How many neighbouring pixels of a row are fitted at once.
constexpr int kFitted = WindowValues::kWindows;
using Fitted = WindowValues::Row;

/// Sums of planes' fits, each about its pixel.
struct PlaneSums {
  Fitted labelled{}, near{}, u{}, v{}, uu{}, uv{}, vv{}, w{}, uw{}, vw{};
};

/// Sums over a window's pixels, side by side in one number; coordinates are counted from the
/// window's corner, so that none is negative.
struct PackedSums {
  static_assert(kReach_px == 4, "sums over 81 pixels fit the bits that each has");
  static constexpr unsigned kU = 7, kV = 16, kLabelled = 25;  // after the number of near pixels
  static constexpr unsigned kVV = 10, kUV = 20;               // after the squares of u
  std::array<std::uint32_t, kFitted> places{}, squares{};

  static constexpr std::uint32_t place(int x, int y) {
    return 1U + (from_corner(x) << kU) + (from_corner(y) << kV);
  }
  static constexpr std::uint32_t square(int x, int y) {
    return static_cast<std::uint32_t>(x * x) + (static_cast<std::uint32_t>(y * y) << kVV) +
           (from_corner(x) * from_corner(y) << kUV);
  }

  void unpack(PlaneSums& sums) const {
    const auto part = [](std::uint32_t packed, unsigned begin, unsigned end) {
      return static_cast<int>((packed >> begin) & ((1U << (end - begin)) - 1U));
    };
    for (std::size_t n = 0; n < kFitted; ++n) {
      const int near = part(places[n], 0, kU);
      const int u = part(places[n], kU, kV), v = part(places[n], kV, kLabelled);
      const int uv = part(squares[n], kUV, 31) - kReach_px * (u + v - kReach_px * near);
      sums.labelled[n] = static_cast<float>(places[n] >> kLabelled);
      sums.near[n] = static_cast<float>(near);
      sums.u[n] = static_cast<float>(u - kReach_px * near);
      sums.v[n] = static_cast<float>(v - kReach_px * near);
      sums.uu[n] = static_cast<float>(part(squares[n], 0, kVV));
      sums.uv[n] = static_cast<float>(uv);
      sums.vv[n] = static_cast<float>(part(squares[n], kVV, kUV));
    }
  }

 private:
  static constexpr std::uint32_t from_corner(int x) {
    return static_cast<std::uint32_t>(x + kReach_px);
  }
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
template <bool kSloped>
MAPSCORE_WIDE_VECTORS PlaneSums sums_about(const RimmedImages& images, int row, int column,
                                           const Fitted& within, const WindowSlopes& slopes) {
  PlaneSums sums;
  PackedSums packed;
  const float* const own = images.labels[row] + column;
  const float* const here = images.inverse[row] + column;
  for (int y = -kReach_px; y <= kReach_px; ++y)
    for (int x = -kReach_px; x <= kReach_px; ++x) {
      const float* const label = images.labels[row + y] + column + x;
      const float* const w = images.inverse[row + y] + column + x;
      const float du = static_cast<float>(x), dv = static_cast<float>(y);
      const std::uint32_t place = PackedSums::place(x, y), square = PackedSums::square(x, y);
      for (std::size_t n = 0; n < kFitted; ++n) {
        const float rise = w[n] - here[n];
        const float off = std::abs(kSloped ? rise - slopes.du[n] * du - slopes.dv[n] * dv : rise);
        const bool is_same = label[n] == own[n], is_near = is_same & (off <= within[n]);
        const std::uint32_t same = is_same ? ~0U : 0U, near = is_near ? ~0U : 0U;
        const float near_rise = is_near ? rise : 0.0F;
        packed.places[n] += (same & (1U << PackedSums::kLabelled)) + (near & place);
        packed.squares[n] += near & square;
        sums.w[n] += near_rise;
        sums.uw[n] += du * near_rise, sums.vw[n] += dv * near_rise;
      }
    }
  packed.unpack(sums);
  return sums;
}

/// Planes fitted about pixels.
struct PlaneFits {
  PlaneSums sums;
  Fitted rise{};      ///< of w at the pixel, from its own
  Fitted variance{};  ///< of w there, in variances of the noise of one pixel

  /// Whether enough of the label's pixels lie near the plane.
  [[nodiscard]] bool is_on_surface(std::size_t n) const {
    return sums.near[n] >= kLeast && sums.near[n] >= kLeastShare * sums.labelled[n];
  }
};

/// Least squares; where all pixels lie in a line, their mean. Undefined without any pixel.
MAPSCORE_WIDE_VECTORS
PlaneFits solve(const PlaneSums& sums) {
  PlaneFits fits{sums};
  for (std::size_t n = 0; n < kFitted; ++n) {
    const float near = sums.near[n], u = sums.u[n], v = sums.v[n], sum_w = sums.w[n];
    const float uu = sums.uu[n], uv = sums.uv[n], vv = sums.vv[n];
    const float cofactor = uu * vv - uv * uv;
    const auto determinant_with = [&](float first, float second, float third) {
      return first * cofactor - u * (second * vv - uv * third) + v * (second * uv - uu * third);
    };
    const float determinant = determinant_with(near, u, v);
    const float numerator = determinant_with(sum_w, sums.uw[n], sums.vw[n]);
    const bool is_line = determinant < 1.0F;
    const float rise_times = is_line ? sum_w : numerator, times = is_line ? near : determinant;
    fits.rise[n] = rise_times / times;
    fits.variance[n] = (is_line ? 1.0F : cofactor) / times;
  }
  return fits;
}

/// The rises from each pixel of the label `own` to its neighbour `right` columns and `down` rows
/// on, in the windows about kFitted pixels.
MAPSCORE_WIDE_VECTORS
void find_rises(const RimmedImages& images, int row, int column, const Fitted& own, int right,
                int down, WindowValues& rises) {
  static_assert(2 * kReach_px * (2 * kReach_px + 1) == WindowValues::kPlaces);
  std::size_t place = 0;
  rises.counts = {};
  for (int y = -kReach_px; y <= kReach_px - down; ++y)
    for (int x = -kReach_px; x <= kReach_px - right; ++x, ++place) {
      const int next_row = row + y + down, next_column = column + x + right;
      const float* const label = images.labels[row + y] + column + x;
      const float* const w = images.inverse[row + y] + column + x;
      const float* const next_label = images.labels[next_row] + next_column;
      const float* const next_w = images.inverse[next_row] + next_column;
      float* const __restrict rise = rises.at[place].data();
      for (std::size_t n = 0; n < kFitted; ++n) {
        const float by = next_w[n] - w[n], label_here = label[n], label_next = next_label[n];
        const float label_own = own[n];
        const bool is_pair = (label_here == label_own) & (label_next == label_own);
        rise[n] = is_pair ? by : WindowValues::kNone;
        rises.counts[n] += is_pair ? 1 : 0;
      }
    }
}

/// Medians over pairs of neighbours of the label `own` in the windows about kFitted pixels; 0 where
/// no pixel has it.
WindowSlopes find_slopes(const RimmedImages& images, int row, int column, const Fitted& own) {
  WindowSlopes slopes;
  WindowValues rises;
  find_rises(images, row, column, own, 1, 0, rises);
  slopes.du = medians_of(rises);
  find_rises(images, row, column, own, 0, 1, rises);
  slopes.dv = medians_of(rises);
  return slopes;
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
      const PlaneFits level = solve(sums_about<false>(images, row, column, within, {}));
      PlaneFits sloped;
      Fitted may_slope;  // the labels of pixels that are on no level surface
      may_slope.fill(kNoLabel);
      for (std::size_t n = 0; n < lanes; ++n)
        if (label[n] != 0.0F && !level.is_on_surface(n)) may_slope[n] = label[n];
      if (std::ranges::any_of(may_slope, [](float own) { return own != kNoLabel; })) {
        const WindowSlopes slopes = find_slopes(images, row, column, may_slope);
        sloped = solve(sums_about<true>(images, row, column, within, slopes));
      }
      for (std::size_t n = 0; n < lanes; ++n) {
        if (label[n] == 0.0F) continue;
        const PlaneFits& fit = level.is_on_surface(n) ? level : sloped;
        const int at = u + static_cast<int>(n);
        const float w = inverse(v, at) + fit.rise[n];
        const float error = noise * std::sqrt(fit.variance[n]);
        if (fit.is_on_surface(n) && error <= limits.error_m * w * w)
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
