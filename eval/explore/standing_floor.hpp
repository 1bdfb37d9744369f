// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/planar_pose.hpp"
#include "sim/robot/drive_model.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore::eval {

/// Where a robot can stand in a scene: the places of a lattice of kStepM about the world's origin
/// where nothing lies within its clearance and both wheels have floor (sim::Clearance), and so
/// within `room` steps of the lattice along both axes. It is probed at heading 0 as for a round
/// robot. Immutable, safe to share between threads.
class StandingFloor {
 public:
  static constexpr double kStepM = 0.05;

  /// Probes the places within `bounds` (world, metres), on a coarser lattice where they would be
  /// more than a million.
  StandingFloor(const sim::DriveModel& drive, const Eigen::AlignedBox2d& bounds);

  /// The same floor with room to each side.
  [[nodiscard]] StandingFloor with_room(std::size_t steps) const;

  [[nodiscard]] double step_m() const { return step_m_; }
  /// Places that a way along edges of the lattice connects with the nearest one to `start` within
  /// two steps of it; in the order of the lattice. Empty where there is none.
  [[nodiscard]] std::vector<Eigen::Vector2d> connected_to(const Eigen::Vector2d& start) const;
  /// The largest connected part; of equal ones the first. Empty where the robot can stand nowhere.
  [[nodiscard]] std::vector<Eigen::Vector2d> largest() const;
  /// Those of a list of places that lie on the lattice of a greater step, a multiple of step_m():
  /// all of them where fewer than `least` do.
  [[nodiscard]] std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& places,
                                                     double step_m, std::size_t least) const;

 private:
  [[nodiscard]] Eigen::Vector2d place(std::size_t cell) const;
  void label_parts();
  [[nodiscard]] std::vector<Eigen::Vector2d> part(std::int32_t number) const;

  double step_m_ = kStepM;
  std::int64_t first_column_ = 0, first_row_ = 0;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::int32_t> part_of_;    ///< by cell; 0: no place, or its part's number from 1
  std::vector<std::size_t> part_sizes_;  ///< by number; of 0: 0
};

/// Radius and height of the upright cylinder about base_footprint that holds all of the robot that
/// bumps, without clearance.
struct RobotExtent {
  double radius_m = 0.0, height_m = 0.0;
};
[[nodiscard]] RobotExtent extent_of(const sim::DriveModel& drive);

}  // namespace mapscore::eval
