// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/surface_creases.hpp"

#include "core/wide_vectors.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace mapscore {
namespace {

constexpr int kSlope_px = 4, kLeastSlope_px = 2;
constexpr int kPeak_px = 2;            // the turn is the largest so far to either side
constexpr float kLeastTurn = 0.0003F;  // 1/m a pixel
constexpr float kTurnSigmas = 5.0F;
constexpr float kGrain_m = 0.00029F;  // standard deviation of a depth in steps of 1 mm
constexpr int kMargin = kSlope_px + kPeak_px + 1;

/// Of a run of pixels, and of the same run some pixels before and after along the lines that are
/// looked at, `stride` apart in memory.
struct Runs {
  const float* w;
  const float* on;  ///< continuity to the next along the line
  std::ptrdiff_t stride;
};

/// How much the slope of w rises from each pixel to the next along its line; 0 where that is not
/// sure, or not known.
MAPSCORE_WIDE_VECTORS
void turns_along(const Runs& runs, float noise, int count, float* turns) {
  const std::ptrdiff_t s = runs.stride;
  for (int n = 0; n < count; ++n) {
    const float* w = runs.w + n;
    const float* on = runs.on + n;
    const int whole = on[0] >= 1.0F;
    const int p1 = on[-s] >= 1.0F, p2 = p1 & (on[-2 * s] >= 1.0F), p3 = p2 & (on[-3 * s] >= 1.0F),
              p4 = p3 & (on[-4 * s] >= 1.0F);
    const int q1 = on[s] >= 1.0F, q2 = q1 & (on[2 * s] >= 1.0F), q3 = q2 & (on[3 * s] >= 1.0F),
              q4 = q3 & (on[4 * s] >= 1.0F);
    const float start = p4 ? w[-4 * s] : p3 ? w[-3 * s] : w[-2 * s];
    const float end = q4 ? w[5 * s] : q3 ? w[4 * s] : w[3 * s];
    const float before = p4 ? 1.0F / 4 : p3 ? 1.0F / 3 : 1.0F / 2;  // 1 over the slopes' lengths
    const float after = q4 ? 1.0F / 4 : q3 ? 1.0F / 3 : 1.0F / 2;
    const float turn = (end - w[s]) * after - (w[0] - start) * before;
    const float grain = kGrain_m * w[0] * w[0];
    const float sigma = grain > noise ? grain : noise;
    const float sure = kTurnSigmas * sigma * std::sqrt(2 * (before * before + after * after));
    const float least = sure > kLeastTurn ? sure : kLeastTurn;
    const int is_turn = whole & p2 & q2 & (turn > least);
    turns[n] = is_turn ? turn : 0.0F;
  }
}

/// Takes the continuity from where turns are the largest along their line.
MAPSCORE_WIDE_VECTORS
void cut_at_peaks(const float* turns, std::ptrdiff_t s, int count, float* on) {
  for (int n = 0; n < count; ++n) {
    const float* t = turns + n;
    const int is_peak =
        (t[0] > 0) & (t[0] > t[-s]) & (t[0] > t[-2 * s]) & (t[0] >= t[s]) & (t[0] >= t[2 * s]);
    on[n] = is_peak ? 0.0F : on[n];
  }
}

cv::Mat1f with_margin(const cv::Mat1f& image) {
  cv::Mat1f padded;
  cv::copyMakeBorder(image, padded, kMargin, kMargin, kMargin, kMargin, cv::BORDER_CONSTANT,
                     cv::Scalar(0));
  return padded;
}

/// Parts the continuity along lines whose pixels lie `stride` apart in `w`, an image with a margin.
cv::Mat1f parted(const cv::Mat1f& w, const cv::Mat1f& continuity, std::ptrdiff_t stride,
                 float noise) {
  const cv::Mat1f on = with_margin(continuity);
  cv::Mat1f turns(w.size(), 0.0F);
  cv::Mat1f out = continuity.clone();
  for (int v = 0; v < out.rows; ++v)
    turns_along({w[v + kMargin] + kMargin, on[v + kMargin] + kMargin, stride}, noise, out.cols,
                turns[v + kMargin] + kMargin);
  for (int v = 0; v < out.rows; ++v)
    cut_at_peaks(turns[v + kMargin] + kMargin, stride, out.cols, out[v]);
  return out;
}

}  // namespace

Continuity part_at_creases(const DepthEdges& edges) {
  const cv::Mat1f w = with_margin(edges.inverse_depth);
  return {parted(w, edges.right, 1, edges.noise),
          parted(w, edges.down, static_cast<std::ptrdiff_t>(w.step1()), edges.noise)};
}

}  // namespace mapscore
