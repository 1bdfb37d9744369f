// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/edge_aligned/matched_edges.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace mapscore {

/// The outlines of a field at quarter size, and some of a frame's edges: how well they lie on each
/// other after any of the many motions that a search tries. One thread at a time.
class CoarseOutlines {
 public:
  /// `edges` and `field` must outlive it.
  CoarseOutlines(const EdgeColumns& edges, const OutlineField& field, const Projection& project);

  /// Share of the outlines that edges lie on where they go from p to R p + t (m). Sums in kTogether
  /// lanes, and over these at last, in order.
  [[nodiscard]] float score(const Eigen::Matrix3f& R, const Eigen::Vector3f& t);

 private:
  /// Finds what each edge weighs after a motion.
  void weigh(const Eigen::Matrix3f& R, const Eigen::Vector3f& t);

  const EdgeColumns& edges_;
  const OutlineField& field_;
  Projection project_;
  std::vector<int> cells_;  ///< the field's maps of all ways, side by side in each cell
  std::vector<int> bits_;   ///< where an edge's way begins in them
  std::vector<float> weights_;
};

}  // namespace mapscore
