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
#include <span>
#include <vector>

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
constexpr std::size_t kFitted = WindowValues::kWindows;
using Fitted = WindowValues::Row;

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

constexpr int kEdge_px = 2 * kReach_px + 1;  // of a window

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

/// The images with a rim as wide as the window's reach, so that no window leaves them; labels as
/// floats, which hold them exactly.
struct RimmedImages {
  cv::Mat1f labels, inverse;
};

/// The windows about kFitted pixels beside each other in a row of the rimmed images.
struct WindowsInRow {
  const float *own_label, *own_w;  ///< the first pixel's
  std::ptrdiff_t stride;

  WindowsInRow(const RimmedImages& images, int row, int column)
      : own_label(images.labels[row] + column),
        own_w(images.inverse[row] + column),
        stride(static_cast<std::ptrdiff_t>(images.labels.step1())) {}

  [[nodiscard]] const float* label(int x, int y) const { return own_label + y * stride + x; }
  [[nodiscard]] const float* w(int x, int y) const { return own_w + y * stride + x; }
};

/// The windows about kFitted pixels from anywhere, copied: by place in the window, of each pixel.
struct CopiedWindows {
  std::array<Fitted, kEdge_px * kEdge_px> labels, inverse;

  /// `n`: which of the pixels.
  void copy(const RimmedImages& images, const cv::Point& pixel, std::size_t n) {
    std::size_t place = 0;
    for (int y = 0; y < kEdge_px; ++y) {
      const float *label_row = images.labels[pixel.y + y] + pixel.x,
                  *w_row = images.inverse[pixel.y + y] + pixel.x;
      for (int x = 0; x < kEdge_px; ++x, ++place)
        labels[place][n] = label_row[x], inverse[place][n] = w_row[x];
    }
  }

  [[nodiscard]] const float* label(int x, int y) const { return labels[place_of(x, y)].data(); }
  [[nodiscard]] const float* w(int x, int y) const { return inverse[place_of(x, y)].data(); }

  static std::size_t place_of(int x, int y) {
    return static_cast<std::size_t>((y + kReach_px) * kEdge_px + x + kReach_px);
  }
};

/// Sums about kFitted pixels.
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

/// Planes fitted about pixels.
struct PlaneFits {
  Fitted labelled, near;
  Fitted rise;      ///< of w at the pixel, from its own
  Fitted variance;  ///< of w there, in variances of the noise of one pixel
};

/// Whether enough of the label's pixels lie near the plane of pixel n.
inline bool is_on_surface(const PlaneFits& fits, std::size_t n) {
  return (fits.near[n] >= kLeast) & (fits.near[n] >= kLeastShare * fits.labelled[n]);
}

/// Least squares; where all pixels lie in a line, their mean. Undefined without any pixel.
MAPSCORE_WIDE_VECTORS
PlaneFits solve(const PlaneSums& sums) {
  PlaneFits fits;
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

/// Whether some labelled pixels are on no surface.
MAPSCORE_WIDE_VECTORS
bool any_off_surface(const PlaneFits& fits, const float* label) {
  int any = 0;
  for (std::size_t n = 0; n < kFitted; ++n)
    any |= (label[n] != 0.0F) & !is_on_surface(fits, n) ? 1 : 0;
  return any != 0;
}

/// w of the planes, 0 where there is none or the depth is too uncertain.
MAPSCORE_WIDE_VECTORS
Fitted settled_on(const PlaneFits& fits, const float* label, const float* here, float noise,
                  const Limits& limits) {
  Fitted settled;
  const float most_error_m = limits.error_m;
  for (std::size_t n = 0; n < kFitted; ++n) {
    const float w = here[n] + fits.rise[n], error = noise * std::sqrt(fits.variance[n]);
    const bool is_sure = is_on_surface(fits, n) & (error <= most_error_m * w * w);
    settled[n] = (label[n] != 0.0F) & is_sure ? w : 0.0F;
  }
  return settled;
}

/// The rise from one place of kFitted windows to another, where both have the label of the middle.
MAPSCORE_WIDE_VECTORS
void find_rises(const CopiedWindows& windows, std::size_t from, std::size_t to,
                WindowValues::Row& rises) {
  const float* const own = windows.label(0, 0);
  const Fitted &label = windows.labels[from], &next_label = windows.labels[to];
  const Fitted &w = windows.inverse[from], &next_w = windows.inverse[to];
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
        find_rises(windows, CopiedWindows::place_of(x, y),
                   CopiedWindows::place_of(x + right, y + down), rises.at[pair++]);
    return medians_of(rises);
  };
  return {medians_to(1, 0), medians_to(0, 1)};
}

/// A row is fitted in blocks of kFitted pixels; the last block reaches beyond the image.
RimmedImages rimmed(const cv::Mat1f& inverse, const cv::Mat1w& labels) {
  RimmedImages images;
  cv::Mat1f as_floats;
  labels.convertTo(as_floats, CV_32F);
  const auto widen = [](const cv::Mat1f& from, cv::Mat1f& to) {
    cv::copyMakeBorder(from, to, kReach_px, kReach_px + 1, kReach_px,
                       kReach_px + static_cast<int>(kFitted), cv::BORDER_CONSTANT, 0.0);
  };
  widen(as_floats, images.labels);
  widen(inverse, images.inverse);
  return images;
}

/// How far in w from each of kFitted pixels others of its surface lie.
MAPSCORE_WIDE_VECTORS
Fitted bands_about(const float* here, float noise, float band_m) {
  Fitted within;
  const float narrowest = kLeastSigmas * noise, widest = kSigmas * noise;
  for (std::size_t n = 0; n < kFitted; ++n) {
    const float w = here[n], band = band_m * w * w;
    const float limited = band < narrowest ? narrowest : band;
    within[n] = limited > widest ? widest : limited;
  }
  return within;
}

/// Fits planes about pixels: level ones to kFitted beside each other, then sloped ones to those
/// that are on no level surface, kFitted at once from wherever they are.
class PlaneFitter {
 public:
  PlaneFitter(const cv::Mat1f& inverse, const cv::Mat1w& labels, float noise, const Limits& limits)
      : images_(rimmed(inverse, labels)),
        noise_(noise),
        limits_(limits),
        settled_(labels.size(), 0.0F) {}

  /// w of the planes, 0 where a pixel has no label, is on no surface, or its depth is too
  /// uncertain.
  cv::Mat1f fit() {
    for (int v = 0; v < settled_.rows; ++v)
      for (int u = 0; u < settled_.cols; u += kFitted) fit_level(u, v);
    for (std::size_t n = 0; n < off_surface_.size(); n += kFitted)
      fit_sloped(std::span(off_surface_).subspan(n, std::min(kFitted, off_surface_.size() - n)));
    return settled_;
  }

 private:
  void fit_level(int u, int v) {
    const WindowsInRow windows(images_, v + kReach_px, u + kReach_px);
    const float *const label = windows.label(0, 0), *const here = windows.w(0, 0);
    const int count = std::min(static_cast<int>(kFitted), settled_.cols - u);
    if (std::all_of(label, label + count, [](float own) { return own == 0.0F; })) return;
    const Fitted within = bands_about(here, noise_, limits_.band_m);
    const PlaneFits fits = solve(sums_about<false>(windows, within, {}));
    const Fitted w = settled_on(fits, label, here, noise_, limits_);
    std::copy_n(w.data(), count, settled_[v] + u);
    if (!any_off_surface(fits, label)) return;
    for (int n = 0; n < count; ++n)
      if (label[n] != 0.0F && !is_on_surface(fits, static_cast<std::size_t>(n)))
        off_surface_.emplace_back(u + n, v);
  }

  void fit_sloped(std::span<const cv::Point> pixels) {
    for (std::size_t n = 0; n < kFitted; ++n)  // the last ones again, where there are fewer
      copied_.copy(images_, pixels[std::min(n, pixels.size() - 1)], n);
    const float *const label = copied_.label(0, 0), *const here = copied_.w(0, 0);
    const Fitted within = bands_about(here, noise_, limits_.band_m);
    const PlaneFits fits = solve(sums_about<true>(copied_, within, find_slopes(copied_)));
    const Fitted w = settled_on(fits, label, here, noise_, limits_);
    for (std::size_t n = 0; n < pixels.size(); ++n) settled_(pixels[n]) = w[n];
  }

  RimmedImages images_;
  float noise_;
  Limits limits_;
  cv::Mat1f settled_;
  std::vector<cv::Point> off_surface_;  ///< of level planes
  CopiedWindows copied_;
};

/// w of planes fitted about labelled pixels. Those that have none lose their label.
cv::Mat1f fit_planes(const cv::Mat1f& inverse, float noise, const Limits& limits,
                     cv::Mat1w& labels) {
  cv::Mat1f settled = PlaneFitter(inverse, labels, noise, limits).fit();
  labels.setTo(0, settled == 0.0F);
  return settled;
}

}  // namespace

cv::Mat1f settle_on_surfaces(const DepthEdges& edges, cv::Mat1w& labels) {
  const cv::Mat1f first = fit_planes(edges.inverse_depth, edges.noise, kFirst, labels);
  return fit_planes(first, edges.noise, kSecond, labels);
}

}  // namespace mapscore
