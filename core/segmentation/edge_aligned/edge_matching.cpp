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
  const float u = at.x() + 0.5F, v = at.y() + 0.5F;
  const bool inside = u >= 0 && v >= 0 && u < static_cast<float>(owners.cols) &&
                      v < static_cast<float>(owners.rows);
  return inside ? owners(static_cast<int>(v), static_cast<int>(u)) : std::uint16_t{0};
}

/// 1 + detection of the object that ends at the edge; 0 where it does not at a border.
std::uint16_t nearer_at_border(const OutlineField& field, const Eigen::Vector2f& at, int u, int v,
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

std::optional<BetweenPixels> beyond_border(const OutlineField& field, const Eigen::Vector2f& at,
                                           int u, int v, const Eigen::Vector2f& outward,
                                           const BetweenPixels& distance) {
  const std::uint16_t nearer = nearer_at_border(field, at, u, v, outward, distance);
  if (nearer == 0) return std::nullopt;
  const auto from_nearer = [&](int row, int column) {
    const std::uint16_t owner = field.owner(row, column);
    const float d = field.distance(row, column);
    return owner == nearer || owner == 0 ? d : -d;
  };
  return BetweenPixels(from_nearer(v, u), from_nearer(v, u + 1), from_nearer(v + 1, u),
                       from_nearer(v + 1, u + 1), at.x() - static_cast<float>(u),
                       at.y() - static_cast<float>(v));
}

}  // namespace mapscore
