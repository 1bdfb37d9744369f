// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/occupancy_grid.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace mapscore {
namespace {

constexpr double kMostCells = 268435456.0;  // 2^28
constexpr double kFarCell = 1073741824.0;   // 2^30

void check(const GridFrame& frame) {
  if (!(std::isfinite(frame.resolution_m) && frame.resolution_m > 0))
    throw Error("resolution_m: is " + std::to_string(frame.resolution_m) +
                "; give the positive edge of a cell in metres");
  const PlanarPose& T = frame.T_map_grid;
  if (!(std::isfinite(T.x_m) && std::isfinite(T.y_m) && std::isfinite(T.yaw_rad)))
    throw Error("origin: is not finite; give x, y in metres and yaw in radians");
  const bool sized = frame.width >= 1 && frame.height >= 1;
  if (!sized || double{1} * frame.width * frame.height > kMostCells)
    throw Error("grid: has " + std::to_string(frame.width) + " x " + std::to_string(frame.height) +
                " cells; give at least one on each axis and at most 2^28 in all");
}

std::int32_t floor_cell(double coordinate) {
  return static_cast<std::int32_t>(std::floor(std::clamp(coordinate, -kFarCell, kFarCell)));
}

constexpr double kNoBorder = std::numeric_limits<double>::infinity();

/// Where a ray is on one axis of the lattice; lengths in cells along the ray.
struct Axis {
  Axis(double at, double along, double entry)
      : cell(static_cast<std::int32_t>(std::floor(at + entry * along))),
        step(along > 0 ? 1 : -1),
        per_cell(along == 0 ? kNoBorder : std::abs(1.0 / along)),
        next(along == 0 ? kNoBorder : ((cell + (along > 0 ? 1 : 0)) - at) / along) {}

  std::int32_t cell, step;
  double per_cell, next;  ///< length of a cell; length at which the next cell begins
};

/// Part of the ray within the grid, lengths in cells; empty when last < first.
struct Stretch {
  double first = 0.0, last = 0.0;
};

void clip(double at, double along, double size, Stretch& stretch) {
  if (along == 0) {
    if (at < 0 || at >= size) stretch.last = -kNoBorder;
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

/// One line at a time: f(q) becomes min over p of f(p) + (q - p)^2.
class LowerEnvelope {
 public:
  explicit LowerEnvelope(std::size_t length) : foot_(length), height_(length), from_(length) {}

  /// `line` holds every stride-th value from `first`.
  void transform(std::int64_t* first, std::size_t length, std::size_t stride) {
    std::size_t count = 0;
    for (std::size_t q = 0; q < length; ++q) {
      if (first[q * stride] == kNoObstacle) continue;
      count = add(static_cast<std::int64_t>(q), first[q * stride], count);
    }
    if (count == 0) return;
    std::size_t k = 0;
    for (std::size_t q = 0; q < length; ++q) {
      while (k + 1 < count && from_[k + 1] < static_cast<double>(q)) ++k;
      const std::int64_t d = static_cast<std::int64_t>(q) - foot_[k];
      first[q * stride] = height_[k] + d * d;
    }
  }

 private:
  /// Adds the parabola with foot q and removes those that it hides. A crossing is the correctly
  /// rounded quotient of whole numbers below 2^53, so it falls on the right side of every cell, and
  /// on a cell only when the two parabolas are equal there.
  std::size_t add(std::int64_t q, std::int64_t height, std::size_t count) {
    double from = -1.0;
    for (; count > 0; --count) {
      const std::int64_t p = foot_[count - 1];
      from = static_cast<double>((height + q * q) - (height_[count - 1] + p * p)) /
             static_cast<double>(2 * (q - p));
      if (count == 1 || from > from_[count - 1]) break;
    }
    foot_[count] = q;
    height_[count] = height;
    from_[count] = from;
    return count + 1;
  }

  std::vector<std::int64_t> foot_, height_;
  std::vector<double> from_;  ///< where a parabola becomes the lowest
};

}  // namespace

OccupancyGrid::OccupancyGrid(const GridFrame& frame, Occupancy fill) : frame_(frame) {
  check(frame);
  cells_.assign(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height),
                fill);
}

Eigen::Vector2d OccupancyGrid::lattice_point(const Eigen::Vector2d& p_map) const {
  const PlanarPose& T = frame_.T_map_grid;
  const double c = std::cos(T.yaw_rad), s = std::sin(T.yaw_rad);
  const double dx = p_map.x() - T.x_m, dy = p_map.y() - T.y_m;
  return Eigen::Vector2d(c * dx + s * dy, c * dy - s * dx) / frame_.resolution_m;
}

GridCell OccupancyGrid::cell_of(const Eigen::Vector2d& p_map) const {
  const Eigen::Vector2d p = lattice_point(p_map);
  return {floor_cell(p.x()), floor_cell(p.y())};
}

Eigen::Vector2d OccupancyGrid::centre_of(const GridCell& cell) const {
  return frame_.T_map_grid * Eigen::Vector2d((cell.column + 0.5) * frame_.resolution_m,
                                             (cell.row + 0.5) * frame_.resolution_m);
}

void flood_free(OccupancyGrid& grid, const GridCell& start) {
  std::vector<GridCell> open;
  const auto take = [&](const GridCell& cell) {
    if (!grid.contains(cell) || grid.at(cell) != kUnknownCell) return;
    grid.set(cell, kFreeCell);
    open.push_back(cell);
  };
  take(start);
  while (!open.empty()) {
    const auto [column, row] = open.back();
    open.pop_back();
    take({column + 1, row});
    take({column - 1, row});
    take({column, row + 1});
    take({column, row - 1});
  }
}

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

std::vector<std::int64_t> squared_distances(const OccupancyGrid& grid) {
  const auto width = static_cast<std::size_t>(grid.frame().width);
  const auto height = static_cast<std::size_t>(grid.frame().height);
  std::vector<std::int64_t> distances(width * height, kNoObstacle);
  for (std::size_t n = 0; n < distances.size(); ++n)
    if (grid.cells()[n] == kOccupiedCell) distances[n] = 0;
  LowerEnvelope columns(height), rows(width);
  for (std::size_t column = 0; column < width; ++column)
    columns.transform(distances.data() + column, height, width);
  for (std::size_t row = 0; row < height; ++row)
    rows.transform(distances.data() + row * width, width, 1);
  return distances;
}

}  // namespace mapscore
