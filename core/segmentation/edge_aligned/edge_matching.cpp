// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/edge_matching.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mapscore {
namespace {

constexpr float kLeastSlope = 0.3F;  // of the distance, where it tells which outline is nearest

/// 0 beyond the image.
std::uint16_t owner_at(const cv::Mat1w& owners, const Eigen::Vector2f& at) {
  const int u = static_cast<int>(std::floor(at.x() + 0.5F)),
            v = static_cast<int>(std::floor(at.y() + 0.5F));
  const bool inside = u >= 0 && v >= 0 && u < owners.cols && v < owners.rows;
  return inside ? owners(v, u) : std::uint16_t{0};
}

/// The object that ends at an edge where two masks touch, or may: 1 + detection; 0 where the
/// nearest outline is no border of two. `distance`: the field's, at the edge between the pixels
/// whose first is (u, v).
std::uint16_t ends_at_border(const OutlineField& field, const Eigen::Vector2f& at, int u, int v,
                             const Eigen::Vector2f& outward, const BetweenPixels& distance) {
  const std::uint16_t here = owner_at(field.owner, at);
  if (here == 0) return 0;
  const std::array owners{field.owner(v, u), field.owner(v, u + 1), field.owner(v + 1, u),
                          field.owner(v + 1, u + 1)};
  if (std::ranges::any_of(owners, [&](auto owner) { return owner != 0 && owner != here; }))
    return owner_at(field.owner, at - 0.75F * outward);
  const float slope = distance.gradient.norm();
  if (slope < kLeastSlope) return 0;
  const Eigen::Vector2f beyond = at + (std::abs(distance.value) + 1.0F) / slope * distance.gradient;
  const std::uint16_t other = owner_at(field.owner, beyond);
  if (other == 0 || other == here) return 0;
  return distance.gradient.dot(outward) < 0 ? other : here;
}

}  // namespace

EdgeMatch match_edge(const OutlineField& field, const Eigen::Vector2f& at,
                     const Eigen::Vector2f& outward, float strength, float offset_px,
                     float sigma_px, float against) {
  EdgeMatch match;
  if (!(at.x() >= 0 && at.y() >= 0)) return match;
  const int u = static_cast<int>(at.x()), v = static_cast<int>(at.y());
  if (u + 1 >= field.distance.cols || v + 1 >= field.distance.rows) return match;
  const float* top = field.distance[v] + u;
  const float* low = field.distance[v + 1] + u;
  const float a = at.x() - static_cast<float>(u), b = at.y() - static_cast<float>(v);
  BetweenPixels distance(top[0], top[1], low[0], low[1], a, b);
  if (std::abs(distance.value) - std::abs(offset_px) > 3 * sigma_px) return match;
  if (field.has_borders) {
    const std::uint16_t nearer = ends_at_border(field, at, u, v, outward, distance);
    if (nearer != 0) {
      const auto from_nearer = [&](int row, int column) {
        const std::uint16_t owner = field.owner(row, column);
        const float d = field.distance(row, column);
        return owner == nearer || owner == 0 ? d : -d;
      };
      distance = {from_nearer(v, u),
                  from_nearer(v, u + 1),
                  from_nearer(v + 1, u),
                  from_nearer(v + 1, u + 1),
                  a,
                  b};
      match.at_border = true;
    }
  }
  match.distance = distance.value;
  match.residual = match.at_border ? distance.value : distance.value - offset_px;
  if (std::abs(match.residual) > 3 * sigma_px) return match;
  match.gradient = distance.gradient;
  match.facing = match.gradient.dot(outward);
  match.weight = strength * (match.facing > 0 ? match.facing : -against * match.facing) *
                 std::exp(-0.5F * match.residual * match.residual / (sigma_px * sigma_px));
  return match;
}

}  // namespace mapscore
