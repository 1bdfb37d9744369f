// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/loop_closure.hpp"

#include "core/geometry/camera.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace mapscore {
namespace {

constexpr int kSmallWidth = 32, kSmallHeight = 24;
/// Candidates that are looked at, and key frames on either side of one that make its map.
constexpr std::size_t kMostCandidates = 3, kNeighbours = 4;
/// A loop is closed when its points lie on planes, not beside them.
constexpr double kLeastInliers = 0.7;

double turn_between(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

bool may_be_same(const KeyFrame& earlier, const KeyFrame& current, const LoopClosure& rule,
                 double reach_m) {
  return current.way_m - earlier.way_m >= rule.loop_way_m &&
         (earlier.T_map_base.translation() - current.T_map_base.translation()).norm() <=
             rule.loop_distance_m + reach_m &&
         turn_between(earlier.T_map_base, current.T_map_base) <= rule.loop_turn_deg.rad();
}

}  // namespace

cv::Mat1f small_depth_of(const cv::Mat1w& depth, double range_max_m) {
  cv::Mat1f inverse(depth.size());
  const auto nothing = static_cast<float>(1.0 / range_max_m);
  std::ranges::transform(depth, inverse.begin(), [&](std::uint16_t z) {
    return z == 0 ? nothing : static_cast<float>(kDepthUnitsPerMetre) / static_cast<float>(z);
  });
  cv::Mat1f small;
  cv::resize(inverse, small, {kSmallWidth, kSmallHeight}, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(small, small, {5, 5}, 1.0);
  small -= cv::mean(small)[0];
  const double norm = cv::norm(small);
  if (norm > 0.0) small /= norm;
  return small;
}

std::vector<std::size_t> loop_candidates(const std::vector<KeyFrame>& earlier,
                                         const KeyFrame& current, const LoopClosure& rule,
                                         double reach_m, bool anywhere) {
  std::vector<std::pair<double, std::size_t>> alike;
  for (std::size_t n = 0; n < earlier.size(); ++n) {
    if (!anywhere && !may_be_same(earlier[n], current, rule, reach_m)) continue;
    const double likeness = earlier[n].small_depth.dot(current.small_depth);
    if (likeness >= rule.loop_likeness) alike.emplace_back(-likeness, n);
  }
  std::ranges::sort(alike);
  if (alike.size() > kMostCandidates) alike.resize(kMostCandidates);
  std::vector<std::size_t> candidates;
  for (const auto& [likeness, n] : alike) candidates.push_back(n);
  return candidates;
}

std::vector<std::size_t> keys_about(const std::vector<KeyFrame>& keys, std::size_t candidate,
                                    const KeyFrame& current, const LoopClosure& rule) {
  const std::size_t first = candidate - std::min(candidate, kNeighbours);
  const std::size_t last = std::min(candidate + kNeighbours, keys.size() - 1);
  std::vector<std::size_t> about;
  for (std::size_t n = first; n <= last; ++n)
    if (current.way_m - keys[n].way_m >= 0.5 * rule.loop_way_m || n == candidate)
      about.push_back(n);
  return about;
}

bool closes_loop(const ScanMatch& match, const LoopClosure& rule) {
  return match.support() >= rule.loop_support && match.inlier_share >= kLeastInliers;
}

}  // namespace mapscore
