// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/odometry/depth_scan.hpp"
#include "core/odometry/local_map.hpp"
#include "core/parameters.hpp"

#include <opencv2/core.hpp>

#include <cstddef>
#include <vector>

namespace mapscore {

/// When a key frame is taken for a place that was seen before.
struct LoopClosure {
  double loop_way_m = 3;
  double loop_distance_m = 1.5;
  Degrees loop_turn_deg{60};
  double loop_likeness = 0.4;
  double loop_support = 0.5;

  static void fields(auto& s, auto&& visit) {
    visit(s.loop_way_m,
          Field{"loop_way_m", "least way between two sights of one place", above(0, 1000)});
    visit(s.loop_distance_m,
          Field{"loop_distance_m", "greatest distance between two sights of one place",
                above(0, 100)});
    visit(s.loop_turn_deg,
          Field{"loop_turn_deg", "greatest turn between two sights of one place", above(0, 180)});
    visit(s.loop_likeness,
          Field{"loop_likeness", "least correlation of the small depth images of both", {-1, 1}});
    visit(
        s.loop_support,
        Field{"loop_support", "least share of the points on planes of the earlier sights", {0, 1}});
  }
  bool operator==(const LoopClosure&) const = default;
};

/// A frame that was kept.
struct KeyFrame {
  double stamp_s = 0.0;
  Pose T_map_base = Pose::Identity();
  double way_m = 0.0;     ///< driven since the first one
  cv::Mat1w depth;        ///< for maps made anew; empty without loops
  DepthScan scan;         ///< of points_across
  cv::Mat1f small_depth;  ///< see small_depth_of
};

/// A blurred image of the inverse depth, 32 x 24 pixels with mean 0 and norm 1, by which places are
/// told apart (as the small blurry images of G. Klein and D. Murray, Improving the Agility of
/// Keyframe-Based SLAM, 2008, of depth in place of brightness: light does not matter to it). Pixels
/// without depth count as 1 / range_max.
[[nodiscard]] cv::Mat1f small_depth_of(const cv::Mat1w& depth, double range_max_m);

/// Earlier key frames that may show the place of `current`, most alike first: near it in pose, far
/// from it in way, and alike. `reach_m` widens the distance by what the pose is unsure of;
/// `anywhere`: as for a robot that is lost, whatever pose and way say.
[[nodiscard]] std::vector<std::size_t> loop_candidates(const std::vector<KeyFrame>& earlier,
                                                       const KeyFrame& current,
                                                       const LoopClosure& rule, double reach_m,
                                                       bool anywhere = false);

/// Key frames about a candidate, itself among them, whose map `current` is to be matched with; none
/// that it just came by.
[[nodiscard]] std::vector<std::size_t> keys_about(const std::vector<KeyFrame>& keys,
                                                  std::size_t candidate, const KeyFrame& current,
                                                  const LoopClosure& rule);

/// Whether enough of a key frame's points lie on the planes of that map.
[[nodiscard]] bool closes_loop(const ScanMatch& match, const LoopClosure& rule);

}  // namespace mapscore
