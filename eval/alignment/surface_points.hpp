// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/truth/shapes/shape_tests.hpp"

#include <Eigen/Core>
#include <span>
#include <vector>

namespace mapscore::eval {

/// A point of a surface and its unit normal, of either sign; a zero normal:
/// none is known.
struct OrientedPoint {
  Eigen::Vector3d p, n;
};

/// Points spread over the surfaces, about one in each square of edge
/// `spacing_m` and none inside of another solid; in the pieces' frame, in the
/// order of the cells of this edge that they lie in.
[[nodiscard]] std::vector<OrientedPoint> surface_points(std::span<const PreparedShape> pieces,
                                                        double spacing_m);

/// The spacing at which surface_points gives some millions of points at most, whatever the surfaces
/// are: 5 cm, and more for those of more than a city block's homes.
[[nodiscard]] double bounded_spacing_m(std::span<const PreparedShape> pieces);

/// Keeps the points that lie within a cell of 3 cm, or a cell and its neighbours, of those seen.
void keep_seen(std::vector<OrientedPoint>& points, std::span<const Eigen::Vector3d> seen);

}  // namespace mapscore::eval
