// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/near_holes.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore {
namespace {

constexpr int kWideHole_px = 9;
constexpr double kNearRange = 1.3;  // in least ranges, of a surface that runs on into a near object

struct Hole {
  bool above = false, below = false, beside_near = false;  ///< reaches a border, or something near

  [[nodiscard]] std::uint8_t kind() const {
    if (beside_near) return kNearHole;
    if (!below) return 0;
    return above ? kOpenHole : kNearHole;
  }
};

cv::Mat1b square_px(int edge_px) {
  return cv::Mat1b(edge_px, edge_px, std::uint8_t{1});
}

}  // namespace

cv::Mat1b near_holes(const cv::Mat1f& inverse_depth, double range_min_m) {
  const cv::Mat1b hole = inverse_depth == 0.0F;
  cv::Mat1b wide;
  cv::erode(hole, wide, square_px(kWideHole_px), {-1, -1}, 1, cv::BORDER_REPLICATE);
  if (cv::countNonZero(wide) == 0) return wide;
  cv::Mat1i components;
  const int count = cv::connectedComponents(hole, components);
  cv::Mat1b beside_near;
  cv::dilate(inverse_depth > 1.0 / (kNearRange * range_min_m), beside_near, square_px(3));
  std::vector<Hole> holes(static_cast<std::size_t>(count));
  const auto hole_at = [&](int v, int u) -> Hole& {
    return holes[static_cast<std::size_t>(components(v, u))];
  };
  for (int u = 0; u < hole.cols; ++u) {
    hole_at(0, u).above = true;
    hole_at(hole.rows - 1, u).below = true;
  }
  std::vector<cv::Point> rims;
  cv::findNonZero(beside_near & hole, rims);
  for (const cv::Point& rim : rims) hole_at(rim.y, rim.x).beside_near = true;
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
