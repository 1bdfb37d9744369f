// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/settled_depth.hpp"

#include "core/segmentation/edge_aligned/window_planes.hpp"
#include "core/wide_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace mapscore {
namespace {

constexpr float kSigmas = 4.0F, kLeastSigmas = 1.5F;
constexpr float kLeast = 4;
constexpr float kLeastShare = 0.5F;
constexpr std::size_t kSettledAtOnce = WindowPlanes::kFitted;
using Fitted = WindowPlanes::Row;

/// Of one fit, in metres of depth: the band in which pixels lie on one surface, at least
/// kLeastSigmas and at most kSigmas wide, and how uncertain a depth may be.
struct Limits {
  float band_m, error_m;
};
constexpr Limits kFirst{1e6F, 1e6F}, kSecond{0.02F, 0.009F};

/// Whether enough of the label's pixels lie near the plane of pixel n.
inline bool is_on_surface(const WindowPlanes& fits, std::size_t n) {
  return (fits.near[n] >= kLeast) & (fits.near[n] >= kLeastShare * fits.labelled[n]);
}

/// Whether some labelled pixels are on no surface.
MAPSCORE_WIDE_VECTORS
bool any_off_surface(const WindowPlanes& fits, const float* label) {
  int any = 0;
  for (std::size_t n = 0; n < kSettledAtOnce; ++n)
    any |= (label[n] != 0.0F) & !is_on_surface(fits, n) ? 1 : 0;
  return any != 0;
}

/// w of the planes, 0 where there is none or the depth is too uncertain.
MAPSCORE_WIDE_VECTORS
Fitted settled_on(const WindowPlanes& fits, const float* label, const float* here, float noise,
                  const Limits& limits) {
  Fitted settled;
  const float most_error_m = limits.error_m;
  for (std::size_t n = 0; n < kSettledAtOnce; ++n) {
    const float w = here[n] + fits.rise[n], error = noise * std::sqrt(fits.variance[n]);
    const bool is_sure = is_on_surface(fits, n) & (error <= most_error_m * w * w);
    settled[n] = (label[n] != 0.0F) & is_sure ? w : 0.0F;
  }
  return settled;
}

/// How far in w from each pixel others of its surface may lie.
MAPSCORE_WIDE_VECTORS
Fitted bands_about(const float* here, float noise, float band_m) {
  Fitted within;
  const float narrowest = kLeastSigmas * noise, widest = kSigmas * noise;
  for (std::size_t n = 0; n < kSettledAtOnce; ++n) {
    const float w = here[n], band = band_m * w * w;
    const float limited = band < narrowest ? narrowest : band;
    within[n] = limited > widest ? widest : limited;
  }
  return within;
}

/// Fits planes about pixels: level ones to pixels beside each other, then sloped ones to those that
/// are on no level surface, wherever they are.
class PlaneFitter {
 public:
  PlaneFitter(const cv::Mat1f& inverse, const cv::Mat1w& labels, float noise, const Limits& limits)
      : images_(inverse, labels), noise_(noise), limits_(limits), settled_(labels.size(), 0.0F) {}

  /// w of the planes, 0 where a pixel has no label, is on no surface, or its depth is too
  /// uncertain.
  cv::Mat1f fit() {
    for (int v = 0; v < settled_.rows; ++v)
      for (int u = 0; u < settled_.cols; u += kSettledAtOnce) fit_level(u, v);
    for (std::size_t n = 0; n < off_surface_.size(); n += kSettledAtOnce)
      fit_sloped(
          std::span(off_surface_).subspan(n, std::min(kSettledAtOnce, off_surface_.size() - n)));
    return settled_;
  }

 private:
  void fit_level(int u, int v) {
    const WindowsInRow windows(images_, u, v);
    const float *const label = windows.label(0, 0), *const here = windows.w(0, 0);
    const int count = std::min(static_cast<int>(kSettledAtOnce), settled_.cols - u);
    if (std::all_of(label, label + count, [](float own) { return own == 0.0F; })) return;
    const Fitted within = bands_about(here, noise_, limits_.band_m);
    const WindowPlanes fits = fit_level_planes(windows, within);
    const Fitted w = settled_on(fits, label, here, noise_, limits_);
    std::copy_n(w.data(), count, settled_[v] + u);
    if (!any_off_surface(fits, label)) return;
    for (int n = 0; n < count; ++n)
      if (label[n] != 0.0F && !is_on_surface(fits, static_cast<std::size_t>(n)))
        off_surface_.emplace_back(u + n, v);
  }

  void fit_sloped(std::span<const cv::Point> pixels) {
    for (std::size_t n = 0; n < kSettledAtOnce; ++n) {
      const cv::Point& pixel = pixels[std::min(n, pixels.size() - 1)];  // again, if there are fewer
      copied_.set(n, images_, pixel.x, pixel.y);
    }
    const float *const label = copied_.label(0, 0), *const here = copied_.w(0, 0);
    const Fitted within = bands_about(here, noise_, limits_.band_m);
    const WindowPlanes fits = fit_sloped_planes(copied_, within);
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
