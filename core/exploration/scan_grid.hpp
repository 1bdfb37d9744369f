// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/occupancy_grid.hpp"
#include "core/localization/scan_likelihood.hpp"

#include <cstdint>
#include <vector>

namespace mapscore {

/// What a lidar has seen of the floor so far, as an occupancy grid that grows. A turn of the lidar
/// changes each cell once: a cell that a beam ends in is hit, one that beams only pass is missed
/// (exact traversal, Amanatides and Woo 1987). Hits and misses are counted as log-odds with
/// OctoMap's probabilities (OccupancyModel); cells of 0 and more are occupied, others free. A beam
/// that hit nothing says nothing: black things and glass give the same. Used by one thread at a
/// time.
class ScanGrid {
 public:
  /// The lattice is the map's: a cell's low corner is a multiple of the resolution. Throws Error
  /// unless it is positive.
  explicit ScanGrid(double resolution_m = 0.05);

  /// Throws Error where the pose is not finite or farther than 1 km from the map's origin, or the
  /// scan's numbers are not usable.
  void add(const LaserScan& scan, const PlanarPose& T_map_base);

  /// One unknown cell before the first turn.
  [[nodiscard]] const OccupancyGrid& grid() const { return grid_; }

 private:
  void grow_to(const Eigen::Vector2d& low_m, const Eigen::Vector2d& high_m);
  void count_turn();

  OccupancyGrid grid_;
  std::vector<float> log_odds_;      ///< of cells that are known
  std::vector<std::uint8_t> marks_;  ///< what the present turn says of a cell
};

}  // namespace mapscore
