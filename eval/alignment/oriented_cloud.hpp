// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/alignment/surface_points.hpp"

#include <Eigen/Core>
#include <span>
#include <vector>

namespace mapscore::eval {

/// Points of a map with normals.
struct OrientedCloud {
  std::vector<OrientedPoint> points;
  /// From the centres of voxels to the middles of three of their faces, as columns, where the
  /// points are centres of voxels; else zero.
  Eigen::Matrix3d half_edges = Eigen::Matrix3d::Zero();
};

/// Up to `most` points of a map, as they are where they are centres of voxels (most of them have
/// their nearest neighbour at one distance), else the means of cells of edge `cell_m`. With
/// normals: that of the plane through all that lie within 2.6 cells where they lie on one (their
/// least spread is below half of the next), else zero.
[[nodiscard]] OrientedCloud oriented_cloud(std::span<const Eigen::Vector3d> points, double cell_m,
                                           std::size_t most);

/// The unit direction, within 20 degrees of z, that most normals lie along: of floors and table
/// tops; z where none does.
[[nodiscard]] Eigen::Vector3d up_of(std::span<const OrientedPoint> cloud);

/// Up to `most` of the numbers below `count`, ascending, as if drawn at random, always the same.
[[nodiscard]] std::vector<std::size_t> spread_numbers(std::size_t count, std::size_t most);

}  // namespace mapscore::eval
