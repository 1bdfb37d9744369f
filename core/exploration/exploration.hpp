// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/explorer.hpp"
#include "core/parameters.hpp"

#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

namespace mapscore {

// Who decides where an exploring robot looks next (docs/exploration.md). A kind is a struct of its
// parameters.

/// The view that shows most unseen surface for its way.
struct NextBestView {
  static constexpr std::string_view kKind = "next_best_view";
  static constexpr std::string_view kMeaning = "the view that shows most for its way";
  double place_step_m = 0.5;  ///< between places that are tried
  Degrees heading_step{15}, ray_step{3};
  double surface_per_m = 1.5;  ///< chance per metre that a ray in unknown space meets surface
  double view_cost_m = 0.5;    ///< what a view costs besides its way
  double turn_cost_m_per_rad = 0.05;
  double least_voxels = 40;  ///< views that show less are not worth it
  double unsure_below = 0.6, unsure_weight = 0.01;

  static void fields(auto& s, auto&& visit) {
    visit(s.place_step_m, Field{"place_step_m", "between places that are tried", {0.1, 2}});
    visit(s.heading_step, Field{"heading_step_deg", "between headings that are tried", {5, 60}});
    visit(s.ray_step, Field{"ray_step_deg", "between rays of a view", {1, 10}});
    visit(s.surface_per_m,
          Field{"surface_per_m", "rate at which a ray in unknown space meets surface",
                above(0, 100)});
    visit(s.view_cost_m, Field{"view_cost_m", "what a view costs besides its way", above(0, 100)});
    visit(s.turn_cost_m_per_rad, Field{"turn_cost_m_per_rad", "what a turn costs", {0, 100}});
    visit(s.least_voxels,
          Field{"least_voxels", "views that show less are not worth it", above(0, 1e9)});
    visit(s.unsure_below,
          Field{"unsure_below", "a class is uncertain whose probability is below", {0, 1}});
    visit(s.unsure_weight, Field{"unsure_weight",
                                 "what a voxel of uncertain class counts, in unknown voxels",
                                 {0, 100}});
  }
  bool operator==(const NextBestView&) const = default;
};

/// To the nearest border of the known floor, to look beyond it (B. Yamauchi, CIRA 1997); where the
/// floor has none left, to the nearest place with a view that NextBestView would find worth it.
struct NearestFrontier {
  static constexpr std::string_view kKind = "nearest_frontier";
  static constexpr std::string_view kMeaning = "the nearest border of the known floor";
  double least_m = 0.3;  ///< length of a frontier

  static void fields(auto& s, auto&& visit) {
    visit(s.least_m, Field{"least_m", "frontiers shorter than this are left", {0, 100}});
  }
  bool operator==(const NearestFrontier&) const = default;
};

/// A free place that can be reached and a heading, both drawn.
struct RandomView {
  static constexpr std::string_view kKind = "random";
  static constexpr std::string_view kMeaning = "a free place and a heading, both drawn";

  static void fields(auto&, auto&&) {}
  bool operator==(const RandomView&) const = default;
};

/// Up and down in parallel lanes over the floor as far as it is known.
struct LawnMower {
  static constexpr std::string_view kKind = "lawn_mower";
  static constexpr std::string_view kMeaning = "parallel lanes, up and down";
  double lane_m = 1.0;  ///< between lanes

  static void fields(auto& s, auto&& visit) {
    visit(s.lane_m, Field{"lane_m", "between lanes", {0.1, 10}});
  }
  bool operator==(const LawnMower&) const = default;
};

/// The waypoints that a person has drawn, in their order, straight from one to the next.
struct DrawnWaypoints {
  static constexpr std::string_view kKind = "waypoints";
  static constexpr std::string_view kMeaning = "the home's drawn waypoints";
  std::vector<PlanarPose> T_map_waypoints;  ///< set by who knows them

  static void fields(auto&, auto&&) {}
  bool operator==(const DrawnWaypoints&) const = default;
};

using Exploration =
    std::variant<NextBestView, NearestFrontier, RandomView, LawnMower, DrawnWaypoints>;

/// `seed`: of what is drawn. Throws Error when a parameter or the robot is out of range.
[[nodiscard]] std::unique_ptr<Explorer> make_explorer(const Exploration& exploration,
                                                      const ExploringRobot& robot,
                                                      std::uint64_t seed);

}  // namespace mapscore
