// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/edge_aligned/depth_edges.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"

#include <Eigen/Core>
#include <algorithm>
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
  [[nodiscard]] Eigen::Vector2f operator()(const Eigen::Vector3f& p) const {
    return {fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy};
  }
};

/// How an edge at a place of the colour image lies to the outlines.
struct EdgeMatch {
  float weight = 0;                ///< 0 where it meets no outline
  float residual = 0;              ///< distance beyond where the object should end, px
  float facing = 0;                ///< cosine between edge and outline
  Eigen::Vector2f gradient{0, 0};  ///< of the residual
};

/// weight = strength * (facing, or kOtherWay * -facing) * exp(-residual^2 / (2 sigma^2)), 0 beyond
/// 3 sigma; residual = distance - offset, interpolated between pixels.
[[nodiscard]] inline EdgeMatch match_edge(const OutlineField& field, const Eigen::Vector2f& at,
                                          const Eigen::Vector2f& outward, float strength,
                                          float offset_px, float sigma_px) {
  EdgeMatch match;
  if (!(at.x() >= 0 && at.y() >= 0)) return match;
  const int u = static_cast<int>(at.x()), v = static_cast<int>(at.y());
  if (u + 1 >= field.distance.cols || v + 1 >= field.distance.rows) return match;
  const float* top = field.distance[v] + u;
  const float* low = field.distance[v + 1] + u;
  const float a = at.x() - static_cast<float>(u), b = at.y() - static_cast<float>(v);
  const float value =
      (1 - b) * ((1 - a) * top[0] + a * top[1]) + b * ((1 - a) * low[0] + a * low[1]);
  match.residual = value - offset_px;
  if (std::abs(match.residual) > 3 * sigma_px) return match;
  match.gradient = {(1 - b) * (top[1] - top[0]) + b * (low[1] - low[0]),
                    (1 - a) * (low[0] - top[0]) + a * (low[1] - top[1])};
  match.facing = match.gradient.dot(outward);
  constexpr auto kOtherWay = static_cast<float>(OutlineField::kOtherWay);
  match.weight = strength * (match.facing > 0 ? match.facing : -kOtherWay * match.facing) *
                 std::exp(-0.5F * match.residual * match.residual / (sigma_px * sigma_px));
  return match;
}

}  // namespace mapscore
