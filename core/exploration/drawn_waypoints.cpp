// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/exploration/planners.hpp"

#include <cmath>
#include <cstddef>

namespace mapscore {
namespace {

class DrawnWaypointsExplorer : public Explorer {
 public:
  explicit DrawnWaypointsExplorer(const DrawnWaypoints& params) : params_(params) {
    for (const PlanarPose& T : params_.T_map_waypoints)
      if (!(std::isfinite(T.x_m) && std::isfinite(T.y_m) && std::isfinite(T.yaw_rad)))
        throw Error("waypoints: one is not finite; give x, y in metres and a heading");
  }

  ExplorationStep next(const ExplorationState& state) override {
    ExplorationStep step;
    step.reason = "all waypoints were driven to";
    if (next_ == params_.T_map_waypoints.size()) return step;
    const PlanarPose& to = params_.T_map_waypoints[next_++];
    NextView view;
    view.way = {state.T_map_base, to};
    view.way_m = std::hypot(to.x_m - state.T_map_base.x_m, to.y_m - state.T_map_base.y_m);
    step.view = view;
    return step;
  }

 private:
  DrawnWaypoints params_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<Explorer> make(const DrawnWaypoints& params, const ExploringRobot&, std::uint64_t) {
  return std::make_unique<DrawnWaypointsExplorer>(params);
}

}  // namespace mapscore
