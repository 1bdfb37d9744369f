// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/scan_grid.hpp"
#include "core/localization/occupancy_grid.hpp"
#include "eval/explore/live_belief.hpp"
#include "eval/recording/scan_file.hpp"
#include "eval/results/task_list.hpp"
#include "sim/sensors/lidar.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace mapscore::eval {

/// The lidar of a robot under way, and what it has seen of the floor: turns at each share of a
/// second, cast when somebody asks for the grid, with the noise of faults.lidar. Used by one thread
/// at a time.
class LiveFloor {
 public:
  /// `task` must outlive it. Throws Error as sim::Lidar.
  LiveFloor(const Task& task, const sim::World& world);

  /// When the next turn is due.
  [[nodiscard]] double next_stamp_s() const;
  /// Notes the next turn's place, true and believed.
  void turn(const sim::DriveLog& log, LiveBelief& belief);
  /// Casts the turns that were noted and adds them to the grid.
  void look();
  /// Nobody can pass here, though the lidar sees nothing; frame map, metres.
  void block(const Eigen::Vector2d& p_map) { blocked_.push_back(p_map); }

  /// As the lidar has it, with what blocks as occupied cells.
  [[nodiscard]] OccupancyGrid grid() const;
  /// The exact turns up to a stamp, as a recording has them.
  [[nodiscard]] ScanLog take_scans(double end_s);
  [[nodiscard]] std::vector<sim::StampedPose> poses_until(double end_s) const;

 private:
  const Task& task_;
  sim::LidarSettings settings_;
  sim::Lidar lidar_;
  ScanGrid seen_;
  std::vector<Eigen::Vector2d> blocked_;
  std::vector<sim::StampedPose> poses_;   ///< of all turns
  std::vector<PlanarPose> T_map_base_;    ///< as believed, likewise
  std::vector<sim::LidarRanges> ranges_;  ///< exact, of those that were cast
};

}  // namespace mapscore::eval
