// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/edge_aligned/edge_matching.hpp"
#include "core/segmentation/edge_aligned/matched_edges.hpp"

#include <Eigen/Core>

namespace mapscore {

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

/// Adds up edges, moved and matched in whole groups (EdgeColumns::kTogether), in as many lanes, and
/// these at last, in order. `project`: the one that matched
/// them; `focal_px`: of the believed colour camera, in which parameters are counted.
[[nodiscard]] NormalEquations add_up(const MatchedEdges& edges, const Projection& project,
                                     float focal_px);

}  // namespace mapscore
