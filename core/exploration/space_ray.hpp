// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/known_space.hpp"

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>

namespace mapscore {

/// Goes along a ray through the cubes of known space, in order (J. Amanatides and A. Woo,
/// Eurographics 1987), from the one with the origin to the layer beyond the box, which it does not
/// enter, or up to `range_m`. Calls `visit(key, space, from_m, to_m)`, the ray's stretch in the
/// cube, until it says false. `direction` has length 1. A ray from outside the box visits nothing.
inline void walk_ray(const KnownSpace& known, const Eigen::Vector3d& origin,
                     const Eigen::Vector3d& direction, double range_m, auto&& visit) {
  const double edge = known.edge_m();
  VoxelKey key = voxel_of(origin, edge);
  if (known.at(key) == Space::beyond) return;
  std::ptrdiff_t place = known.place_of(key);
  std::array<std::int32_t*, 3> index{&key.i, &key.j, &key.k};
  std::array<std::int32_t, 3> step{};
  std::array<std::ptrdiff_t, 3> move{};
  std::array<double, 3> next{}, per_cube{};
  for (int n = 0; n < 3; ++n) {
    const auto axis = static_cast<std::size_t>(n);
    const double along = direction[n];
    step[axis] = along > 0 ? 1 : -1;
    move[axis] = step[axis] * known.strides()[axis];
    per_cube[axis] = along == 0 ? std::numeric_limits<double>::infinity() : std::abs(edge / along);
    next[axis] = along == 0 ? std::numeric_limits<double>::infinity()
                            : ((*index[axis] + (along > 0 ? 1 : 0)) * edge - origin[n]) / along;
  }
  for (double from_m = 0.0; from_m < range_m;) {
    const std::size_t axis =
        next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const Space space = known.at(place);
    if (space == Space::beyond || !visit(key, space, from_m, next[axis])) return;
    from_m = next[axis];
    next[axis] += per_cube[axis];
    *index[axis] += step[axis];
    place += move[axis];
  }
}

}  // namespace mapscore
