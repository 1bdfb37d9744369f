// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/odometry_numbers.hpp"
#include "core/odometry/visual_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

// The loops of VisualOdometry: found, spread over the key frames, and a way back for one that is
// lost.
namespace mapscore {

using namespace odometry_numbers;

bool VisualOdometry::close_loop(const cv::Mat1w& depth, bool anywhere) {
  const KeyFrame& current = keys_.back();
  const double reach_m =
      3.0 * std::sqrt((state_.drift + state_.relative).topLeftCorner<2, 2>().trace());
  for (const std::size_t n : loop_candidates(keys_, current, *params_.loops, reach_m, anywhere)) {
    if (n + 1 == keys_.size()) continue;
    const PosePrior prior =
        anywhere
            ? PosePrior{keys_[n].T_map_base, jump_when_lost()}
            : PosePrior{current.T_map_base, state_.drift + state_.relative + key_frame_floor()};
    const ScanMatch match =
        map_of(keys_about(keys_, n, current, *params_.loops)).match(current.scan, prior);
    if (!closes_loop(match, *params_.loops) ||
        (anywhere && (match.support() < kStillSeen * last_support_ ||
                      sees_through_key(depth, keys_[n], match.T_map_base))))
      continue;
    const std::size_t first = n - std::min(n, kHorizon / 2);
    const std::size_t last = std::min(n + kHorizon / 2, keys_.size() - 1);
    if (contradicts(depth, match.T_map_base, std::span(keys_).subspan(first, last - first)))
      continue;
    const Covariance6 weak = lost_jump().inverse();
    edges_.push_back({n, keys_.size() - 1, keys_[n].T_map_base.inverse() * match.T_map_base,
                      kStatedPart * (match.information + weak).inverse() + key_frame_floor(),
                      true});
    keys_.back().T_map_base = match.T_map_base;
    spread();
    return true;
  }
  return false;
}

bool VisualOdometry::relocate(const DepthScan& scan, const OdometryFrame& frame) {
  if (!params_.loops) return false;
  keys_.push_back({frame.stamp_s, state_.T_map_base, way_m_, frame.depth.clone(), scan,
                   small_depth_of(frame.depth, believed_.range_max_m)});
  edges_.push_back({keys_.size() - 2, keys_.size() - 1,
                    keys_[keys_.size() - 2].T_map_base.inverse() * state_.T_map_base,
                    state_.relative + key_frame_floor(), false});
  if (close_loop(frame.depth, true)) return true;
  keys_.pop_back();
  edges_.pop_back();
  return false;
}

void VisualOdometry::spread() {
  std::vector<Pose> nodes;
  for (const KeyFrame& key : keys_) nodes.push_back(key.T_map_base);
  const OptimisedPoses optimal = optimised(std::move(nodes), edges_);
  for (std::size_t n = 0; n < keys_.size(); ++n) keys_[n].T_map_base = optimal.nodes[n];
  state_.T_map_base = keys_.back().T_map_base;
  state_.drift = optimal.last_covariance;
  state_.relative = key_frame_floor();
  loop_closed_at_m_ = way_m_;
  ++loops_;
  rebuild();
}

void VisualOdometry::rebuild() {
  std::vector<std::pair<double, std::size_t>> by_distance;
  for (std::size_t n = 0; n < keys_.size(); ++n)
    by_distance.emplace_back(
        (keys_[n].T_map_base.translation() - state_.T_map_base.translation()).norm(), n);
  std::ranges::sort(by_distance);
  by_distance.resize(std::min(by_distance.size(), kHorizon));
  std::vector<std::size_t> near;
  for (const auto& [distance, n] : by_distance) near.push_back(n);
  std::ranges::sort(near);
  local_map_ = map_of(near);
}

LocalMap VisualOdometry::map_of(const std::vector<std::size_t>& keys) const {
  LocalMap map(params_.map, kHorizon);
  for (const std::size_t n : keys)
    map.insert(scan_of(keys_[n].depth, believed_, params_.sampling.of_map()), keys_[n].T_map_base);
  return map;
}

}  // namespace mapscore
