// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/near_holes.hpp"

#include "core/wide_vectors.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore {
namespace {

constexpr int kWideHole = 5;        // cells
constexpr double kNearRange = 1.3;  // in least ranges, of a surface that runs on into a near object

struct Hole {
  bool above = false, below = false, beside_near = false;  ///< reaches a border, or something near

  [[nodiscard]] std::uint8_t kind() const {
    if (beside_near) return kNearHole;
    if (!below) return 0;
    return above ? kOpenHole : kNearHole;
  }
};

cv::Mat1b square(int edge) {
  return cv::Mat1b(edge, edge, std::uint8_t{1});
}

/// Two rows of inverse depths, 1/m.
struct RowPair {
  const float *upper, *lower;

  [[nodiscard]] float most(int u) const { return upper[u] > lower[u] ? upper[u] : lower[u]; }
};

/// By cell, 255 where no pixel has a depth, and where one lies nearer than `near`, 1/m.
struct CellRow {
  std::uint8_t *hole, *near;

  void set(int cell, float most, float nearer_than) const {
    hole[cell] = most > 0 ? std::uint8_t{0} : std::uint8_t{255};
    near[cell] = most > nearer_than ? std::uint8_t{255} : std::uint8_t{0};
  }
};

MAPSCORE_WIDE_VECTORS
void look_into(RowPair rows, float near, int columns, CellRow to) {
  MAPSCORE_NO_OVERLAPS
  for (int cell = 0; cell < columns / kHoleCell_px; ++cell) {
    const float left = rows.most(kHoleCell_px * cell), right = rows.most(kHoleCell_px * cell + 1);
    to.set(cell, left > right ? left : right, near);
  }
  if (columns % kHoleCell_px != 0) to.set(columns / kHoleCell_px, rows.most(columns - 1), near);
}

}  // namespace

cv::Mat1b near_holes(const cv::Mat1f& inverse_depth, double range_min_m) {
  cv::Mat1b hole((inverse_depth.rows + 1) / kHoleCell_px, (inverse_depth.cols + 1) / kHoleCell_px);
  cv::Mat1b near(hole.size()), wide;
  const auto nearer_than = static_cast<float>(1.0 / (kNearRange * range_min_m));
  for (int row = 0; row < hole.rows; ++row) {
    const int v = kHoleCell_px * row;
    look_into({inverse_depth[v], inverse_depth[std::min(v + 1, inverse_depth.rows - 1)]},
              nearer_than, inverse_depth.cols, {hole[row], near[row]});
  }
  cv::erode(hole, wide, square(kWideHole), {-1, -1}, 1, cv::BORDER_REPLICATE);
  if (cv::countNonZero(wide) == 0) return wide;
  if (cv::countNonZero(near) == 0 && cv::countNonZero(hole.row(hole.rows - 1)) == 0)
    return cv::Mat1b(hole.size(), std::uint8_t{0});  // nothing is near that could hold one
  cv::Mat1i components;
  const int count = cv::connectedComponents(hole, components);
  cv::Mat1b beside_near;
  cv::dilate(near, beside_near, square(3));
  std::vector<Hole> holes(static_cast<std::size_t>(count));
  const auto hole_at = [&](int v, int u) -> Hole& {
    return holes[static_cast<std::size_t>(components(v, u))];
  };
  for (int u = 0; u < hole.cols; ++u) {
    hole_at(0, u).above = true;
    hole_at(hole.rows - 1, u).below = true;
  }
  const cv::Mat1b rims = beside_near & hole & 1;
  for (int v = 0; v < hole.rows; ++v)
    for_each_marked(rims[v], rims.cols, [&](int u) { hole_at(v, u).beside_near = true; });
  std::vector<std::uint8_t> kinds(holes.size());
  std::ranges::transform(holes, kinds.begin(), &Hole::kind);
  for (int v = 0; v < hole.rows; ++v) {
    const int* const component = components[v];
    std::uint8_t* const kind = wide[v];
    for (int u = 0; u < hole.cols; ++u)
      if (kind[u] != 0) kind[u] = kinds[static_cast<std::size_t>(component[u])];
  }
  return wide;
}

}  // namespace mapscore
