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

/// Edges after a motion, matched with the outlines that they lie on there. What needs no branches
/// is done for many edges at once, and match_at for the few that lie near an outline. One thread at
/// a time.
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
    find_distances(3 * sigma_px + std::abs(a.offset_px));
    for (std::size_t n = 0; n < is_near_.size(); ++n) {
      if (is_near_[n] == 0) continue;
      const BetweenPixels distance(value_[n], {slope_u_[n], slope_v_[n]});
      const Match match{match_at(field_, {u_[n], v_[n]}, {edges.outward_u[n], edges.outward_v[n]},
                                 edges.strength[n], distance, a.offset_px, sigma_px),
                        x_[n],
                        y_[n],
                        z_[n],
                        u_[n],
                        v_[n]};
      if (match.weight > 0) use(n, match);
    }
  }

 private:
  void move(const EdgeColumns& edges, const OutlineAlignment& a, const Projection& project);
  void find_distances(float within_px);

  const OutlineField& field_;
  std::vector<float> x_, y_, z_, u_, v_;          ///< as in Match
  std::vector<float> value_, slope_u_, slope_v_;  ///< of the field's distance there, px
  Marks is_near_;                                 ///< 1 where the distance is within reach
};

}  // namespace mapscore
