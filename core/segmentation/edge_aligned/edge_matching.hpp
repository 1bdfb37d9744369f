// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/edge_aligned/depth_edges.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>

namespace mapscore {

[[nodiscard]] inline Eigen::Vector2f direction_of(Outward way) {
  switch (way) {
    case Outward::right:
      return {1, 0};
    case Outward::left:
      return {-1, 0};
    case Outward::down:
      return {0, 1};
    case Outward::up:
      return {0, -1};
  }
  return {0, 0};
}

/// Pinhole projection in single precision.
struct Projection {
  float fx, fy, cx, cy;
  explicit Projection(const CameraModel& camera)
      : fx(static_cast<float>(camera.fx_px)),
        fy(static_cast<float>(camera.fy_px)),
        cx(static_cast<float>(camera.cx_px)),
        cy(static_cast<float>(camera.cy_px)) {}
  /// With focal lengths `ratio` times as long.
  [[nodiscard]] Projection scaled(float ratio) const {
    Projection other = *this;
    other.fx *= ratio, other.fy *= ratio;
    return other;
  }
  [[nodiscard]] Eigen::Vector2f operator()(const Eigen::Vector3f& p) const {
    return {fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy};
  }
};

/// An edge in the colour camera's frame under the believed calibration.
struct ProjectedEdge {
  Eigen::Vector3f p;
  Eigen::Vector2f outward;
  std::uint8_t way;
  float strength;
};

/// A value between four pixels, and how it changes along rows and columns, by its values at the
/// pixel above left, the next in the row, the one below and the next of that; a, b: place between
/// them, 0 to 1.
struct BetweenPixels {
  float value;
  Eigen::Vector2f gradient;

  BetweenPixels(float known_value, const Eigen::Vector2f& known_gradient)
      : value(known_value), gradient(known_gradient) {}
  BetweenPixels(float top_left, float top_right, float low_left, float low_right, float a, float b)
      : value((1 - b) * ((1 - a) * top_left + a * top_right) +
              b * ((1 - a) * low_left + a * low_right)),
        gradient((1 - b) * (top_right - top_left) + b * (low_right - low_left),
                 (1 - a) * (low_left - top_left) + a * (low_right - top_right)) {}
};

/// How an edge at a place of the colour image lies to the outlines.
struct EdgeMatch {
  float weight = 0;                ///< 0 where it meets no outline
  float residual = 0;              ///< distance beyond where the object should end, px
  float distance = 0;              ///< the same from its mask's outline
  float facing = 0;                ///< cosine between edge and outline
  Eigen::Vector2f gradient{0, 0};  ///< of the residual
  bool at_border = false;          ///< of two masks, which does not move with the masks' size
};

/// Where two masks touch, their border is the outline of the nearer object alone, which ends at the
/// edge: the distance beyond it. It is 0 on the border and goes on evenly, whereas
/// OutlineField::distance is negative on both sides, with a ridge between. None where the nearest
/// outline is no border of two masks. `distance`: the field's at `at`, between the pixels whose
/// first is (u, v).
[[nodiscard]] std::optional<BetweenPixels> beyond_border(const OutlineField& field,
                                                         const Eigen::Vector2f& at, int u, int v,
                                                         const Eigen::Vector2f& outward,
                                                         const BetweenPixels& distance);

/// Matches an edge with the nearest outline, which is `distance` from `at`, the field's between its
/// pixels: weight = strength * (facing, or against * -facing) * exp(-residual^2 / (2 sigma^2)), 0
/// beyond 3 sigma; residual = distance - offset. A border of two masks (beyond_border) has no
/// offset, since objects that touch have no room for one. `against`: what faces against its outline
/// weighs, since something may stand in front there.
[[nodiscard]] inline EdgeMatch match_at(
    const OutlineField& field, const Eigen::Vector2f& at, const Eigen::Vector2f& outward,
    float strength, BetweenPixels distance, float offset_px, float sigma_px,
    float against = static_cast<float>(OutlineField::kOtherWay)) {
  EdgeMatch match;
  const int u = static_cast<int>(at.x()), v = static_cast<int>(at.y());
  if (distance.value < 0 && field.is_near_border(v, u))
    if (const auto beyond = beyond_border(field, at, u, v, outward, distance)) {
      distance = *beyond;
      match.at_border = true;
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

/// The same of an edge at a place of the colour image; no weight beyond the image.
[[nodiscard]] inline EdgeMatch match_edge(
    const OutlineField& field, const Eigen::Vector2f& at, const Eigen::Vector2f& outward,
    float strength, float offset_px, float sigma_px,
    float against = static_cast<float>(OutlineField::kOtherWay)) {
  EdgeMatch match;
  const float right = static_cast<float>(field.distance.cols - 1),
              bottom = static_cast<float>(field.distance.rows - 1);
  if (!(at.x() >= 0 && at.y() >= 0 && at.x() < right && at.y() < bottom)) return match;
  const int u = static_cast<int>(at.x()), v = static_cast<int>(at.y());
  const float* top = field.distance[v] + u;
  const float* low = field.distance[v + 1] + u;
  const float a = at.x() - static_cast<float>(u), b = at.y() - static_cast<float>(v);
  const BetweenPixels distance(top[0], top[1], low[0], low[1], a, b);
  if (std::abs(distance.value) > 3 * sigma_px + std::abs(offset_px)) return match;
  return match_at(field, at, outward, strength, distance, offset_px, sigma_px, against);
}

}  // namespace mapscore
