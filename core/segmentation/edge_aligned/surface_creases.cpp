// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/surface_creases.hpp"

#include "core/wide_vectors.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore {
namespace {

constexpr std::size_t kSlope_px = 4;
constexpr int kPeak_px = 2;            // the turn is the largest so far to either side
constexpr float kLeastTurn = 0.0003F;  // 1/m a pixel
constexpr float kTurnSigmas = 5.0F;
constexpr float kGrain_m = 0.00029F;  // standard deviation of a depth in steps of 1 mm
constexpr std::size_t kBefore = kSlope_px, kAfter = kSlope_px + 1;  // pixels about one, of a line

/// By value: std::min and std::max choose between places, which do not become vectors.
inline float least(float a, float b) {
  return a < b ? a : b;
}
inline float most(float a, float b) {
  return a > b ? a : b;
}

/// Of the second, third and fourth pixel from one, what belongs to the farthest that its surface
/// reaches: the fourth where `fourth`, the continuity up to it, is 1, else the third where `third`
/// is. By value too: what is read in one branch only does not become vectors.
inline float farthest(float third, float fourth, float at_2, float at_3, float at_4) {
  const float near = third < 1.0F ? at_2 : at_3;
  return fourth < 1.0F ? near : at_4;
}

/// Some pixels beside each other, and those before and after them along the lines that are looked
/// at: [kBefore] is their own. `on`: continuity to the next along the line.
struct Lines {
  std::array<const float*, kBefore + 1 + kAfter> w, on;
};

/// How much the slope of w rises from each pixel to the next along its line; 0 where that is not
/// sure, or not known.
MAPSCORE_WIDE_VECTORS
void find_turns(const Lines& lines, float noise, int count, float* __restrict turns) {
  const auto& [w, on] = lines;
  const float *w0 = w[0], *w1 = w[1], *w2 = w[2], *w4 = w[4], *w5 = w[5], *w7 = w[7], *w8 = w[8],
              *w9 = w[9];
  const float *on0 = on[0], *on1 = on[1], *on2 = on[2], *on3 = on[3], *on4 = on[4], *on5 = on[5],
              *on6 = on[6], *on7 = on[7], *on8 = on[8];
  for (int n = 0; n < count; ++n) {
    const float p = w4[n], q = w5[n];
    // How many pixels of a surface lie before p, after q: less than 2, 2, 3, or 4 and more.
    const float before2 = least(on3[n], on2[n]), before3 = least(before2, on1[n]),
                before4 = least(before3, on0[n]);
    const float after2 = least(on5[n], on6[n]), after3 = least(after2, on7[n]),
                after4 = least(after3, on8[n]);
    const float before = farthest(before3, before4, w2[n], w1[n], w0[n]);
    const float after = farthest(after3, after4, w7[n], w8[n], w9[n]);
    const float over_before = farthest(before3, before4, 1.0F / 2, 1.0F / 3, 1.0F / 4);
    const float over_after = farthest(after3, after4, 1.0F / 2, 1.0F / 3, 1.0F / 4);
    const float turn = (after - q) * over_after - (p - before) * over_before;
    const float sigma = most(kGrain_m * p * p, noise);
    const float sure = kTurnSigmas * sigma * (over_before + over_after);
    const float told = turn > most(sure, kLeastTurn) ? turn : 0.0F;
    turns[n] = least(least(before2, after2), on4[n]) < 1.0F ? 0.0F : told;
  }
}

/// Takes the continuity from where turns are the largest of five along their line; [2] is its own.
MAPSCORE_WIDE_VECTORS
void cut_at_peaks(const std::array<const float*, 2 * kPeak_px + 1>& turns, const float* on,
                  int count, float* __restrict parted) {
  const float *t0 = turns[0], *t1 = turns[1], *t2 = turns[2], *t3 = turns[3], *t4 = turns[4];
  for (int n = 0; n < count; ++n) {
    const int is_peak = static_cast<int>(t2[n] > most(most(t0[n], t1[n]), 0.0F)) &
                        static_cast<int>(t2[n] >= most(t3[n], t4[n]));
    parted[n] = is_peak != 0 ? 0.0F : on[n];
  }
}

/// Marks where a surface went on and does not any more.
MAPSCORE_WIDE_VECTORS
void find_cuts(const float* before, const float* on, int count, std::uint8_t* __restrict marks) {
  for (int n = 0; n < count; ++n)
    marks[n] = static_cast<std::uint8_t>((before[n] > 0) & (on[n] == 0.0F));
}

cv::Mat1f parted_in_rows(const DepthEdges& edges) {
  const cv::Mat1f& w = edges.inverse_depth;
  cv::Mat1f out(w.size());
  const auto columns = static_cast<std::size_t>(w.cols);
  std::vector<float> line(kBefore + columns + kAfter, 0.0F), on = line,
                                                             turns(columns + 2 * kPeak_px, 0.0F);
  Lines lines;
  for (std::size_t n = 0; n < lines.w.size(); ++n)
    lines.w[n] = line.data() + n, lines.on[n] = on.data() + n;
  std::array<const float*, 2 * kPeak_px + 1> near;
  for (std::size_t n = 0; n < near.size(); ++n) near[n] = turns.data() + n;
  for (int v = 0; v < w.rows; ++v) {
    std::copy(w[v], w[v] + w.cols, line.begin() + kBefore);
    std::copy(edges.right[v], edges.right[v] + w.cols, on.begin() + kBefore);
    find_turns(lines, edges.noise, w.cols, turns.data() + kPeak_px);
    cut_at_peaks(near, edges.right[v], w.cols, out[v]);
  }
  return out;
}

cv::Mat1f parted_in_columns(const DepthEdges& edges) {
  const cv::Mat1f& w = edges.inverse_depth;
  cv::Mat1f out(w.size());
  constexpr int kKept = 2 * kPeak_px + 1;
  cv::Mat1f turns(kKept, w.cols, 0.0F);  // of the last rows, each in row v % kKept
  const std::vector<float> nothing(static_cast<std::size_t>(w.cols), 0.0F);
  const auto row = [&](const cv::Mat1f& image, int v) {
    return v < 0 || v >= image.rows ? nothing.data() : image[v];
  };
  for (int v = 0; v < w.rows + kPeak_px; ++v) {
    float* const own = turns[v % kKept];
    if (v < w.rows) {
      Lines lines;
      for (int n = 0; n < static_cast<int>(lines.w.size()); ++n) {
        const int at = v + n - static_cast<int>(kBefore);
        lines.w[static_cast<std::size_t>(n)] = row(w, at);
        lines.on[static_cast<std::size_t>(n)] = row(edges.down, at);
      }
      find_turns(lines, edges.noise, w.cols, own);
    } else {
      std::fill(own, own + w.cols, 0.0F);
    }
    const int peak = v - kPeak_px;
    if (peak < 0) continue;
    std::array<const float*, kKept> near;
    for (int n = 0; n < kKept; ++n)
      near[static_cast<std::size_t>(n)] = turns[(peak + n - kPeak_px + kKept) % kKept];
    cut_at_peaks(near, edges.down[peak], w.cols, out[peak]);
  }
  return out;
}

}  // namespace

Continuity part_at_creases(const DepthEdges& edges) {
  return {parted_in_rows(edges), parted_in_columns(edges)};
}

std::vector<DepthEdge> contacts_of(const DepthEdges& edges, const Continuity& parted,
                                   const CameraModel& camera) {
  const cv::Mat1f& w = edges.inverse_depth;
  std::vector<DepthEdge> contacts;
  Marks cut(static_cast<std::size_t>(w.cols));
  for (int v = 0; v + 1 < w.rows; ++v) {
    find_cuts(edges.down[v], parted.down[v], w.cols, cut.data());
    for_each_marked(cut, [&](int u) {
      const double z_m = 2.0 / static_cast<double>(w(v, u) + w(v + 1, u));
      const Eigen::Vector3d point = camera.back_project(u, v + 0.5, z_m);
      contacts.push_back({point.cast<float>(), Outward::down, 1.0F});
    });
  }
  return contacts;
}

}  // namespace mapscore
