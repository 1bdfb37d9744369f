// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/drivable_floor.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace mapscore {

/// Shortest ways over clear floor from where the robot stands, or another cell, to everywhere: E.
/// W. Dijkstra (1959) on cells with eight neighbours; a diagonal step needs both cells beside it
/// clear, and a step into a narrow cell counts four times. Of ways of equal cost the one whose
/// cells come first by index. Keeps a reference to the floor. Safe to share between threads.
class FloorPaths {
 public:
  explicit FloorPaths(const DrivableFloor& floor) : FloorPaths(floor, floor.robot_cell()) {}
  FloorPaths(const DrivableFloor& floor, const GridCell& start);

  [[nodiscard]] bool reaches(const GridCell& cell) const {
    return floor_.grid().contains(cell) && cost_m_[floor_.grid().index(cell)] < kNoWay;
  }
  /// Length along cells, narrow ones four times; kNoWay where there is none. The grid must contain
  /// the cell.
  [[nodiscard]] double cost_m(const GridCell& cell) const {
    return cost_m_[floor_.grid().index(cell)];
  }
  /// All cells that are reached, by index.
  [[nodiscard]] const std::vector<GridCell>& reached() const { return reached_; }
  /// The way from the robot's place, if that is the start, to a cell that is reached: from the
  /// robot's place by as few straight legs as a greedy
  /// shortcut finds that passes clear cells, and no more narrow ones than the way along cells, to
  /// the cell's centre. Each point but the last faces the next; the last one has the heading that
  /// is asked for. The cell that the robot stands in is its place: then the way only turns.
  [[nodiscard]] std::vector<PlanarPose> way_to(const GridCell& cell, double yaw_rad) const;

  static constexpr double kNoWay = std::numeric_limits<double>::infinity();

 private:
  void search(const GridCell& from);
  /// Narrow cells on a straight leg; nothing where it is not clear.
  [[nodiscard]] std::optional<int> narrow_cells(const Eigen::Vector2d& from,
                                                const Eigen::Vector2d& to) const;

  const DrivableFloor& floor_;
  std::vector<double> cost_m_;
  std::vector<std::int32_t> before_;  ///< index of the cell before; its own at the start
  std::vector<GridCell> reached_;
};

/// Length of a way, metres.
[[nodiscard]] double length_m(const std::vector<PlanarPose>& way);

}  // namespace mapscore
