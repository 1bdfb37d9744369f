// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/outline_field.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdint>

namespace mapscore {
namespace {

constexpr int kCoarse = 4;         // pixels a cell of the coarse maps
constexpr double kOtherWay = 0.7;  // weight of outlines that face the other way: occluded ones

cv::Mat1w painted(const std::vector<Detection>& detections, int width_px, int height_px) {
  cv::Mat1w owner(height_px, width_px, std::uint16_t{0});
  for (std::size_t n = 0; n < detections.size(); ++n) {
    const PixelBox& box = detections[n].box;
    if (detections[n].mask.empty()) continue;
    owner(cv::Rect(box.u_min, box.v_min, box.width(), box.height()))
        .setTo(static_cast<double>(n + 1), detections[n].mask);
  }
  return owner;
}

cv::Rect window_of(const std::vector<Detection>& detections, const cv::Size& image, int reach_px) {
  cv::Rect window;
  for (const Detection& detection : detections) {
    const PixelBox& box = detection.box;
    const cv::Rect rect(box.u_min - reach_px, box.v_min - reach_px, box.width() + 2 * reach_px,
                        box.height() + 2 * reach_px);
    window = window.empty() ? rect : window | rect;
  }
  return window & cv::Rect({0, 0}, image);
}

/// Distances of the window's pixels to the outline.
void measure(const cv::Mat1w& owner, cv::Mat1f distance) {
  cv::Mat1b outside = owner == 0;
  cv::Mat1b deep(owner.rows, owner.cols, std::uint8_t{0});
  for (int v = 0; v < owner.rows; ++v) {
    const std::uint16_t* row = owner[v];
    const std::uint16_t* above = v > 0 ? owner[v - 1] : row;
    const std::uint16_t* below = v + 1 < owner.rows ? owner[v + 1] : row;
    std::uint8_t* inner = deep[v];
    for (int u = 0; u < owner.cols; ++u) {
      const std::uint16_t own = row[u];
      const std::uint16_t left = u > 0 ? row[u - 1] : own,
                          right = u + 1 < owner.cols ? row[u + 1] : own;
      inner[u] =
          own != 0 && left == own && right == own && above[u] == own && below[u] == own ? 255 : 0;
    }
  }
  cv::Mat1f within, beyond;
  cv::distanceTransform(deep, within, cv::DIST_L2, cv::DIST_MASK_3);
  cv::distanceTransform(outside, beyond, cv::DIST_L2, cv::DIST_MASK_3);
  for (int v = 0; v < owner.rows; ++v) {
    const std::uint16_t* own = owner[v];
    const float *in = within[v], *out = beyond[v];
    float* to = distance[v];
    for (int u = 0; u < owner.cols; ++u) to[u] = own[u] != 0 ? -0.5F - in[u] : out[u] - 0.5F;
  }
}

/// Outline elements by the way they face, counted in cells.
std::array<cv::Mat1f, 4> counted(const cv::Mat1w& masks, int& length_px) {
  std::array<cv::Mat1f, 4> cells;
  for (cv::Mat1f& map : cells)
    map = cv::Mat1f(masks.rows / kCoarse + 1, masks.cols / kCoarse + 1, 0.0F);
  const auto count = [&](Outward way, int v, int u) {
    ++length_px;
    cells[static_cast<std::size_t>(way)](v / kCoarse, u / kCoarse) += 1.0F;
  };
  for (int v = 0; v < masks.rows; ++v) {
    const std::uint16_t* row = masks[v];
    const std::uint16_t* below = v + 1 < masks.rows ? masks[v + 1] : row;
    for (int u = 0; u < masks.cols; ++u) {
      const std::uint16_t own = row[u], next = u + 1 < masks.cols ? row[u + 1] : own;
      if (own == next && own == below[u]) continue;
      if (next != own) {
        if (own != 0) count(Outward::right, v, u);
        if (next != 0) count(Outward::left, v, u + 1);
      }
      if (below[u] != own) {
        if (own != 0) count(Outward::down, v, u);
        if (below[u] != 0) count(Outward::up, v + 1, u);
      }
    }
  }
  return cells;
}

std::array<cv::Mat1b, 4> coarse_maps(const std::array<cv::Mat1f, 4>& cells) {
  std::array<cv::Mat1b, 4> maps;
  std::array<cv::Mat1f, 4> blurred;
  for (std::size_t way = 0; way < 4; ++way) {
    cv::Mat1f limited = cv::min(cells[way] / static_cast<double>(kCoarse), 1.0F);
    cv::GaussianBlur(limited, blurred[way], {5, 5}, 1.0);
  }
  for (std::size_t way = 0; way < 4; ++way) {
    const cv::Mat1f both = blurred[way] + kOtherWay * blurred[way ^ 1U];
    both.convertTo(maps[way], CV_8U, 255.0 / 0.4);
  }
  return maps;
}

}  // namespace

cv::Mat1w spread_owners(const cv::Mat1w& masks, int reach_px) {
  cv::Mat1w owner = masks.clone();
  for (int step = 0; step < reach_px; ++step) {
    const cv::Mat1w before = owner.clone();
    for (int v = 0; v < owner.rows; ++v) {
      const std::uint16_t* row = before[v];
      const std::uint16_t* above = before[std::max(v - 1, 0)];
      const std::uint16_t* below = before[std::min(v + 1, owner.rows - 1)];
      std::uint16_t* out = owner[v];
      for (int u = 0; u < owner.cols; ++u) {
        if (row[u] != 0) continue;
        const int left = std::max(u - 1, 0), right = std::min(u + 1, owner.cols - 1);
        for (const std::uint16_t near : {row[left], row[right], above[u], below[u]})
          if (near != 0 && (out[u] == 0 || near < out[u])) out[u] = near;
      }
    }
  }
  return owner;
}

OutlineField outline_field(const std::vector<Detection>& detections, int width_px, int height_px,
                           int reach_px) {
  OutlineField field;
  field.owner = painted(detections, width_px, height_px);
  field.distance = cv::Mat1f(height_px, width_px, OutlineField::kFar);
  field.elements = counted(field.owner, field.length_px);
  field.coarse = coarse_maps(field.elements);
  field.distance.setTo(-OutlineField::kFar, field.owner != 0);
  const cv::Rect window = window_of(detections, {width_px, height_px}, reach_px);
  if (field.length_px > 0 && !window.empty()) measure(field.owner(window), field.distance(window));
  return field;
}

}  // namespace mapscore
