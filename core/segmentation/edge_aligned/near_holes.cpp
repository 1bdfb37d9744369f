// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/near_holes.hpp"

#include <opencv2/imgproc.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore {
namespace {

constexpr int kWideHole_px = 9;
constexpr double kNearRange = 1.3;  // in least ranges, of a surface that runs on into a near object

struct Hole {
  bool above = false, below = false, beside_near = false;  ///< reaches a border, or something near
};

std::uint8_t kind_of(const Hole& hole) {
  if (hole.beside_near) return kNearHole;
  if (!hole.below) return 0;
  return hole.above ? kOpenHole : kNearHole;
}

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
  for (int v = 0; v < hole.rows; ++v)
    for (int u = 0; u < hole.cols; ++u)
      if (beside_near(v, u) != 0) hole_at(v, u).beside_near = true;
  for (int v = 0; v < hole.rows; ++v)
    for (int u = 0; u < hole.cols; ++u)
      if (wide(v, u) != 0) wide(v, u) = kind_of(hole_at(v, u));
  return wide;
}

}  // namespace mapscore
