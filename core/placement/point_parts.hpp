// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/placement/observation.hpp"

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mapscore {

/// Some points of one object.
struct PointPart {
  std::uint32_t object = 0;                 ///< its place in the observation
  std::span<const Eigen::Vector3d> points;  ///< sensor frame, metres
};

/// The points of an observation, which must outlive it, by parts. Can be moved, not copied.
struct PointParts {
  std::vector<PointPart> small;            ///< each within half a voxel
  std::vector<Eigen::AlignedBox3d> boxes;  ///< of the small ones: bounds of `to_voxels` p
  std::vector<PointPart> loose;            ///< all other points

  std::vector<std::vector<Eigen::Vector3d>> sorted;  ///< by object, what the small ones refer to

  PointParts() = default;
  PointParts(PointParts&&) = default;
  PointParts& operator=(PointParts&&) = default;
};

/// Sorts points into cubes of half a voxel, on a lattice with the coordinates `to_voxels` p for a
/// position p. Objects stay whole and loose where sorting would cost more than it saves in so many
/// draws; so do points, one by one, that are not finite or beyond +-2^15 voxels. Thread-safe.
[[nodiscard]] PointParts sort_into_parts(const Observation& observation,
                                         const Eigen::Matrix3d& to_voxels, std::size_t draws);

}  // namespace mapscore
