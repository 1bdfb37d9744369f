// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/localization/occupancy_grid.hpp"
#include "core/localization/planar_pose.hpp"
#include "core/mapping/semantic_map.hpp"

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore {

/// What a planner needs to know of the robot that explores.
struct ExploringRobot {
  double radius_m = 0.25;  ///< of the upright cylinder that it needs room for, clearance included
  double height_m = 1.3;
  Calibration cameras;  ///< as the robot believes them; the depth camera sees
};

/// A point to be looked at again, such as an object that should have been seen and was missed [N].
struct LookAgain {
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();  ///< metres
  double priority_voxels = 1.0;  ///< what a first look at it is worth, in unknown voxels
};

/// What the robot knows when it decides where to look next, in frame map. The references must stay
/// valid during the call only.
struct ExplorationState {
  const SemanticMap& map;             ///< carved
  const OccupancyGrid& floor;         ///< what the lidar has seen so far (ScanGrid)
  PlanarPose T_map_base;              ///< where the robot believes it stands
  double floor_m = 0.0;               ///< height of the floor in frame map, z of the base
  std::vector<LookAgain> again = {};  ///< what else is worth a look
};

/// A connected piece of the border between free floor and floor that nobody has seen.
struct Frontier {
  std::vector<GridCell> cells;  ///< free cells with an unknown neighbour
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
};

/// Why an exploration ends.
enum class ExplorationEnd {
  explored,           ///< no view is left that shows enough that is new, or all lanes are driven
  nothing_reachable,  ///< something is left to be seen, from no place that the robot can get to
  budget              ///< metres, seconds or views are used up
};
constexpr auto names_of(ExplorationEnd) {
  return std::to_array<std::string_view>({"explored", "nothing_reachable", "budget"});
}

/// The next place to look from.
struct NextView {
  std::vector<PlanarPose> way;  ///< from the robot's place to the view's, both included
  double way_m = 0.0;
  double unknown_voxels = 0.0;  ///< that the view is expected to see
  double unsure_voxels = 0.0;   ///< expected semantic gain: voxels in view whose class is uncertain
};

/// What a planner decided: a view, or why there is none.
struct ExplorationStep {
  std::optional<NextView> view;
  ExplorationEnd end = ExplorationEnd::explored;  ///< where there is no view
  std::string reason;  ///< why, of a planner that does not look for what is new
  std::vector<Frontier> frontiers;
};

/// Decides where an exploring robot looks next. Used by one thread at a time. The same states in
/// the same order give the same views.
class Explorer {
 public:
  Explorer() = default;
  Explorer(const Explorer&) = delete;
  Explorer& operator=(const Explorer&) = delete;
  virtual ~Explorer() = default;

  /// Throws Error when the map does not carve, or pose or floor height are not finite.
  [[nodiscard]] virtual ExplorationStep next(const ExplorationState& state) = 0;
};

}  // namespace mapscore
