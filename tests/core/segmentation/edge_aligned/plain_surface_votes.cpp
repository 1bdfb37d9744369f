// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/edge_matching.hpp"
#include "core/segmentation/edge_aligned/filled_slits.hpp"
#include "plain_edge_aligned.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace mapscore::testing {
namespace {

/// How much the slope of w rises from place n of a line to the next, 0 where that is not sure.
float turn_at(const std::vector<float>& w, const std::vector<float>& open, int n, float noise) {
  const int size = static_cast<int>(w.size());
  const auto goes_on = [&](int from) {
    return from >= 0 && from + 1 < size && open[static_cast<std::size_t>(from)] >= 1.0F;
  };
  const auto at = [&](int place) { return w[static_cast<std::size_t>(place)]; };
  if (!goes_on(n)) return 0.0F;
  int before = 0, after = 0;
  while (before < 4 && goes_on(n - before - 1)) ++before;
  while (after < 4 && goes_on(n + 1 + after)) ++after;
  if (before < 2 || after < 2) return 0.0F;
  const float a = 1.0F / static_cast<float>(before), b = 1.0F / static_cast<float>(after);
  const float turn = (at(n + 1 + after) - at(n + 1)) * b - (at(n) - at(n - before)) * a;
  const float sigma = std::max(0.00029F * at(n) * at(n), noise);
  return turn > std::max(0.0003F, 5.0F * sigma * (a + b)) ? turn : 0.0F;
}

cv::Mat1f plainly_parted(const DepthEdges& edges, bool rows) {
  cv::Mat1f out = (rows ? edges.right : edges.down).clone();
  const int lines = rows ? out.rows : out.cols, length = rows ? out.cols : out.rows;
  for (int line = 0; line < lines; ++line) {
    std::vector<float> w, open, turns;
    for (int n = 0; n < length; ++n) {
      w.push_back(rows ? edges.inverse_depth(line, n) : edges.inverse_depth(n, line));
      open.push_back(rows ? out(line, n) : out(n, line));
    }
    for (int n = 0; n < length; ++n) turns.push_back(turn_at(w, open, n, edges.noise));
    const auto turn = [&](int n) {
      return n < 0 || n >= length ? 0.0F : turns[static_cast<std::size_t>(n)];
    };
    for (int n = 0; n < length; ++n)
      if (turn(n) > std::max({0.0F, turn(n - 1), turn(n - 2)}) &&
          turn(n) >= std::max(turn(n + 1), turn(n + 2)))
        (rows ? out(line, n) : out(n, line)) = 0.0F;
  }
  return out;
}

/// Pixels that a vote may spread between: 1 on a surface, less across a step.
void average_along(cv::Mat1f& votes, const cv::Mat1f& open, bool rows, float feedback) {
  const int lines = rows ? votes.rows : votes.cols, length = rows ? votes.cols : votes.rows;
  const auto at = [&](auto& image, int line, int n) -> auto& {
    return rows ? image(line, n) : image(n, line);
  };
  for (int line = 0; line < lines; ++line) {
    for (int n = 1; n < length; ++n)
      at(votes, line, n) += feedback * at(open, line, n - 1) * at(votes, line, n - 1);
    for (int n = length - 2; n >= 0; --n) {
      const float a = feedback * at(open, line, n), here = at(votes, line, n);
      at(votes, line, n) = here + a * (at(votes, line, n + 1) - a * here);
    }
  }
}

void spread_votes(cv::Mat1f& votes, const cv::Mat1f& right, const cv::Mat1f& down, float reach_px) {
  const std::pair<bool, float> passes[]{{true, 1.0F}, {false, 1.0F}, {false, 0.5F},
                                        {true, 0.5F}, {true, 0.25F}, {false, 0.25F}};
  for (const auto& [rows, share] : passes)
    average_along(votes, rows ? right : down, rows, std::exp(-1.0F / (share * reach_px)));
}

/// How much a surface rises to the next pixel.
float plain_slope(const DepthEdges& edges, int v, int u) {
  const cv::Mat1f& w = edges.inverse_depth;
  float steepest = 0;
  for (const bool row : {true, false}) {
    float least = 1.0F;
    bool any = false;
    for (const int way : {-1, 1}) {
      const int y = row ? v : v + way, x = row ? u + way : u;
      if (y < 0 || x < 0 || y >= w.rows || x >= w.cols) continue;
      const float open = (row ? edges.right : edges.down)(std::min(v, y), std::min(u, x));
      if (open < 1.0F) continue;
      any = true, least = std::min(least, std::abs(w(y, x) - w(v, u)));
    }
    if (any) steepest = std::max(steepest, least);
  }
  return steepest;
}

/// Whether a pair of pixels and those before and behind it are one surface, as far as they are
/// there.
bool goes_on(const cv::Mat1f& open, int v, int u, bool rows) {
  const int length = rows ? open.cols : open.rows, at = rows ? u : v;
  for (int n = std::max(at - 1, 0); n <= std::min(at + 1, length - 2); ++n)
    if (open(rows ? v : n, rows ? n : u) < 1.0F) return false;
  return true;
}

/// Pairs of a row or column whose pixels two masks hold, where their surface goes on.
cv::Mat1b contacts(const cv::Mat1w& owner, const cv::Mat1f& open, bool rows) {
  cv::Mat1b found(owner.size(), std::uint8_t{0});
  for (int v = 0; v + (rows ? 0 : 1) < owner.rows; ++v)
    for (int u = 0; u + (rows ? 1 : 0) < owner.cols; ++u) {
      const std::uint16_t first = owner(v, u), second = rows ? owner(v, u + 1) : owner(v + 1, u);
      found(v, u) =
          first != second && first != 0 && second != 0 && goes_on(open, v, u, rows) ? 255 : 0;
    }
  return found;
}

/// 255 where an owner's votes meet others: in blocks of 16 x 32 pixels near where its pixels begin
/// or end, but for contacts, within the box about all such places.
cv::Mat1b contested_pixels(const cv::Mat1w& owner, std::uint16_t own, const cv::Mat1b& along_rows,
                           const cv::Mat1b& along_columns, int margin_px) {
  cv::Mat1b ends(owner.size(), std::uint8_t{0}), blocks = ends.clone(), box = ends.clone();
  const auto is_end = [&](const cv::Point& at, const cv::Point& before, const cv::Mat1b& touching) {
    const bool is_own = owner(at) == own, was_own = owner(before) == own;
    return is_own != was_own && touching(before) == 0;
  };
  for (int v = 0; v < owner.rows; ++v)
    for (int u = 0; u < owner.cols; ++u)
      if ((u > 0 && is_end({u, v}, {u - 1, v}, along_rows)) ||
          (v > 0 && is_end({u, v}, {u, v - 1}, along_columns)))
        ends(v, u) = 255;
  const cv::Rect image({0, 0}, owner.size());
  for (int top = 0; top < owner.rows; top += 32)
    for (int left = 0; left < owner.cols; left += 16) {
      const cv::Rect block = cv::Rect(left, top, 16, 32) & image;
      const cv::Rect about(left - margin_px + 1, top - margin_px + 1,
                           block.width + 2 * margin_px - 1, block.height + 2 * margin_px - 1);
      if (cv::countNonZero(ends(about & image)) > 0) blocks(block) = 255;
    }
  const cv::Rect extent = cv::boundingRect(ends);
  if (extent.empty()) return box;
  box(cv::Rect(extent.x - margin_px, extent.y - margin_px, extent.width + 2 * margin_px - 1,
               extent.height + 2 * margin_px - 1) &
      image) = 255;
  return blocks & box;
}

}  // namespace

Continuity plain_creases(const DepthEdges& edges) {
  return {plainly_parted(edges, true), plainly_parted(edges, false)};
}

cv::Mat1w plain_surface_votes(const DepthEdges& edges, const MaskField& masks,
                              const OutlineAlignment& alignment, const OutlineShifts& shifts,
                              const Calibration& believed, std::size_t detections, float reach_px) {
  const cv::Mat1f& w = edges.inverse_depth;
  const Calibration mended = alignment.corrected(believed);
  const Eigen::Matrix3f R = mended.T_color_depth.linear().cast<float>();
  const Eigen::Vector3f t = mended.T_color_depth.translation().cast<float>();
  const Projection color(mended.color), depth(mended.depth);
  cv::Mat2i pixels(w.size());
  cv::Mat1f nearest(masks.owner.size(), 0.0F);
  const cv::Rect image({0, 0}, masks.owner.size());
  // Pixels that a surface is spread by: along the baseline, and over half of a gap between depth
  // pixels.
  const auto half_gap = [](double to, double from) {
    return static_cast<int>(std::ceil((std::min(to / from, 64.0) - 1.02) / 2));
  };
  const CameraModel &fine = mended.color, &coarse = mended.depth;
  const Eigen::Vector3d& by = mended.T_color_depth.translation();
  const double sideways = fine.fx_px * std::abs(by.x()), upright = fine.fy_px * std::abs(by.y());
  const int wide = std::max(sideways >= 3 && sideways >= upright / 2 ? 1 : 0,
                            half_gap(fine.fx_px, coarse.fx_px));
  const int high =
      std::max(upright >= 3 && upright >= sideways / 2 ? 1 : 0, half_gap(fine.fy_px, coarse.fy_px));
  for (int v = 0; v < w.rows; ++v)
    for (int u = 0; u < w.cols; ++u) {
      const float x = (static_cast<float>(u) - depth.cx) * (1.0F / depth.fx);
      const float y = (static_cast<float>(v) - depth.cy) / depth.fy;
      Eigen::Vector3f p;  // over z
      for (int n = 0; n < 3; ++n) p[n] = R(n, 0) * x + R(n, 1) * y + R(n, 2) + t[n] * w(v, u);
      const float inverse_z = 1.0F / p.z();
      cv::Vec2f at(color.fx * p.x() * inverse_z + color.cx,
                   color.fy * p.y() * inverse_z + color.cy);
      if (!shifts.nodes.empty()) at += shifts.at(at[0], at[1]);
      const cv::Vec2i pixel(cvFloor(at[0] + 0.5F), cvFloor(at[1] + 0.5F));
      pixels(v, u) = pixel;
      const cv::Rect about(pixel[0] - wide, pixel[1] - high, 2 * wide + 1, 2 * high + 1);
      if (!image.contains(cv::Point(pixel))) continue;
      cv::Mat1f near = nearest(about & image);
      near = cv::max(near, w(v, u));
    }
  const float k = alignment.offset_px;
  const cv::Mat1w owners =
      k > 0.5F ? spread_owners(masks.owner, static_cast<int>(std::ceil(1.5F * k))) : masks.owner;
  cv::Mat1f to_free;
  cv::distanceTransform(masks.owner != 0, to_free, cv::DIST_L2, cv::DIST_MASK_3);
  cv::Mat1w owner(w.size(), std::uint16_t{0});
  cv::Mat1f inside(w.size(), -1e4F), weight(w.size(), 0.0F);
  for (int v = 0; v < w.rows; ++v)
    for (int u = 0; u < w.cols; ++u) {
      const cv::Point pixel(pixels(v, u));
      if (!(w(v, u) > 0) || !image.contains(pixel)) continue;
      owner(v, u) = owners(pixel);
      const float distance = masks.distance(pixel);
      inside(v, u) = k - distance;
      if (k < -0.5F && inside(v, u) <= 0 && to_free(pixel) > 0.5F - k) inside(v, u) = -distance;
      const float behind = nearest(pixel) * (1.0F - 0.015F) - 4.0F * edges.noise - w(v, u);
      if (behind > 2.0F * plain_slope(edges, v, u))
        inside(v, u) = -1.0F, weight(v, u) = 0.2F;
      else
        weight(v, u) = std::clamp(std::abs(inside(v, u)) / 2.0F, 0.05F, 1.0F);
    }
  if (k <= -0.5F) {
    const cv::Mat1b slits = filled_slits(edges, owner, static_cast<int>(std::ceil(-2 * k)));
    inside.setTo(-1.0F, slits);
    weight.setTo(1.0F, slits);
  }
  const Continuity on =
      edges.noise > 0.0005F ? Continuity{edges.right, edges.down} : plain_creases(edges);
  owner.setTo(0, inside <= 0);
  const cv::Mat1b along_rows = contacts(owner, on.right, true),
                  along_columns = contacts(owner, on.down, false);
  cv::Mat1w labels = owner.clone();
  for (std::size_t n = 1; n <= detections; ++n) {
    const auto own = static_cast<std::uint16_t>(n);
    const int margin_px = static_cast<int>(std::ceil(2.0F * reach_px)) + 2;
    const cv::Mat1b contested = contested_pixels(owner, own, along_rows, along_columns, margin_px);
    cv::Mat1f leads(w.size(), 0.0F), right = on.right.clone(), down = on.down.clone();
    right.setTo(0, along_rows), down.setTo(0, along_columns);
    for (int v = 0; v < w.rows; ++v)
      for (int u = 0; u < w.cols; ++u) {
        const auto steps_to = [&](int beyond_v, int beyond_u) {
          const std::uint16_t other = owner(beyond_v, beyond_u);
          return owner(v, u) != 0 && other != 0 && other != owner(v, u);
        };
        if (u + 1 < w.cols && right(v, u) < 1.0F && steps_to(v, u + 1)) right(v, u) = 0;
        if (v + 1 < w.rows && down(v, u) < 1.0F && steps_to(v + 1, u)) down(v, u) = 0;
      }
    for (int v = 0; v < w.rows; ++v)
      for (int u = 0; u < w.cols; ++u) {
        const std::uint16_t other = owner(v, u);
        if (contested(v, u) != 0)
          leads(v, u) = (other == own ? 1.0F : other != 0 ? -1.0F : -4.0F) * weight(v, u);
        if (u + 1 < w.cols && contested(v, u) != contested(v, u + 1)) right(v, u) = 0;
        if (v + 1 < w.rows && contested(v, u) != contested(v + 1, u)) down(v, u) = 0;
      }
    spread_votes(leads, right, down, reach_px);
    labels.setTo(0, contested & (labels == own));
    labels.setTo(own, contested & (leads > 1e-4F) & (w > 0));
  }
  return labels;
}

}  // namespace mapscore::testing
