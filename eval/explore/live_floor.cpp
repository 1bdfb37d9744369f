// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#ifdef MAPSCORE_SIMULATOR

#include "eval/explore/live_floor.hpp"

#include "eval/render/study_drive.hpp"
#include "sim/faults/lidar_noise.hpp"
#include "sim/robot/drive_simulation.hpp"

#include <algorithm>
#include <utility>

namespace mapscore::eval {

LiveFloor::LiveFloor(const Task& task, const sim::World& world)
    : task_(task),
      settings_(lidar_settings(task.config)),
      lidar_(world, settings_),
      seen_(task.config.exploration.floor_cell_m) {}

double LiveFloor::next_stamp_s() const {
  return static_cast<double>(poses_.size()) / task_.config.lidar.scans_per_s;
}

void LiveFloor::turn(const sim::DriveLog& log, LiveBelief& belief) {
  const double stamp_s = next_stamp_s();
  poses_.push_back({stamp_s, sim::pose_at(log, stamp_s)});
  T_map_base_.push_back(planar(belief.mean_at(log, stamp_s)));
}

void LiveFloor::look() {
  const std::size_t first = ranges_.size();
  const std::vector<sim::StampedPose> due(poses_.begin() + static_cast<std::ptrdiff_t>(first),
                                          poses_.end());
  const sim::LidarNoise noise = task_.config.faults.lidar.dose();
  for (sim::LidarRanges& exact : lidar_.scans(due, 1)) {
    const std::size_t turn = ranges_.size();
    LaserScan scan{planar(lidar_.T_base_lidar()),
                   settings_.first_angle_rad,
                   lidar_.angle_step_rad(),
                   std::max(settings_.range_min_m, noise.range_min_m),
                   std::min(settings_.range_max_m, noise.range_max_m),
                   exact};
    sim::add_lidar_noise(noise, trial_seed(task_), turn, scan.ranges_m);
    seen_.add(scan, T_map_base_[turn]);
    ranges_.push_back(std::move(exact));
  }
}

OccupancyGrid LiveFloor::grid() const {
  OccupancyGrid grid = seen_.grid();
  for (const Eigen::Vector2d& p_map : blocked_)
    if (const GridCell cell = grid.cell_of(p_map); grid.contains(cell))
      grid.set(cell, kOccupiedCell);
  return grid;
}

std::vector<sim::StampedPose> LiveFloor::poses_until(double end_s) const {
  std::vector<sim::StampedPose> poses = poses_;
  std::erase_if(poses, [end_s](const auto& pose) { return pose.stamp_s > end_s; });
  return poses;
}

ScanLog LiveFloor::take_scans(double end_s) {
  look();
  ScanLog scans{scan_geometry(settings_, lidar_), {}};
  for (std::size_t n = 0; n < poses_.size() && poses_[n].stamp_s <= end_s; ++n)
    scans.scans.push_back({poses_[n].stamp_s, std::move(ranges_[n])});
  return scans;
}

}  // namespace mapscore::eval

#endif
