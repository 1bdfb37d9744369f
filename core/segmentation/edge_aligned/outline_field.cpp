// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/outline_field.hpp"

#include "core/segmentation/edge_aligned/outline_distance.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace mapscore {
namespace {

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

/// The first from a place on that is not 0.
const std::uint16_t* next_of(const std::uint16_t* from, const std::uint16_t* end) {
  std::uint64_t four = 0;
  for (; end - from >= 4; from += 4) {
    std::memcpy(&four, from, sizeof four);
    if (four != 0) break;
  }
  return std::find_if(from, end, [](std::uint16_t x) { return x != 0; });
}

/// Counts the outline elements by the way they face, in cells.
void count_elements(const cv::Mat1w& masks, OutlineField& field) {
  for (cv::Mat1f& map : field.elements)
    map = cv::Mat1f(masks.rows / OutlineField::kCell_px + 1,
                    masks.cols / OutlineField::kCell_px + 1, 0.0F);
  const auto count = [&](Outward way, int v, int u) {
    ++field.length_px;
    field.elements[static_cast<std::size_t>(way)](v / OutlineField::kCell_px,
                                                  u / OutlineField::kCell_px) += 1.0F;
  };
  cv::Mat1b& borders = field.near_borders;
  const auto mark = [&](int v, int u) {
    if (borders.empty()) borders = cv::Mat1b(field.elements[0].size(), std::uint8_t{0});
    borders(v / OutlineField::kCell_px, u / OutlineField::kCell_px) = 1;
  };
  if (masks.empty()) return;
  const int last = masks.cols - 1;
  std::vector<std::uint16_t> changes(static_cast<std::size_t>(masks.cols));
  std::uint16_t* const change = changes.data();
  for (int v = 0; v < masks.rows; ++v) {
    const std::uint16_t* row = masks[v];
    const std::uint16_t* below = v + 1 < masks.rows ? masks[v + 1] : row;
    for (int u = 0; u < last; ++u)
      change[u] = static_cast<std::uint16_t>((row[u] ^ row[u + 1]) | (row[u] ^ below[u]));
    change[last] = row[last] ^ below[last];
    const std::uint16_t* const end = change + masks.cols;
    for (auto found = next_of(change, end); found != end; found = next_of(found + 1, end)) {
      const int u = static_cast<int>(found - change);
      const std::uint16_t own = row[u], next = u < last ? row[u + 1] : own;
      if (next != own) {
        if (own != 0) count(Outward::right, v, u);
        if (next != 0) count(Outward::left, v, u + 1);
        if (own != 0 && next != 0) mark(v, u);
      }
      if (below[u] != own) {
        if (own != 0) count(Outward::down, v, u);
        if (below[u] != 0) count(Outward::up, v + 1, u);
        if (own != 0 && below[u] != 0) mark(v, u);
      }
    }
  }
  constexpr int kCells = 2 * 16 / OutlineField::kCell_px + 3;
  if (!borders.empty()) cv::dilate(borders, borders, cv::Mat1b(kCells, kCells, std::uint8_t{1}));
}

void fill_far(const cv::Mat1w& owner, cv::Mat1f& distance) {
  for (int v = 0; v < owner.rows; ++v) {
    const std::uint16_t* own = owner[v];
    float* to = distance[v];
    for (int u = 0; u < owner.cols; ++u)
      to[u] = own[u] != 0 ? -OutlineField::kFar : OutlineField::kFar;
  }
}

std::array<cv::Mat1b, 4> coarse_maps(const std::array<cv::Mat1f, 4>& cells) {
  std::array<cv::Mat1b, 4> maps;
  std::array<cv::Mat1f, 4> blurred;
  for (std::size_t way = 0; way < 4; ++way) {
    cv::Mat1f limited = cv::min(cells[way] / static_cast<double>(OutlineField::kCell_px), 1.0F);
    cv::GaussianBlur(limited, blurred[way], {5, 5}, 1.0);
  }
  for (std::size_t way = 0; way < 4; ++way) {
    const cv::Mat1f both = blurred[way] + OutlineField::kOtherWay * blurred[way ^ 1U];
    both.convertTo(maps[way], CV_8U, 255.0 / 0.4);
  }
  return maps;
}

/// Pixels with an owner beside ones without.
std::vector<cv::Point> rim_of(const cv::Mat1w& owner) {
  std::vector<cv::Point> rim;
  if (owner.empty()) return rim;
  const int last = owner.cols - 1;
  std::vector<std::uint16_t> flags(static_cast<std::size_t>(owner.cols));
  std::uint16_t* const flag = flags.data();
  for (int v = 0; v < owner.rows; ++v) {
    const std::uint16_t* row = owner[v];
    const std::uint16_t* above = owner[std::max(v - 1, 0)];
    const std::uint16_t* below = owner[std::min(v + 1, owner.rows - 1)];
    const auto mark = [&](int u, std::uint16_t left, std::uint16_t right) {
      flag[u] = (row[u] != 0) & ((left == 0) | (right == 0) | (above[u] == 0) | (below[u] == 0));
    };
    for (int u = 1; u < last; ++u) mark(u, row[u - 1], row[u + 1]);
    mark(0, row[0], row[std::min(1, last)]);
    mark(last, row[std::max(last - 1, 0)], row[last]);
    const std::uint16_t* const end = flag + owner.cols;
    for (auto found = next_of(flag, end); found != end; found = next_of(found + 1, end))
      rim.emplace_back(static_cast<int>(found - flag), v);
  }
  return rim;
}

}  // namespace

cv::Mat1w spread_owners(const cv::Mat1w& masks, int reach_px) {
  cv::Mat1w owner = masks.clone();
  struct Claim {
    cv::Point pixel;
    std::uint16_t owner;
  };
  std::vector<cv::Point> rim = rim_of(masks);
  std::vector<Claim> claims;
  for (int step = 0; step < reach_px && !rim.empty(); ++step) {
    claims.clear();
    for (const cv::Point& at : rim)
      for (const cv::Point& way :
           {cv::Point(-1, 0), cv::Point(1, 0), cv::Point(0, -1), cv::Point(0, 1)}) {
        const cv::Point near = at + way;
        if (near.x < 0 || near.y < 0 || near.x >= owner.cols || near.y >= owner.rows) continue;
        if (owner(near) == 0) claims.push_back({near, owner(at)});
      }
    rim.clear();
    for (const Claim& claim : claims) {
      std::uint16_t& holder = owner(claim.pixel);
      if (holder == 0) rim.push_back(claim.pixel);
      if (holder == 0 || claim.owner < holder) holder = claim.owner;
    }
  }
  return owner;
}

OutlineField outline_field(const std::vector<Detection>& detections, int width_px, int height_px,
                           int reach_px) {
  OutlineField field;
  field.owner = painted(detections, width_px, height_px);
  field.distance = cv::Mat1f(height_px, width_px);
  count_elements(field.owner, field);
  field.coarse = coarse_maps(field.elements);
  const cv::Rect window = window_of(detections, {width_px, height_px}, reach_px);
  const bool outlined = field.length_px > 0 && !window.empty();
  if (!outlined || window.area() < height_px * width_px) fill_far(field.owner, field.distance);
  if (outlined) measure_outline_distance(field.owner(window), field.distance(window));
  return field;
}

}  // namespace mapscore
