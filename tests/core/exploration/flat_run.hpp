// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/explorer.hpp"
#include "core/exploration/scan_grid.hpp"
#include "core/mapping/semantic_map.hpp"
#include "tests/core/exploration/box_flat.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>
#include <unordered_set>
#include <vector>

namespace mapscore::testing {

/// A robot that explores a flat of boxes: it stands where it believes, sees a frame every 0.3 m and
/// every 26 degrees of its way, and maps it.
class FlatRun {
 public:
  /// What there is to see: voxels.
  using Truth = std::unordered_set<VoxelKey>;

  struct Moment {
    double way_m = 0.0, coverage = 0.0;
  };
  struct Result {
    std::optional<ExplorationEnd> end;  ///< none when the views were used up
    int views = 0, frames = 0;
    double way_m = 0.0;
    double least_clearance_m = 1e9;  ///< of the robot's centre on its way
    double slowest_step_s = 0.0;     ///< processor time of a plan
    std::vector<Moment> moments;     ///< after each frame
    std::vector<PlanarPose> poses;   ///< of the views

    [[nodiscard]] std::optional<double> metres_to(double coverage) const {
      for (const Moment& moment : moments)
        if (moment.coverage >= coverage) return moment.way_m;
      return {};
    }
  };

  FlatRun(const BoxFlat& flat, const PlanarPose& start, double noise = 0.0,
          const Truth* truth = nullptr)
      : flat_(flat),
        robot_(flat_robot()),
        sensors_(flat, robot_, noise),
        map_(0.05, Carving{.carve = true}),
        here_(start),
        truth_(truth) {
    look();
  }

  [[nodiscard]] const Truth& found() const { return found_; }
  [[nodiscard]] ExplorationState state() const {
    return {map_, grid_.grid(), here_, kFlatOrigin.z()};
  }

  Result explore(Explorer& explorer, int most_views) {
    while (result_.views < most_views) {
      const std::clock_t begin = std::clock();
      const ExplorationStep step = explorer.next(state());
      const double took = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
      result_.slowest_step_s = std::max(result_.slowest_step_s, took);
      if (!step.view) {
        result_.end = step.end;
        break;
      }
      ++result_.views;
      result_.poses.push_back(step.view->way.back());
      drive(step.view->way);
    }
    return result_;
  }

  void drive(const std::vector<PlanarPose>& way) {
    for (const PlanarPose& to : way) {
      const Eigen::Vector2d from(here_.x_m, here_.y_m),
          leg = Eigen::Vector2d(to.x_m, to.y_m) - from;
      const double length = leg.norm();
      if (length > 0.02) {
        turn_to(std::atan2(leg.y(), leg.x()));
        const int steps = static_cast<int>(std::ceil(length / 0.3));
        for (int n = 1; n <= steps; ++n) {
          const Eigen::Vector2d at = from + leg * n / steps;
          here_.x_m = at.x(), here_.y_m = at.y();
          result_.way_m += length / steps;
          result_.least_clearance_m =
              std::min(result_.least_clearance_m, flat_.clearance(at, robot_.height_m));
          look();
        }
      }
      turn_to(to.yaw_rad);
    }
  }

 private:
  void turn_to(double yaw_rad) {
    const double turn = wrapped_angle(yaw_rad - here_.yaw_rad);
    const int steps = static_cast<int>(std::ceil(std::abs(turn) / 0.45 - 1e-9));
    const double from = here_.yaw_rad;
    for (int n = 1; n <= steps; ++n) {
      here_.yaw_rad = wrapped_angle(from + turn * n / steps);
      look();
    }
  }

  void look() {
    grid_.add(sensors_.scan(here_), here_);
    const std::vector<Eigen::Vector3d> points = sensors_.points(here_);
    map_.see(sensors_.camera_at(here_), points);
    ++result_.frames;
    if (truth_ == nullptr) return;
    for (const Eigen::Vector3d& point : points) {
      const VoxelKey key = voxel_of(point, 0.05);
      if (truth_->contains(key)) found_.insert(key);
    }
    result_.moments.push_back(
        {result_.way_m, static_cast<double>(found_.size()) / static_cast<double>(truth_->size())});
  }

  const BoxFlat& flat_;
  ExploringRobot robot_;
  FlatSensors sensors_;
  SemanticMap map_;
  ScanGrid grid_;
  PlanarPose here_;
  const Truth* truth_;
  Truth found_;
  Result result_;
};

/// The voxels that are seen without noise from any of a lattice of places that a robot can get to
/// from the start, all around.
inline FlatRun::Truth visible_voxels(const BoxFlat& flat, const PlanarPose& start, double step_m,
                                     int headings) {
  const ExploringRobot robot = flat_robot();
  const GridFrame frame{0.1,
                        {},
                        static_cast<std::int32_t>(flat.size_m.x() / 0.1),
                        static_cast<std::int32_t>(flat.size_m.y() / 0.1)};
  OccupancyGrid grid(frame, kOccupiedCell);
  for (GridCell cell; cell.row < frame.height; ++cell.row)
    for (cell.column = 0; cell.column < frame.width; ++cell.column)
      if (flat.clearance(grid.centre_of(cell), robot.height_m) > robot.radius_m)
        grid.set(cell, kUnknownCell);
  flood_free(grid, grid.cell_of({start.x_m, start.y_m}));
  FlatSensors sensors(flat, robot);
  FlatRun::Truth voxels;
  const auto every = static_cast<std::int32_t>(std::lround(step_m / 0.1));
  for (GridCell cell; cell.row < frame.height; cell.row += every)
    for (cell.column = 0; cell.column < frame.width; cell.column += every) {
      if (grid.at(cell) != kFreeCell) continue;
      const Eigen::Vector2d p = grid.centre_of(cell);
      for (int n = 0; n < headings; ++n)
        for (const Eigen::Vector3d& point :
             sensors.points({p.x(), p.y(), n * 2.0 * std::numbers::pi / headings}))
          voxels.insert(voxel_of(point, 0.05));
    }
  return voxels;
}

}  // namespace mapscore::testing
