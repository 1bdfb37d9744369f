// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/edge_aligned/edge_matching.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"
#include "core/wide_vectors.hpp"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore {

/// Every so-manieth of some edges, at most `most` of them, in columns: many are moved at once.
struct EdgeColumns {
  EdgeColumns() = default;
  EdgeColumns(const std::vector<ProjectedEdge>& edges, std::size_t most);

  std::size_t stride = 1;
  std::vector<float> x, y, z;  ///< in the colour camera's frame under the believed calibration, m
  std::vector<float> outward_u, outward_v, strength;
  std::vector<std::uint8_t> way;
};

/// Edges at places of the colour image, px, in columns.
struct PlacedEdges {
  std::vector<float> u, v, outward_u, outward_v, strength;

  void clear();
  void push_back(const Eigen::Vector2f& at, const Eigen::Vector2f& outward, float edge_strength);
};

/// Edges after a motion, matched with the outlines that they lie on there. What needs no branches
/// is done for many edges at once, and match_at for the few that may lie on a border of two masks.
/// One thread at a time.
class MatchedEdges {
 public:
  explicit MatchedEdges(const OutlineField& field) : field_(field) {}  ///< must outlive it

  static constexpr float kNearest_m = 0.05F;  ///< from the colour camera, of an edge that counts

  struct Match : EdgeMatch {
    float x, y, z;  ///< X / Z, Y / Z and Z (m) of the moved edge in the colour camera's frame
    float u, v;     ///< its pixel
  };

  /// Calls use(n, match) with each edge n that has a weight where `a` moves it, in order: the same
  /// as match_edge gives of each.
  void for_each(const EdgeColumns& edges, const OutlineAlignment& a, const Projection& project,
                float sigma_px, auto&& use) {
    move(edges, a, project);
    match_moved(edges, a.offset_px, sigma_px, [&](std::size_t n, const EdgeMatch& match) {
      use(n, Match{match, x_[n], y_[n], z_[n], u_[n], v_[n]});
    });
  }

  /// The same of edges that `shift` moves in the image: use(n, EdgeMatch).
  void for_each_shifted(const PlacedEdges& edges, const Eigen::Vector2f& shift, float offset_px,
                        float sigma_px, auto&& use) {
    move(edges, shift);
    match_moved(edges, offset_px, sigma_px, use);
  }

 private:
  void move(const EdgeColumns& edges, const OutlineAlignment& a, const Projection& project);
  void move(const PlacedEdges& edges, const Eigen::Vector2f& shift);

  void match_moved(const auto& edges, float offset_px, float sigma_px, auto&& use) {
    match_at_once(edges.outward_u, edges.outward_v, edges.strength, offset_px, sigma_px);
    const bool any_borders = !field_.near_borders.empty();
    for (std::size_t n = 0; n < is_near_.size(); ++n) {
      if (is_near_[n] == 0) continue;
      EdgeMatch match;
      if (any_borders && distance_[n] < 0) {
        match = match_at(field_, {u_[n], v_[n]}, {edges.outward_u[n], edges.outward_v[n]},
                         edges.strength[n], {distance_[n], {slope_u_[n], slope_v_[n]}}, offset_px,
                         sigma_px);
      } else {
        match.residual = distance_[n] - offset_px;
        if (std::abs(match.residual) > 3 * sigma_px) continue;
        match.weight = full_weight_[n] * std::exp(exponent_[n]);
        match.distance = distance_[n];
        match.facing = facing_[n];
        match.gradient = {slope_u_[n], slope_v_[n]};
      }
      if (match.weight > 0) use(n, match);
    }
  }

  /// Fills the columns of matches for all moved edges, as if there were no borders of two masks:
  /// the formula of match_at, which a test holds equal.
  void match_at_once(const std::vector<float>& outward_u, const std::vector<float>& outward_v,
                     const std::vector<float>& strength, float offset_px, float sigma_px);

  const OutlineField& field_;
  std::vector<float> x_, y_, z_, u_, v_;             ///< as in Match
  std::vector<float> distance_, slope_u_, slope_v_;  ///< of the field there, px
  std::vector<float> facing_;                        ///< as in EdgeMatch
  std::vector<float> full_weight_, exponent_;        ///< the weight is full_weight * exp(exponent)
  Marks is_near_;                                    ///< 1 where the distance is within reach
};

}  // namespace mapscore
