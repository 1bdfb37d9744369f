// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/erosion.hpp"

#include "core/error.hpp"
#include "core/segmentation/direct.hpp"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace mapscore {
namespace {

/// 255 where the mask is set, with one more column on either side: 255 where the image ends there,
/// so that the mask goes on beyond it, else 0.
cv::Mat1b with_margins(const cv::Mat1b& mask, bool open_left, bool open_right) {
  cv::Mat1b inner(mask.rows, mask.cols + 2);
  for (int v = 0; v < mask.rows; ++v) {
    const std::uint8_t* in = mask[v];
    std::uint8_t* out = inner[v];
    out[0] = open_left ? 255 : 0;
    out[mask.cols + 1] = open_right ? 255 : 0;
    for (int u = 0; u < mask.cols; ++u) out[u + 1] = in[u] != 0 ? 255 : 0;
  }
  return inner;
}

/// Shrinks every run of a row by one pixel at either end; the margins stay, since what lies beyond
/// an edge asks no more than the pixel at the edge does.
void shrink_rows(const cv::Mat1b& from, cv::Mat1b& to) {
  for (int v = 0; v < from.rows; ++v) {
    const std::uint8_t* in = from[v];
    std::uint8_t* out = to[v];
    const int last = from.cols - 1;
    for (int u = 1; u < last; ++u)
      out[u] = static_cast<std::uint8_t>(in[u - 1] & in[u] & in[u + 1]);
  }
}

void keep_common(const std::uint8_t* row, std::uint8_t* kept, int count) {
  for (int u = 0; u < count; ++u) kept[u] = static_cast<std::uint8_t>(kept[u] & row[u]);
}

/// The radius, or the image's diagonal where it is longer: no pixel lies farther from another.
int within_diagonal(int radius_px, int width_px, int height_px) {
  const double diagonal = std::ceil(std::hypot(width_px, height_px));
  return diagonal < radius_px ? static_cast<int>(diagonal) : radius_px;
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
  if (radius_px < 0) throw Error("radius_px: must not be negative; 0 leaves the masks as they are");
  radius_px = within_diagonal(radius_px, image_width_px, image_height_px);
  const PixelBox& box = detection.box;
  const std::vector<int> disc = disc_half_widths(radius_px);
  cv::Mat1b inner = with_margins(detection.mask, box.u_min == 0, box.u_max == image_width_px - 1);
  cv::Mat1b shrunk = inner.clone(), eroded = detection.mask.clone();
  const auto ask = [&](int v, int dy) {  // whether the disc's row at v + dy lies in the mask
    const int row = v + dy;
    if (row + box.v_min < 0 || row + box.v_min >= image_height_px) return;
    if (row < 0 || row >= inner.rows)
      eroded.row(v) = 0;
    else
      keep_common(inner[row] + 1, eroded[v], eroded.cols);
  };
  int width = 0;  // of which `inner` holds the pixels with as many neighbours on either side
  for (int dy = radius_px; dy >= 0; --dy) {
    for (; width < disc[static_cast<std::size_t>(dy)]; ++width) {
      shrink_rows(inner, shrunk);
      std::swap(inner, shrunk);
    }
    for (int v = 0; v < eroded.rows; ++v) {
      ask(v, dy);
      if (dy > 0) ask(v, -dy);
    }
  }
  return eroded;
}

Segment Erosion::segment(const Detection& detection, const RegisteredCloud& cloud, double voxel_m,
                         bool with_voxels) const {
  const cv::Mat1b eroded = erode_mask(detection, radius_px, cloud.width_px(), cloud.height_px());
  if (cv::countNonZero(eroded) == 0) return Segment::nothing(SkipReason::eroded_away);
  return segment_of(eroded, detection.box, cloud, voxel_m, with_voxels);
}

}  // namespace mapscore
