// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/edge_aligned/edge_matching.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore {

/// The outlines of a field at quarter size, and some of a frame's edges: how well they lie on each
/// other after any of the many motions that a search tries. One thread at a time.
class CoarseOutlines {
 public:
  /// Of these edges every so-manieth, about 800. `field` must outlive it.
  CoarseOutlines(const std::vector<ProjectedEdge>& edges, const OutlineField& field,
                 const Projection& project);

  /// Share of the outlines that edges lie on where they go from p to R p + t (m).
  [[nodiscard]] float score(const Eigen::Matrix3f& R, const Eigen::Vector3f& t);

 private:
  const OutlineField& field_;
  Projection project_;
  std::size_t stride_;
  std::vector<float> x_, y_, z_, strength_;  ///< of the edges
  std::vector<int> map_;                     ///< where the map of an edge's way begins
  std::vector<std::uint8_t> maps_;           ///< of all ways, behind each other, and a 0
  std::vector<int> cells_;
};

}  // namespace mapscore
