// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/random_discs.hpp"

#include "core/random_stream.hpp"

#include <cmath>
#include <vector>

namespace mapscore::sim {
namespace {

/// Makes rows and columns left of and above the image whole numbers from 0.
constexpr int kOrigin = 1 << 20;

std::vector<cv::Point> disc_of(double radius_px) {
  const int reach = static_cast<int>(radius_px);
  std::vector<cv::Point> disc;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (dx * dx + dy * dy <= radius_px * radius_px) disc.emplace_back(dx, dy);
  return disc;
}

}  // namespace

cv::Mat1b random_discs(const cv::Rect& window, double share, double radius_px,
                       const DiscStream& stream) {
  cv::Mat1b covered(window.size(), std::uint8_t{0});
  if (share <= 0.0) return covered;
  const std::vector<cv::Point> disc = disc_of(radius_px);
  const double chance =
      share >= 1.0 ? 1.0 : 1.0 - std::pow(1.0 - share, 1.0 / static_cast<double>(disc.size()));
  const cv::Rect inside({0, 0}, window.size());
  const int reach = static_cast<int>(radius_px);
  for (int v = -reach; v < window.height + reach; ++v) {
    RandomStream row(
        stream.seed, stream.purpose,
        {stream.frame, stream.instance, static_cast<std::uint64_t>(kOrigin + window.y + v)});
    row.skip(static_cast<std::uint64_t>(kOrigin + window.x - reach));
    for (int u = -reach; u < window.width + reach; ++u) {
      if (row.uniform() >= chance) continue;
      for (const cv::Point& offset : disc) {
        const cv::Point pixel = cv::Point(u, v) + offset;
        if (inside.contains(pixel)) covered(pixel) = 255;
      }
    }
  }
  return covered;
}

}  // namespace mapscore::sim
