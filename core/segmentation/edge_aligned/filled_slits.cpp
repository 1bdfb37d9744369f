// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/filled_slits.hpp"

#include <cstdint>

namespace mapscore {
namespace {

constexpr float kStep = 0.5F;  // continuity below which two pixels lie on different surfaces

/// The pixels of one row or column, by their number in it.
struct Line {
  const DepthEdges& edges;
  const cv::Mat1w& owner;
  int number;
  bool is_row;

  [[nodiscard]] int length() const { return is_row ? owner.cols : owner.rows; }
  template <typename Image>
  [[nodiscard]] auto& of(Image& image, int n) const {
    return is_row ? image(number, n) : image(n, number);
  }
  [[nodiscard]] bool steps_after(int n) const {
    return of(is_row ? edges.right : edges.down, n) < kStep;
  }
};

void mark(const Line& line, int widest_px, cv::Mat1b& slits) {
  int start = -1;  // of a run behind the pixel before it
  for (int n = 1; n < line.length(); ++n) {
    const float before = line.of(line.edges.inverse_depth, n - 1);
    const float here = line.of(line.edges.inverse_depth, n);
    if (!(here > 0) || !(before > 0)) {
      start = -1;
    } else if (line.steps_after(n - 1)) {
      if (here < before) {
        start = n;
        continue;
      }
      const std::uint16_t own = line.of(line.owner, n);
      if (start > 0 && n - start <= widest_px && own != 0 && line.of(line.owner, start - 1) == own)
        for (int inside = start; inside < n; ++inside)
          if (line.of(line.owner, inside) == own) line.of(slits, inside) = 255;
      start = -1;
    }
  }
}

}  // namespace

cv::Mat1b filled_slits(const DepthEdges& edges, const cv::Mat1w& owner, int widest_px) {
  cv::Mat1b slits(owner.rows, owner.cols, std::uint8_t{0});
  for (int v = 0; v < owner.rows; ++v) mark({edges, owner, v, true}, widest_px, slits);
  for (int u = 0; u < owner.cols; ++u) mark({edges, owner, u, false}, widest_px, slits);
  return slits;
}

}  // namespace mapscore
