// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/frontiers.hpp"
#include "core/exploration/planners.hpp"
#include "core/exploration/stop_order.hpp"
#include "core/exploration/surroundings.hpp"
#include "core/exploration/view_search.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace mapscore {
namespace {

constexpr std::size_t kStops = 8;         ///< planned ahead, at most
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
      search_.look_once_more(state, now, step);
    else
      step.view = view_of(best(prospects, now), now);
    return step;
  }

 private:
  /// Turning takes no metres: all that is worth it is looked at before the robot drives on, to the
  /// first of the stops that together show all that can be seen.
  [[nodiscard]] const Prospect& best(const std::vector<Prospect>& prospects,
                                     const Surroundings& now) const {
    if (prospects.front().place.way_m == 0.0) return prospects.front();
    const auto [chosen, stops] = stops_of(prospects, now);
    return prospects[chosen[soonest_order(stops).front()]];
  }

  /// One prospect after the other: the one that adds most to those before for its way.
  [[nodiscard]] std::pair<std::vector<std::size_t>, Stops> stops_of(
      const std::vector<Prospect>& prospects, const Surroundings& now) const {
    std::vector<std::size_t> chosen;
    Stops stops;
    SeenBlocks seen;
    while (chosen.size() < std::min(kStops, prospects.size())) {
      std::size_t best = 0;
      double best_rate = 0.0, best_worth = 0.0;
      for (std::size_t n = 0; n < prospects.size(); ++n) {
        const double worth = seen.added_by(prospects[n]);
        const double rate = worth / (prospects[n].place.way_m + params_.view_cost_m);
        if (worth >= params_.least_voxels && rate > best_rate)
          best = n, best_rate = rate, best_worth = worth;
      }
      if (best_rate == 0.0) {
        if (!chosen.empty()) break;
        best_worth = seen.added_by(prospects[best]);
      }
      seen.add(prospects[best]);
      chosen.push_back(best);
      stops.worth.push_back(best_worth);
      stops.way_m.push_back(prospects[best].place.way_m + params_.view_cost_m);
    }
    for (const std::size_t from : chosen) {
      const FloorPaths paths(now.floor, prospects[from].place.cell);
      std::vector<double>& between_m = stops.between_m.emplace_back();
      for (const std::size_t to : chosen)
        between_m.push_back(paths.cost_m(prospects[to].place.cell) + params_.view_cost_m);
    }
    return {chosen, stops};
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
