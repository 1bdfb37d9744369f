// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/planar_pose.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace mapscore {

/// One cell of a 2D grid. Cell (column, row) covers [column r, (column + 1) r) x [row r, (row + 1)
/// r) in the grid's frame, r the resolution; its position is its centre.
struct GridCell {
  std::int32_t column = 0, row = 0;
  bool operator==(const GridCell&) const = default;
};

/// How the lattice of a grid lies in the map: its low corner at T_map_grid, as ROS has it.
struct GridFrame {
  double resolution_m = 0.05;  ///< edge of a cell
  PlanarPose T_map_grid;
  std::int32_t width = 1, height = 1;  ///< cells along x and y of the grid's frame
  bool operator==(const GridFrame&) const = default;
};

/// What is known of a cell, as nav_msgs/OccupancyGrid has it: the probability that it is occupied
/// in percent, or -1. Localisation takes 100 for occupied, 0 for free, and all else for unknown.
using Occupancy = std::int8_t;
inline constexpr Occupancy kFreeCell = 0, kOccupiedCell = 100, kUnknownCell = -1;

/// 2D occupancy grid in the frame `map`, row-major, row 0 at the least y. Safe to share between
/// threads while nobody sets cells.
class OccupancyGrid {
 public:
  /// All cells at `fill`. Throws Error when the frame is not finite, the resolution not positive,
  /// or the grid is empty or has more than 2^28 cells.
  explicit OccupancyGrid(const GridFrame& frame, Occupancy fill = kUnknownCell);

  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  [[nodiscard]] bool contains(const GridCell& cell) const {
    return cell.column >= 0 && cell.column < frame_.width && cell.row >= 0 &&
           cell.row < frame_.height;
  }
  /// Position in `cells()` of a cell that the grid contains.
  [[nodiscard]] std::size_t index(const GridCell& cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(frame_.width) +
           static_cast<std::size_t>(cell.column);
  }
  /// The grid must contain the cell.
  [[nodiscard]] Occupancy at(const GridCell& cell) const { return cells_[index(cell)]; }
  /// The grid must contain the cell; `value` is -1 or 0 to 100.
  void set(const GridCell& cell, Occupancy value) { cells_[index(cell)] = value; }
  /// Cells beyond the grid are unknown.
  [[nodiscard]] Occupancy at_or_unknown(const GridCell& cell) const {
    return contains(cell) ? at(cell) : kUnknownCell;
  }
  [[nodiscard]] const std::vector<Occupancy>& cells() const { return cells_; }

  /// Coordinates in cells: (column, row) of the low corner of a cell is whole.
  [[nodiscard]] Eigen::Vector2d lattice_point(const Eigen::Vector2d& p_map) const;
  /// The cell, of the grid or beyond, that holds a point of the map. Points farther than 2^30 cells
  /// end at that cell.
  [[nodiscard]] GridCell cell_of(const Eigen::Vector2d& p_map) const;
  /// Centre of a cell in the map, metres.
  [[nodiscard]] Eigen::Vector2d centre_of(const GridCell& cell) const;

  bool operator==(const OccupancyGrid&) const = default;

 private:
  GridFrame frame_;
  std::vector<Occupancy> cells_;
};

/// Flood fill: all unknown cells that are connected to `start` through edges become free. Does
/// nothing unless `start` is an unknown cell of the grid.
void flood_free(OccupancyGrid& grid, const GridCell& start);

/// Distance in metres along a ray to where it enters the first occupied cell, 0 from inside one;
/// nothing when there is none within `range_m`. Visits every cell that the ray passes through, in
/// order (J. Amanatides and A. Woo, A Fast Voxel Traversal Algorithm for Ray Tracing, Eurographics
/// 1987); a ray through a corner enters the diagonal cell by way of its neighbour along y. Unknown
/// cells and the space beyond the grid are passed through.
[[nodiscard]] std::optional<double> cast_ray(const OccupancyGrid& grid,
                                             const Eigen::Vector2d& from_map, double angle_rad,
                                             double range_m);

/// Squared distance of a cell when no cell is occupied.
inline constexpr std::int64_t kNoObstacle = std::numeric_limits<std::int64_t>::max();

/// Squared distance in cells from each cell's centre to that of the nearest occupied cell, exact;
/// in the order of `grid.cells()`. Lower envelopes of parabolas, columns then rows: P. Felzenszwalb
/// and D. Huttenlocher, Distance Transforms of Sampled Functions, Theory of Computing 8 (2012).
/// Time is linear in the number of cells.
[[nodiscard]] std::vector<std::int64_t> squared_distances(const OccupancyGrid& grid);

}  // namespace mapscore
