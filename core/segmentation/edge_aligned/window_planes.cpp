// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/window_planes.hpp"

#include "core/wide_vectors.hpp"

#include <cmath>
#include <cstdint>

namespace mapscore {
namespace {

constexpr int kReach_px = WindowPlanes::kReach_px, kEdge_px = WindowPlanes::kEdge_px;
constexpr std::size_t kFitted = WindowPlanes::kFitted;
using Fitted = WindowPlanes::Row;

/// Sums of planes' fits, each about its pixel.
struct PlaneSums {
  Fitted labelled, near, u, v, uu, uv, vv, w, uw, vw;
};

/// Sums over a window's pixels, side by side in one number; coordinates are counted from the
/// window's corner, so that none is negative.
struct PackedSums {
  static_assert(kReach_px == 4, "sums over 81 pixels fit the bits that each has");
  static constexpr unsigned kU = 7, kV = 16, kLabelled = 25;  // after the number of near pixels
  static constexpr unsigned kVV = 10, kUV = 20;               // after the squares of u
  std::array<std::uint32_t, kFitted> places{}, squares{};

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
};

/// A pixel of a window: where it lies from the middle, and what it adds to the packed sums.
struct WindowPixel {
  float u, v;
  std::uint32_t place, square;
};

/// Row by row. A table, since to compute what each pixel adds takes as long as to add it.
constexpr auto kWindow = [] {
  std::array<WindowPixel, kEdge_px * kEdge_px> window{};
  std::uint32_t n = 0;
  for (std::uint32_t y = 0; y < kEdge_px; ++y)
    for (std::uint32_t x = 0; x < kEdge_px; ++x, ++n) {
      const int u = static_cast<int>(x) - kReach_px, v = static_cast<int>(y) - kReach_px;
      const auto uu = static_cast<std::uint32_t>(u * u), vv = static_cast<std::uint32_t>(v * v);
      window[n] = {static_cast<float>(u), static_cast<float>(v),
                   1U + (x << PackedSums::kU) + (y << PackedSums::kV),
                   uu + (vv << PackedSums::kVV) + (x * y << PackedSums::kUV)};
    }
  return window;
}();

/// How much w rises from pixel to pixel.
struct WindowSlopes {
  Fitted du{}, dv{};
};
constexpr WindowSlopes kLevel;

/// Sums about kFitted pixels. `kSloped`: near is what lies near planes with these slopes.
template <bool kSloped, typename Windows>
MAPSCORE_WIDE_VECTORS PlaneSums sums_about(const Windows& windows, const Fitted& within,
                                           const WindowSlopes& slopes) {
  Fitted sums_w{}, sums_uw{}, sums_vw{};
  PackedSums packed;
  const float *const own = windows.label(0, 0), *const here = windows.w(0, 0);
  std::size_t at = 0;
  for (int y = -kReach_px; y <= kReach_px; ++y)
    for (int x = -kReach_px; x <= kReach_px; ++x) {
      const float *const label = windows.label(x, y), *const w = windows.w(x, y);
      const auto& [du, dv, place, square] = kWindow[at++];
      for (std::size_t n = 0; n < kFitted; ++n) {
        const float rise = w[n] - here[n];
        const float off = std::abs(kSloped ? rise - slopes.du[n] * du - slopes.dv[n] * dv : rise);
        const bool is_same = label[n] == own[n], is_near = is_same & (off <= within[n]);
        const std::uint32_t same = is_same ? ~0U : 0U, near = is_near ? ~0U : 0U;
        const float near_rise = is_near ? rise : 0.0F;
        packed.places[n] += (same & (1U << PackedSums::kLabelled)) + (near & place);
        packed.squares[n] += near & square;
        sums_w[n] += near_rise;
        sums_uw[n] += du * near_rise, sums_vw[n] += dv * near_rise;
      }
    }
  PlaneSums sums;
  packed.unpack(sums);
  sums.w = sums_w, sums.uw = sums_uw, sums.vw = sums_vw;
  return sums;
}

/// Least squares; where all pixels lie in a line, their mean. Undefined without any pixel.
MAPSCORE_WIDE_VECTORS
WindowPlanes solve(const PlaneSums& sums) {
  WindowPlanes fits;
  fits.labelled = sums.labelled, fits.near = sums.near;
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

/// The rises from one place of kFitted windows to the next, where both have the middle's label.
MAPSCORE_WIDE_VECTORS
void find_rises(const float* own, const float* label, const float* w, const float* next_label,
                const float* next_w, float* rises) {
  MAPSCORE_NO_OVERLAPS
  for (std::size_t n = 0; n < kFitted; ++n) {
    const float by = next_w[n] - w[n];
    const bool is_pair = (label[n] == own[n]) & (next_label[n] == own[n]);
    rises[n] = is_pair ? by : WindowValues::kNone;
  }
}

/// Medians over pairs of neighbours in the windows.
WindowSlopes find_slopes(const CopiedWindows& windows) {
  static_assert((kEdge_px - 1) * kEdge_px == WindowValues::kPlaces);
  const auto medians_to = [&](int right, int down) {
    WindowValues rises;
    std::size_t pair = 0;
    for (int y = -kReach_px; y <= kReach_px - down; ++y)
      for (int x = -kReach_px; x <= kReach_px - right; ++x)
        find_rises(windows.label(0, 0), windows.label(x, y), windows.w(x, y),
                   windows.label(x + right, y + down), windows.w(x + right, y + down),
                   rises.at[pair++].data());
    return medians_of(rises);
  };
  return {medians_to(1, 0), medians_to(0, 1)};
}

}  // namespace

RimmedImages::RimmedImages(const cv::Mat1f& inverse_depth, const cv::Mat1w& pixel_labels) {
  cv::Mat1f as_floats;
  pixel_labels.convertTo(as_floats, CV_32F);
  const auto widen = [](const cv::Mat1f& from, cv::Mat1f& to) {
    cv::copyMakeBorder(from, to, kReach_px, kReach_px, kReach_px,
                       kReach_px + static_cast<int>(kFitted), cv::BORDER_CONSTANT, 0.0);
  };
  widen(as_floats, labels);
  widen(inverse_depth, inverse);
}

void CopiedWindows::set(std::size_t n, const RimmedImages& images, int u, int v) {
  std::size_t place = 0;
  for (int y = 0; y < kEdge_px; ++y) {
    const float *label = images.labels[v + y] + u, *w = images.inverse[v + y] + u;
    for (int x = 0; x < kEdge_px; ++x, ++place)
      labels_[place][n] = label[x], inverse_[place][n] = w[x];
  }
}

WindowPlanes fit_level_planes(const WindowsInRow& windows, const WindowPlanes::Row& within) {
  return solve(sums_about<false>(windows, within, kLevel));
}

WindowPlanes fit_sloped_planes(const CopiedWindows& windows, const WindowPlanes::Row& within) {
  return solve(sums_about<true>(windows, within, find_slopes(windows)));
}

}  // namespace mapscore
