// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/known_space.hpp"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace mapscore {

/// Goes along a ray through the cubes of known space, in order (J. Amanatides and A. Woo,
/// Eurographics 1987), from the one with the origin to the layer beyond the box, which it does not
/// enter, or up to `range_m`. Calls `visit(key, space, from_m, to_m)`, the ray's stretch in the
/// cube, until it says false. `direction` has length 1. A ray from outside the box visits nothing.
inline void walk_ray(const KnownSpace& known, const Eigen::Vector3d& origin,
                     const Eigen::Vector3d& direction, double range_m, auto&& visit) {
  struct Axis {
    std::int32_t step;
    std::ptrdiff_t move;
    double next, per_cube;
  };
  const double edge = known.edge_m();
  VoxelKey key = voxel_of(origin, edge);
  if (known.at(key) == Space::beyond) return;
  const auto axis = [&](int n, std::int32_t index) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const double along = direction[n];
    const std::int32_t step = along > 0 ? 1 : -1;
    const std::ptrdiff_t move = step * known.strides()[static_cast<std::size_t>(n)];
    if (along == 0) return Axis{step, move, kNever, kNever};
    const double border = (index + (along > 0 ? 1 : 0)) * edge;
    return Axis{step, move, (border - origin[n]) / along, std::abs(edge / along)};
  };
  Axis x = axis(0, key.i), y = axis(1, key.j), z = axis(2, key.k);
  std::ptrdiff_t place = known.place_of(key);
  for (double from_m = 0.0; from_m < range_m;) {
    const Space space = known.at(place);
    if (space == Space::beyond) return;
    // Without branches, which no processor would foresee.
    const bool x_first = x.next < y.next && x.next < z.next;
    const bool y_first = !x_first && y.next < z.next;
    const bool z_first = !x_first && !y_first;
    const double to_m = x_first ? x.next : y_first ? y.next : z.next;
    if (!visit(key, space, from_m, to_m)) return;
    from_m = to_m;
    place += x_first ? x.move : y_first ? y.move : z.move;
    key.i += x_first ? x.step : 0;
    key.j += y_first ? y.step : 0;
    key.k += z_first ? z.step : 0;
    x.next += x_first ? x.per_cube : 0.0;
    y.next += y_first ? y.per_cube : 0.0;
    z.next += z_first ? z.per_cube : 0.0;
  }
}

}  // namespace mapscore
