// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/exploration/planners.hpp"

#include <cmath>
#include <cstddef>
#include <string>

namespace mapscore {
namespace {

/// A robot as far from a waypoint as this has not reached it.
constexpr double kReached_m = 0.2;

class DrawnWaypointsExplorer : public Explorer {
 public:
  explicit DrawnWaypointsExplorer(const DrawnWaypoints& params) : params_(params) {
    for (const PlanarPose& T : params_.T_map_waypoints)
      if (!(std::isfinite(T.x_m) && std::isfinite(T.y_m) && std::isfinite(T.yaw_rad)))
        throw Error("waypoints: one is not finite; give x, y in metres and a heading");
  }

  ExplorationStep next(const ExplorationState& state) override {
    ExplorationStep step;
    const auto way_m = [&](const PlanarPose& to) {
      return std::hypot(to.x_m - state.T_map_base.x_m, to.y_m - state.T_map_base.y_m);
    };
    if (next_ > 0 && way_m(params_.T_map_waypoints[next_ - 1]) > kReached_m) ++missed_;
    step.reason = missed_ == 0
                      ? "all waypoints were driven to"
                      : "all waypoints were driven to, but " + std::to_string(missed_) + " of " +
                            std::to_string(params_.T_map_waypoints.size()) + " not reached";
    if (next_ == params_.T_map_waypoints.size()) return step;
    const PlanarPose& to = params_.T_map_waypoints[next_++];
    NextView view;
    view.way = {state.T_map_base, to};
    view.way_m = way_m(to);
    step.view = view;
    return step;
  }

 private:
  DrawnWaypoints params_;
  std::size_t next_ = 0;
  int missed_ = 0;  ///< waypoints that something stood before
};

}  // namespace

std::unique_ptr<Explorer> make(const DrawnWaypoints& params, const ExploringRobot&, std::uint64_t) {
  return std::make_unique<DrawnWaypointsExplorer>(params);
}

}  // namespace mapscore
