// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/erosion.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore {
namespace {

constexpr int kEndless = 1 << 20;

/// For each pixel of the mask, how many further pixels in its row lie inside on the shorter side:
/// the largest w such that columns u - w .. u + w are inside; -1 outside the mask. Beyond the
/// image's edge the row goes on.
cv::Mat1i inner_half_widths(const cv::Mat1b& mask, bool open_left, bool open_right) {
  cv::Mat1i half_widths(mask.rows, mask.cols);
  for (int v = 0; v < mask.rows; ++v) {
    int run = open_left ? kEndless : 0;
    for (int u = 0; u < mask.cols; ++u) {
      run = mask(v, u) ? run + 1 : 0;
      half_widths(v, u) = run - 1;
    }
    run = open_right ? kEndless : 0;
    for (int u = mask.cols - 1; u >= 0; --u) {
      run = mask(v, u) ? run + 1 : 0;
      half_widths(v, u) = std::min(half_widths(v, u), run - 1);
    }
  }
  return half_widths;
}

/// Half widths of the disc's rows, from its middle outwards.
std::vector<int> disc_half_widths(int radius_px) {
  std::vector<int> half_widths;
  for (int dy = 0; dy <= radius_px; ++dy) {
    int width = static_cast<int>(std::sqrt(static_cast<double>(radius_px * radius_px - dy * dy)));
    while (width * width + dy * dy > radius_px * radius_px) --width;
    while ((width + 1) * (width + 1) + dy * dy <= radius_px * radius_px) ++width;
    half_widths.push_back(width);
  }
  return half_widths;
}

}  // namespace

cv::Mat1b erode_mask(const Detection& detection, int radius_px, int image_width_px,
                     int image_height_px) {
  const PixelBox& box = detection.box;
  const cv::Mat1i inner =
      inner_half_widths(detection.mask, box.u_min == 0, box.u_max == image_width_px - 1);
  const std::vector<int> disc = disc_half_widths(radius_px);
  cv::Mat1b eroded = detection.mask.clone();
  for (int v = 0; v < eroded.rows; ++v) {
    for (int dy = -radius_px; dy <= radius_px; ++dy) {
      const int needed = disc[static_cast<std::size_t>(std::abs(dy))];
      const int row = v + dy;
      const bool beyond_image = row + box.v_min < 0 || row + box.v_min >= image_height_px;
      if (beyond_image) continue;
      if (row < 0 || row >= inner.rows) {
        eroded.row(v) = 0;
        break;
      }
      const int* widths = inner[row];
      std::uint8_t* out = eroded[v];
      for (int u = 0; u < eroded.cols; ++u) out[u] = widths[u] >= needed ? out[u] : std::uint8_t{0};
    }
  }
  return eroded;
}

}  // namespace mapscore
