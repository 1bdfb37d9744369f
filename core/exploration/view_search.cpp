// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/view_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mapscore {
namespace {

constexpr double kSamePlace_m = 0.2;   ///< views from nearer to each other are from the same place
constexpr double kSameBarred_m = 1.0;  ///< places out of reach that one look is for

}  // namespace

ViewSearch::ViewSearch(const NextBestView& params, const ExploringRobot& robot)
    : params_(params),
      gain_(robot.cameras, params.ray_step.rad(), params.heading_step.rad(), params.surface_per_m) {
}

double SeenBlocks::added_by(const Prospect& prospect) const {
  double added = prospect.worth;
  for (const BlockGain& gain : prospect.blocks)
    if (const auto found = seen_.find(gain.block); found != seen_.end())
      added -= std::min(gain.unknown, found->second);
  return added;
}

void SeenBlocks::add(const Prospect& prospect) {
  for (const BlockGain& gain : prospect.blocks) {
    double& seen = seen_[gain.block];
    seen = std::max(seen, gain.unknown);
  }
}

void ViewSearch::look(const ExplorationState& state, const Surroundings& now) {
  // Before the first decision nobody has looked anywhere on purpose.
  if (!std::exchange(looked_, true)) return;
  gain_.remember(now.space, state.T_map_base, state.floor_m, state.again, memory_);
  views_.push_back(state.T_map_base);
}

ViewGain::Scene ViewSearch::scene_of(const ExplorationState& state, const Surroundings& now) const {
  ViewGain::Scene scene{now.space,
                        state.map.edge_m(),
                        state.floor_m,
                        {memory_, Looked::unknown, now.space},
                        {memory_, Looked::unsure, now.space},
                        state.again};
  for (LookAgain& point : scene.again)
    point.priority_voxels *= memory_.worth(
        Looked::again, LookMemory::block_of(voxel_of(point.p_map, now.space.edge_m())));
  return scene;
}

std::vector<double> ViewSearch::headings_taken_at(const Lookout& place) const {
  std::vector<double> headings;
  for (const PlanarPose& view : views_)
    if ((Eigen::Vector2d(view.x_m, view.y_m) - place.p_map).norm() < kSamePlace_m)
      headings.push_back(view.yaw_rad);
  return headings;
}

std::optional<Prospect> ViewSearch::prospect(const ViewGain::Scene& scene, const Lookout& place,
                                             double yaw_rad) const {
  Panorama panorama = gain_.look_around(scene, place.p_map, headings_taken_at(place));
  std::optional<Prospect> best;
  double best_utility = 0.0;
  for (std::size_t h = 0; h < panorama.headings.size(); ++h) {
    const Gain& gain = panorama.headings[h];
    const double heading = static_cast<double>(h) * gain_.heading_step_rad();
    const double worth = gain.worth(params_.unsure_weight);
    if (worth < params_.least_voxels) continue;
    const double turn = std::abs(wrapped_angle(heading - yaw_rad));
    const double utility = worth / (params_.view_cost_m + params_.turn_cost_m_per_rad * turn);
    if (best && utility <= best_utility) continue;
    best = Prospect{place, heading, panorama.all, gain, 0.0, {}};
    best_utility = utility;
  }
  if (!best) return best;
  best->worth = panorama.all.worth(params_.unsure_weight);
  best->blocks = std::move(panorama.blocks);
  return best;
}

std::vector<Prospect> ViewSearch::prospects(const ExplorationState& state,
                                            const Surroundings& now) const {
  const ViewGain::Scene scene = scene_of(state, now);
  std::vector<Prospect> prospects;
  for (const Lookout& place : now.places(params_.place_step_m))
    if (auto found = prospect(scene, place, state.T_map_base.yaw_rad))
      prospects.push_back(std::move(*found));
  return prospects;
}

bool ViewSearch::any_prospect(const ExplorationState& state, const Surroundings& now) const {
  const ViewGain::Scene scene = scene_of(state, now);
  return std::ranges::any_of(now.places(params_.place_step_m), [&](const Lookout& place) {
    return prospect(scene, place, 0.0).has_value();
  });
}

void ViewSearch::look_once_more(const ExplorationState& state, const Surroundings& now,
                                ExplorationStep& step) {
  if (now.stuck()) {
    if (std::exchange(turned_, true))
      step.end = ExplorationEnd::nothing_reachable;
    else
      step.view = now.turn_on_the_spot();
    return;
  }
  const ViewGain::Scene scene = scene_of(state, now);
  const std::vector<Lookout> places = now.places(params_.place_step_m);
  Eigen::Vector2d target = Eigen::Vector2d::Zero();
  double least_m = std::numeric_limits<double>::infinity();
  for (const Lookout& barred : now.places_out_of_reach(params_.place_step_m)) {
    if (!prospect(scene, barred, 0.0)) continue;
    step.end = ExplorationEnd::nothing_reachable;
    if (std::ranges::any_of(barred_m_, [&](const Eigen::Vector2d& before_m) {
          return (before_m - barred.p_map).norm() < kSameBarred_m;
        }))
      continue;
    for (const Lookout& place : places) {
      const Eigen::Vector2d towards = barred.p_map - place.p_map;
      if (towards.norm() >= least_m) continue;
      least_m = towards.norm();
      step.view = now.view(place.cell, std::atan2(towards.y(), towards.x()));
      target = barred.p_map;
    }
  }
  if (step.view) barred_m_.push_back(target);
}

}  // namespace mapscore
