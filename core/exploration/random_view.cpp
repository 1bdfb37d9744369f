// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/frontiers.hpp"
#include "core/exploration/planners.hpp"
#include "core/exploration/surroundings.hpp"
#include "core/exploration/view_search.hpp"
#include "core/random_stream.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace mapscore {
namespace {

class RandomViewExplorer : public Explorer {
 public:
  RandomViewExplorer(const ExploringRobot& robot, std::uint64_t seed)
      : robot_(robot), search_({}, robot), stream_(seed, "exploration") {}

  ExplorationStep next(const ExplorationState& state) override {
    const Surroundings now(state, robot_, 0.0);
    search_.look(state, now);
    ExplorationStep step;
    step.frontiers = find_frontiers(now.floor.grid(), 0.3);
    if (std::exchange(first_, false)) {
      step.view = now.turn_on_the_spot();
      return step;
    }
    if (!search_.any_prospect(state, now)) {
      search_.look_once_more(state, now, step);
      return step;
    }
    const auto& reached = now.paths.reached();
    const auto drawn =
        static_cast<std::size_t>(stream_.uniform() * static_cast<double>(reached.size()));
    const double yaw = 2.0 * std::numbers::pi * stream_.uniform();
    step.view = now.view(reached.empty() ? now.floor.robot_cell() : reached[drawn], yaw);
    return step;
  }

 private:
  ExploringRobot robot_;
  ViewSearch search_;  ///< for the end alone
  RandomStream stream_;
  bool first_ = true;
};

}  // namespace

std::unique_ptr<Explorer> make(const RandomView&, const ExploringRobot& robot, std::uint64_t seed) {
  return std::make_unique<RandomViewExplorer>(robot, seed);
}

}  // namespace mapscore
