// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/edge_aligned/edge_matching.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore {

/// The edges, in the colour camera's frame under the believed calibration, that lie ahead of it and
/// within `reach_px` of an outline in its image; beyond the image the way to it counts too.
[[nodiscard]] std::vector<ProjectedEdge> edges_near_outlines(const DepthEdges& edges,
                                                             const OutlineField& field,
                                                             const Calibration& believed,
                                                             float reach_px);

/// Every so-manieth of some edges, at most `most` of them, in columns: many are moved at once.
struct EdgeColumns {
  /// Columns hold whole groups of so many, the last filled up with edges of strength 0.
  static constexpr std::size_t kTogether = 16;

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

/// Edges after a motion, matched with the outlines that they lie on there, many at once: columns of
/// what match_edge gives of each. One thread at a time.
class MatchedEdges {
 public:
  explicit MatchedEdges(const OutlineField& field) : field_(field) {}  ///< must outlive it

  static constexpr float kNearest_m = 0.05F;  ///< from the colour camera, of an edge that counts

  /// Matches edges where `a` moves them.
  void match(const EdgeColumns& edges, const OutlineAlignment& a, const Projection& project,
             float sigma_px);

  /// Matches edges that `shift` moves in the image.
  void match_shifted(const PlacedEdges& edges, const Eigen::Vector2f& shift, float offset_px,
                     float sigma_px);

  /// Of each edge the cell that holds the nearest point of its outline, the foot of the
  /// perpendicular: an index into the field's four maps of `elements`, laid end to end. -1 where
  /// the edge has no weight, or that point lies beyond the image. `ways`: of the edges, as
  /// EdgeColumns.
  void find_feet(const std::vector<std::uint8_t>& ways, std::vector<int>& feet) const;

  /// Calls use(n) for each edge n that has a weight, in order.
  void for_each(auto&& use) const {
    for (std::size_t n = 0; n < weight.size(); ++n)
      if (weight[n] > 0) use(n);
  }

  std::vector<float> x, y;      ///< X / Z, Y / Z in the colour camera's frame, if moved
  std::vector<float> nearness;  ///< 1 / Z, 1/m, likewise
  std::vector<float> u, v;      ///< place in the colour image, px
  std::vector<float> weight, residual, distance, facing, slope_u, slope_v;  ///< as in EdgeMatch
  std::vector<float> slope_offset;  ///< of the residual with the masks' offset: 0 at borders, or -1

 private:
  void move(const EdgeColumns& edges, const OutlineAlignment& a, const Projection& project);
  void match_placed(const std::vector<float>& outward_u, const std::vector<float>& outward_v,
                    const std::vector<float>& strength, const MatchRules& rules);
  void match_all(const float* outward_us, const float* outward_vs, const float* strengths,
                 const MatchRules& rules);

  const OutlineField& field_;
};

/// Measures how much of a frame's outlines its edges explain. `field` and `edges` must outlive it.
class ExplainedOutlines {
 public:
  ExplainedOutlines(const OutlineField& field, const EdgeColumns& edges, const Projection& project)
      : matched_(field), field_(field), edges_(edges), project_(project) {}

  /// Number of outline elements on which edges lie where `a` moves them, at a width of `sigma_px`.
  /// However many edges crowd around an element, it counts once.
  [[nodiscard]] float px(const OutlineAlignment& a, float sigma_px);

 private:
  MatchedEdges matched_;
  const OutlineField& field_;
  const EdgeColumns& edges_;
  Projection project_;
  std::vector<int> feet_;           ///< of the matched edges
  std::vector<float> votes_;        ///< for each of the field's elements; 0 between two measures
  std::vector<std::size_t> voted_;  ///< those that have votes
};

/// What a fit changes: turns about x and y, in pixels at the image's middle; roll and the logarithm
/// of the focal length, in pixels as far from it as the focal length; shifts along x and y, m; the
/// masks' offset, px.
enum Parameter { kTurnX, kTurnY, kRoll, kFocal, kShiftX, kShiftY, kOffset, kParameters };
using Parameters = Eigen::Matrix<float, kParameters, 1>;

/// Sums over matched edges, of weights w, residuals r and slopes J of these with the parameters.
struct NormalEquations {
  Eigen::Matrix<float, kParameters, kParameters> H;  ///< w J J^T
  Parameters b;                                      ///< -w r J
  float matched = 0, squares = 0;                    ///< w, w r^2
};

/// Adds up edges that were moved and matched in whole groups (EdgeColumns::kTogether): each place
/// of a group by itself, then these places in order. `project`: the one that matched them;
/// `focal_px`: of the believed colour camera, in which parameters are counted.
[[nodiscard]] NormalEquations add_up(const MatchedEdges& edges, const Projection& project,
                                     float focal_px);

/// A correction as parameters, of small turns.
[[nodiscard]] Parameters parameters_of(const OutlineAlignment& a, float focal_px);

/// The step that solves H step = b for the parameters that are free (1, others 0).
[[nodiscard]] Parameters solved(Eigen::Matrix<float, kParameters, kParameters> H, Parameters b,
                                const Parameters& free);

/// A correction after a step.
[[nodiscard]] OutlineAlignment stepped(OutlineAlignment a, const Parameters& step, float focal_px);

}  // namespace mapscore
