// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/surface_average.hpp"

#include "core/wide_vectors.hpp"

#include <opencv2/core/hal/intrin.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <vector>

namespace mapscore {
namespace {

/// Adds to each pixel what reaches it from the one before, through links that are `open`, 0 to 1.
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

/// Copies an image of `rows` x `columns` values, row-major, whose rows begin so many steps apart,
/// with rows and columns exchanged, in tiles that stay in the first cache.
void transpose(const float* from, std::size_t from_step, int rows, int columns, float* to,
               std::size_t to_step) {
  const auto source = [=](int r, int c) {
    return from + static_cast<std::size_t>(r) * from_step + c;
  };
  const auto target = [=](int r, int c) { return to + static_cast<std::size_t>(c) * to_step + r; };
  constexpr int kTile = 32, kBlock = 4;
  const auto copy_block = [&](int r, int c) {
    std::array<cv::v_float32x4, kBlock> in, out;
    for (int n = 0; n < kBlock; ++n) in[static_cast<std::size_t>(n)] = cv::v_load(source(r + n, c));
    cv::v_transpose4x4(in[0], in[1], in[2], in[3], out[0], out[1], out[2], out[3]);
    for (int n = 0; n < kBlock; ++n)
      cv::v_store(target(r, c + n), out[static_cast<std::size_t>(n)]);
  };
  const auto copy_rest = [&](int r, int c) {
    for (int i = r; i < std::min(r + kBlock, rows); ++i)
      for (int j = c; j < std::min(c + kBlock, columns); ++j) *target(i, j) = *source(i, j);
  };
  for (int top = 0; top < rows; top += kTile)
    for (int left = 0; left < columns; left += kTile)
      for (int r = top; r < std::min(top + kTile, rows); r += kBlock)
        for (int c = left; c < std::min(left + kTile, columns); c += kBlock)
          if (r + kBlock <= rows && c + kBlock <= columns)
            copy_block(r, c);
          else
            copy_rest(r, c);
}

/// A part of an image, its rows side by side, a column behind the other: what goes along each row
/// becomes one wide loop over all of them.
class RowsTogether {
 public:
  explicit RowsTogether(int most_columns)
      : values_(static_cast<std::size_t>(most_columns * kBand_px), 0.0F) {}

  void read(const cv::Mat1f& image, const cv::Rect& part) {
    transpose(image[part.y] + part.x, image.step1(), part.height, part.width, values_.data(),
              kBand_px);
  }

  void write(cv::Mat1f& image, const cv::Rect& part) {
    transpose(values_.data(), kBand_px, part.width, part.height, image[part.y] + part.x,
              image.step1());
  }

  float* data() { return values_.data(); }

 private:
  std::vector<float> values_;
};

/// Adds along rows, there and back, as add_from and add_back do from row to row. `open`, `votes`:
/// columns of kBand_px values; those below a lower part are left from another, and never used.
MAPSCORE_WIDE_VECTORS
void smooth_along(const float* open, float feedback, int columns, float* votes) {
  for (int u = 1; u < columns; ++u) {
    const float *before = votes + (u - 1) * kBand_px, *from = open + (u - 1) * kBand_px;
    float* const here = votes + u * kBand_px;
    MAPSCORE_NO_OVERLAPS
    for (int r = 0; r < kBand_px; ++r) here[r] += feedback * from[r] * before[r];
  }
  for (int u = columns - 2; u >= 0; --u) {
    const float *after = votes + (u + 1) * kBand_px, *from = open + u * kBand_px;
    float* const here = votes + u * kBand_px;
    MAPSCORE_NO_OVERLAPS
    for (int r = 0; r < kBand_px; ++r) {
      const float a = feedback * from[r];
      here[r] = here[r] + a * (after[r] - a * here[r]);
    }
  }
}

/// Calls use(u, count) with the columns that two parts of neighbouring bands share, if any.
void across(const cv::Rect& a, const cv::Rect& b, auto&& use) {
  const int begin = std::max(a.x, b.x), end = std::min(a.br().x, b.br().x);
  if (begin < end) use(begin, end - begin);
}

}  // namespace

void average_on_surfaces(cv::Mat1f& votes, std::span<const cv::Rect> parts, const cv::Mat1f& right,
                         const cv::Mat1f& down, float reach_px) {
  const auto feedback_of = [&](float share) { return std::exp(-1.0F / (share * reach_px)); };
  int widest = 0;
  for (const cv::Rect& part : parts) widest = std::max(widest, part.width);
  RowsTogether together(widest), open(widest);
  const auto along_rows = [&](std::initializer_list<float> shares) {
    for (const cv::Rect& part : parts) {
      open.read(right, part);
      together.read(votes, part);
      for (const float share : shares)
        smooth_along(open.data(), feedback_of(share), part.width, together.data());
      together.write(votes, part);
    }
  };
  const auto along_columns = [&](float share) {
    const float feedback = feedback_of(share);
    const auto step_down = [&](int v, int u, int columns) {
      add_from(votes[v - 1] + u, down[v - 1] + u, feedback, votes[v] + u, columns);
    };
    const auto step_up = [&](int v, int u, int columns) {
      add_back(votes[v + 1] + u, down[v] + u, feedback, votes[v] + u, columns);
    };
    for (std::size_t n = 0; n < parts.size(); ++n) {
      const cv::Rect& part = parts[n];
      for (std::size_t m = n; m-- > 0 && parts[m].y >= part.y - kBand_px;)
        if (parts[m].y < part.y)
          across(parts[m], part, [&](int u, int columns) { step_down(part.y, u, columns); });
      for (int v = part.y + 1; v < part.br().y; ++v) step_down(v, part.x, part.width);
    }
    for (std::size_t n = parts.size(); n-- > 0;) {
      const cv::Rect& part = parts[n];
      const int last = part.br().y - 1;
      for (std::size_t m = n + 1; m < parts.size() && parts[m].y <= last + 1; ++m)
        if (parts[m].y > part.y)
          across(parts[m], part, [&](int u, int columns) { step_up(last, u, columns); });
      for (int v = last - 1; v >= part.y; --v) step_up(v, part.x, part.width);
    }
  };
  along_rows({1.0F});
  along_columns(1.0F);
  along_columns(0.5F);
  along_rows({0.5F, 0.25F});
  along_columns(0.25F);
}

}  // namespace mapscore
