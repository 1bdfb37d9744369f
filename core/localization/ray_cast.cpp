// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/ray_cast.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace mapscore {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Where a ray is on one axis of the lattice; lengths in cells along the ray.
struct Axis {
  Axis(double at, double along, double entry)
      : cell(static_cast<std::int32_t>(std::floor(at + entry * along))),
        step(along > 0 ? 1 : -1),
        per_cell(along == 0 ? kNever : std::abs(1.0 / along)),
        next(along == 0 ? kNever : ((cell + (along > 0 ? 1 : 0)) - at) / along) {}

  std::int32_t cell, step;
  double per_cell, next;  ///< length of a cell; length at which the next cell begins
};

/// Part of the ray within the grid, lengths in cells; empty when last < first.
struct Stretch {
  double first = 0.0, last = 0.0;
};

void clip(double at, double along, double size, Stretch& stretch) {
  if (along == 0) {
    if (at < 0 || at >= size) stretch.last = -kNever;
    return;
  }
  const double low = -at / along, high = (size - at) / along;
  stretch.first = std::max(stretch.first, std::min(low, high));
  stretch.last = std::min(stretch.last, std::max(low, high));
}

/// A rounding error may put the entry just outside.
void pull_in(Axis& axis, double along, double at, std::int32_t size) {
  const std::int32_t inside = std::clamp(axis.cell, 0, size - 1);
  if (inside == axis.cell) return;
  axis.cell = inside;
  if (along != 0) axis.next = ((inside + (along > 0 ? 1 : 0)) - at) / along;
}

}  // namespace

std::optional<double> cast_ray(const OccupancyGrid& grid, const Eigen::Vector2d& from_map,
                               double angle_rad, double range_m) {
  const GridFrame& frame = grid.frame();
  const Eigen::Vector2d from = grid.lattice_point(from_map);
  const double angle = angle_rad - frame.T_map_grid.yaw_rad;
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  Stretch stretch{0.0, range_m / frame.resolution_m};
  clip(from.x(), along.x(), frame.width, stretch);
  clip(from.y(), along.y(), frame.height, stretch);
  if (!(stretch.first <= stretch.last)) return {};

  Axis x(from.x(), along.x(), stretch.first), y(from.y(), along.y(), stretch.first);
  pull_in(x, along.x(), from.x(), frame.width);
  pull_in(y, along.y(), from.y(), frame.height);
  for (double length = stretch.first; length <= stretch.last;) {
    const GridCell cell{x.cell, y.cell};
    if (!grid.contains(cell)) return {};
    if (grid.at(cell) == kOccupiedCell) return length * frame.resolution_m;
    Axis& next = x.next < y.next ? x : y;
    length = next.next;
    next.next += next.per_cell;
    next.cell += next.step;
  }
  return {};
}

}  // namespace mapscore
