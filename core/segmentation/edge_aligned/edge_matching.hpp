// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/edge_aligned/depth_edges.hpp"
#include "core/segmentation/edge_aligned/outline_distance.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

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
    const float nearness = 1.0F / p.z();
    return {fx * (p.x() * nearness) + cx, fy * (p.y() * nearness) + cy};
  }
};

/// An edge in the colour camera's frame under the believed calibration.
struct ProjectedEdge {
  Eigen::Vector3f p;
  Eigen::Vector2f outward;
  std::uint8_t way;
  float strength;
};

/// How an edge at a place of the colour image lies to the outlines.
struct EdgeMatch {
  float weight = 0;                ///< 0 where it meets no outline
  float residual = 0;              ///< distance beyond where the object should end, px
  float distance = 0;              ///< the same without the offset, px
  float facing = 0;                ///< cosine between edge and outline
  float slope_u = 0, slope_v = 0;  ///< of the residual along rows and columns of the image
  bool at_border = false;          ///< of two masks, which does not move with the masks' size

  [[nodiscard]] Eigen::Vector2f gradient() const { return {slope_u, slope_v}; }
};

/// What is matched: a step at (u, v), px, that faces outwards, and how.
struct EdgeAt {
  float u, v, outward_u, outward_v, strength;
};

struct MatchRules {
  float offset_px;  ///< of all outlines but borders of two masks, outwards
  float sigma_px;   ///< of a residual
  /// What faces against its outline weighs, since something may stand in front there.
  float against = static_cast<float>(OutlineField::kOtherWay);
};

inline constexpr float kMostSquaredSlope = 2.5F;  // of a distance that goes on evenly

/// exp(x) of -4.5 to 0, within 2e-5 of it. A loop of these becomes vectors, one of std::exp does
/// not.
[[nodiscard]] inline float exp_of_part(float x) {
  const float t = x / 16;
  const float root =
      1 + t * (1 + t * (1.0F / 2 + t * (1.0F / 6 + t * (1.0F / 24 + t * (1.0F / 120)))));
  const float fourth = root * root * (root * root);
  return fourth * fourth * (fourth * fourth);
}

/// Matches an edge with the nearest outline: weight = strength * (facing, or against * -facing) *
/// exp(-residual^2 / (2 sigma^2)), 0 beyond 3 sigma and beyond the image; residual = distance -
/// offset. Where two masks touch, their border is the outline of the nearer object alone, which
/// ends at the edge: the residual is the distance beyond it on the side to which the edge faces,
/// which has no offset, since objects that touch leave no room for one. `distance`: of a field,
/// row-major. Without branches, so that a loop of these becomes vectors.
[[nodiscard]] inline EdgeMatch match_in(const float* distance, int columns, int rows,
                                        const EdgeAt& edge, const MatchRules& rules) {
  const float right = static_cast<float>(columns - 1), bottom = static_cast<float>(rows - 1);
  const float at_u = edge.u > 0 ? edge.u < right ? edge.u : right : 0.0F;
  const float at_v = edge.v > 0 ? edge.v < bottom ? edge.v : bottom : 0.0F;
  const int last_u = static_cast<int>(at_u), last_v = static_cast<int>(at_v);
  const int u = last_u < columns - 2 ? last_u : columns - 2;
  const int v = last_v < rows - 2 ? last_v : rows - 2;
  const float a = at_u - static_cast<float>(u), b = at_v - static_cast<float>(v);
  const int cell = v * columns + u;
  float top_left = distance[cell], top_right = distance[cell + 1],
        low_left = distance[cell + columns], low_right = distance[cell + columns + 1];
  const bool at_border = (border_of(top_left) != kNoBorder) & (border_of(top_right) != kNoBorder) &
                         (border_of(low_left) != kNoBorder) & (border_of(low_right) != kNoBorder);
  top_left = at_border ? beyond_border(top_left) : top_left;
  top_right = at_border ? beyond_border(top_right) : top_right;
  low_left = at_border ? beyond_border(low_left) : low_left;
  low_right = at_border ? beyond_border(low_right) : low_right;
  const float between =
      (1 - b) * ((1 - a) * top_left + a * top_right) + b * ((1 - a) * low_left + a * low_right);
  const float along_u = (1 - b) * (top_right - top_left) + b * (low_right - low_left);
  const float along_v = (1 - a) * (low_left - top_left) + a * (low_right - top_right);
  const float along = along_u * edge.outward_u + along_v * edge.outward_v;
  const float side = at_border & (along < 0) ? -1.0F : 1.0F;
  EdgeMatch match;
  match.at_border = at_border;
  match.distance = side * between;
  match.slope_u = side * along_u, match.slope_v = side * along_v;
  match.facing = side * along;
  match.residual = at_border ? match.distance : match.distance - rules.offset_px;
  const float opposite = -rules.against * match.facing;
  const float faces = match.facing > 0 ? match.facing : opposite;
  // In strips and where three masks meet, distances from two borders lie beside each other.
  const bool is_even = !at_border | (along_u * along_u + along_v * along_v < kMostSquaredSlope);
  const bool is_inside = (edge.u >= 0) & (edge.v >= 0) & (edge.u < right) & (edge.v < bottom);
  const bool is_near = std::abs(match.residual) <= 3 * rules.sigma_px;
  const float part =
      exp_of_part(-0.5F / (rules.sigma_px * rules.sigma_px) * (match.residual * match.residual));
  match.weight = is_even & is_inside & is_near ? edge.strength * faces * part : 0.0F;
  return match;
}

/// The same of one edge in a field.
[[nodiscard]] inline EdgeMatch match_edge(const OutlineField& field, const EdgeAt& edge,
                                          const MatchRules& rules) {
  const int columns = field.distance.cols, rows = field.distance.rows;
  if (columns < 2 || rows < 2) return {};
  return match_in(field.distance[0], columns, rows, edge, rules);
}

}  // namespace mapscore
