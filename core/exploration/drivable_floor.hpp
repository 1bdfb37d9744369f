// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/explorer.hpp"
#include "core/exploration/known_space.hpp"
#include "core/localization/occupancy_grid.hpp"

#include <cstdint>
#include <vector>

namespace mapscore {

/// Where the robot can stand and drive, on the lattice of the lidar's grid (docs/exploration.md).
///
/// A cell is *occupied* when the lidar's grid says so, or the map has an obstacle above it: a voxel
/// that is occupied between 5 cm above the floor and the robot's height, with at least five in its
/// column and the eight about it (fewer are noise); but within 12.5 cm of what the lidar sees the
/// lidar is believed, since surfaces that a depth camera sees are thick by its noise. It is *free*
/// when it is not occupied, the lidar saw it free (gaps between beams count as free), and the map
/// knows at least 15 % of the space above it from 0.2 m up to the robot's height; and where the
/// robot stands. All else is *unknown*. A cell is *clear* when the centres of all cells that are
/// not free lie at least the robot's radius and half the diagonal of a cell away, and *narrow* if
/// that leaves less than half a cell more, by which a surface may lie before the centre of its
/// cell. Immutable, safe to share between threads.
class DrivableFloor {
 public:
  /// Whose word is taken for what is free.
  enum class Trust {
    camera_and_lidar,
    /// Alone; and where it sees nothing within the robot's radius, what nobody saw within three
    /// radii counts as free.
    lidar
  };
  /// Throws Error when pose or floor height are not finite.
  DrivableFloor(const ExplorationState& state, const ExploringRobot& robot, const KnownSpace& space,
                Trust trust = Trust::camera_and_lidar);
  /// Of a grid as grid() gives it.
  DrivableFloor(OccupancyGrid grid, const PlanarPose& T_map_base, double radius_m);

  /// Free, occupied, unknown.
  [[nodiscard]] const OccupancyGrid& grid() const { return grid_; }
  /// Whether the robot's centre may be there. Within the robot's radius of where it stands, cells
  /// that are no nearer to something than it is now are clear too: it may leave, never approach.
  [[nodiscard]] bool clear(const GridCell& cell) const {
    return grid_.contains(cell) && clear_[grid_.index(cell)] != 0;
  }
  /// Of a clear cell.
  [[nodiscard]] bool narrow(const GridCell& cell) const {
    return clear_[grid_.index(cell)] == kNarrow;
  }
  /// Distance between the centres of a cell of the grid and the nearest that is not free, in cells,
  /// squared.
  [[nodiscard]] std::int64_t squared_clearance(const GridCell& cell) const {
    return clearance_[grid_.index(cell)];
  }
  /// The cell that the robot stands in; maybe beyond the grid.
  [[nodiscard]] const GridCell& robot_cell() const { return robot_cell_; }
  [[nodiscard]] const PlanarPose& T_map_base() const { return T_map_base_; }
  [[nodiscard]] Trust trust() const { return trust_; }

 private:
  static constexpr std::uint8_t kNarrow = 1, kRoomy = 2;
  void find_clear(double radius_m);

  OccupancyGrid grid_;
  PlanarPose T_map_base_;
  GridCell robot_cell_;
  Trust trust_ = Trust::camera_and_lidar;
  std::vector<std::int64_t> clearance_;
  std::vector<std::uint8_t> clear_;
};

}  // namespace mapscore
