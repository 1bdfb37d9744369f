// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/surface_average.hpp"

#include "core/wide_vectors.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace mapscore {
namespace {

constexpr int kRounds = 3;

/// Adds to each pixel what reaches it from the one before: `open`, in `gate`, of it.
MAPSCORE_WIDE_VECTORS
void add_from(const float* before, const float* open, float feedback, float* row, int columns) {
  for (int u = 0; u < columns; ++u) row[u] += feedback * open[u] * before[u];
}

/// The same against that direction. What came along it is in the row already; the pixel itself must
/// not count twice.
MAPSCORE_WIDE_VECTORS
void add_back(const float* after, const float* open, float feedback, float* row, int columns) {
  for (int u = 0; u < columns; ++u) {
    const float a = feedback * open[u];
    row[u] = row[u] + a * (after[u] - a * row[u]);
  }
}

/// Recursive average along some rows at once: each waits for its pixel before, not for the others.
template <int kRows>
void smooth_rows(cv::Mat1f& votes, const cv::Mat1f& right, int v, float feedback) {
  std::array<float*, kRows> row;
  std::array<const float*, kRows> open;
  for (int n = 0; n < kRows; ++n) {
    const auto at = static_cast<std::size_t>(n);
    row[at] = votes[v + n], open[at] = right[v + n];
  }
  for (int u = 1; u < votes.cols; ++u)
    for (std::size_t n = 0; n < kRows; ++n) row[n][u] += feedback * open[n][u - 1] * row[n][u - 1];
  for (int u = votes.cols - 2; u >= 0; --u)
    for (std::size_t n = 0; n < kRows; ++n) {
      const float a = feedback * open[n][u];
      row[n][u] = row[n][u] + a * (row[n][u + 1] - a * row[n][u]);
    }
}

}  // namespace

void average_on_surfaces(cv::Mat1f& votes, const cv::Mat1f& right, const cv::Mat1f& down,
                         float reach_px) {
  constexpr int kAtOnce = 8;
  for (int round = 0; round < kRounds; ++round) {
    const float feedback = std::exp(-1.0F / (reach_px * std::pow(0.5F, static_cast<float>(round))));
    int v = 0;
    for (; v + kAtOnce <= votes.rows; v += kAtOnce) smooth_rows<kAtOnce>(votes, right, v, feedback);
    for (; v < votes.rows; ++v) smooth_rows<1>(votes, right, v, feedback);
    for (v = 1; v < votes.rows; ++v)
      add_from(votes[v - 1], down[v - 1], feedback, votes[v], votes.cols);
    for (v = votes.rows - 2; v >= 0; --v)
      add_back(votes[v + 1], down[v], feedback, votes[v], votes.cols);
  }
}

}  // namespace mapscore
