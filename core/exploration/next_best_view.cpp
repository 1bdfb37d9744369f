// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/frontiers.hpp"
#include "core/exploration/planners.hpp"
#include "core/exploration/surroundings.hpp"
#include "core/exploration/view_search.hpp"

namespace mapscore {
namespace {

constexpr double kLeastFrontier_m = 0.3;  ///< of those that are shown

class NextBestViewExplorer : public Explorer {
 public:
  NextBestViewExplorer(const NextBestView& params, const ExploringRobot& robot)
      : params_(params), robot_(robot), search_(params, robot) {}

  ExplorationStep next(const ExplorationState& state) override {
    const Surroundings now(state, robot_, params_.unsure_below);
    search_.look(state, now);
    ExplorationStep step;
    step.frontiers = find_frontiers(now.floor.grid(), kLeastFrontier_m);
    const std::vector<Prospect> prospects = search_.prospects(state, now);
    if (prospects.empty())
      step.end = search_.end_without_prospect(state, now);
    else
      step.view = view_of(best(prospects), now);
    return step;
  }

 private:
  [[nodiscard]] double utility(const Prospect& prospect) const {
    return prospect.all.worth(params_.unsure_weight) / (prospect.place.way_m + params_.view_cost_m);
  }

  /// Turning takes no metres: all that is worth it is looked at before the robot drives on.
  [[nodiscard]] const Prospect& best(const std::vector<Prospect>& prospects) const {
    const Prospect* best = &prospects.front();
    if (best->place.way_m == 0.0) return *best;
    for (const Prospect& prospect : prospects)
      if (utility(prospect) > utility(*best)) best = &prospect;
    return *best;
  }

  static NextView view_of(const Prospect& prospect, const Surroundings& now) {
    NextView view = now.view(prospect.place.cell, prospect.yaw_rad);
    view.unknown_voxels = prospect.view.unknown;
    view.unsure_voxels = prospect.view.unsure;
    return view;
  }

  NextBestView params_;
  ExploringRobot robot_;
  ViewSearch search_;
};

}  // namespace

std::unique_ptr<Explorer> make(const NextBestView& params, const ExploringRobot& robot,
                               std::uint64_t) {
  return std::make_unique<NextBestViewExplorer>(params, robot);
}

}  // namespace mapscore
