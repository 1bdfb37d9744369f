// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/visual_odometry.hpp"

#include "core/error.hpp"
#include "core/odometry/motion_prior.hpp"
#include "core/odometry/odometry_numbers.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace mapscore {
namespace {

using namespace odometry_numbers;

/// A scan after less than both since the last one that counted is matched, but leaves the filter as
/// it is: from nearly the same place it holds the same errors of the map, which would count twice.
constexpr double kMatchWay = 0.05, kMatchTurn = 5.0 * kDegree;
/// Fewer points than these say nothing.
constexpr std::size_t kLeastPoints = 100;
/// A frame is tracked when this share of what the last key frame should have seen of it lies on
/// planes; where less than kLittle should have, nothing can be said.
constexpr double kLeastSupport = 0.3, kLittle = 0.3;
/// A scan that moves the prior by more than this (squared, over its covariance) contradicts it, and
/// the factor that the prior's covariance grows by then.
constexpr double kContradiction = 50.0, kDistrust = 100.0;
/// A scan that does not contradict the prior is believed elsewhere where this much more of its
/// upright points lies on planes than by the prior.
constexpr double kSlipGain = 0.15;
/// Of the turns that are tried then: on a rug's edge a base twists by degrees that its wheels do
/// not feel.
constexpr double kSlipTurn = 1.5 * kDegree;
/// No base on wheels moves faster (m/s, rad/s); an encoder that says so tells nothing.
constexpr double kFastest = 5.0, kFastestTurn = 720.0 * kDegree;
/// An image that sees through more than kSeenThrough of the upright points of the last key frame is
/// elsewhere, and so is a new key frame that sees through more than kMostlyThrough of
/// kLeastContradicting earlier ones.
constexpr double kSeenThrough = 0.25, kMostlyThrough = 0.5;
constexpr std::ptrdiff_t kLeastContradicting = 3;
/// Frames lost in a row after which a new map begins.
constexpr int kMostLost = 5;
/// Frames lost in a row that may be misjudged: the next one is still matched near the prior.
constexpr int kMisjudged = 1;
/// Share of a pose's uncertainty that the part of the map takes over which a key frame adds: all of
/// it where everything is new, little where most is known.
double taken_over(double new_share) {
  constexpr double kLeast = 0.0005;
  return std::max(kLeast, std::pow(new_share, 6));
}

/// Of a pose in the map, however often it is matched: the map's own errors are the same each time.
Covariance6 map_bias() {
  return sigmas6(0.0015, 0.0015, 0.04 * kDegree, 0.03 * kDegree);
}

/// Part of the filter's covariance that is stated of an image's pose. The filter is cautious, so
/// that no scan is thrown away in vain: where a scan placed the image, errors are half of what it
/// says (docs/odometry.md, "Covariance").
double stated_part(Tracking tracking) {
  const bool by_scan = tracking == Tracking::tracked || tracking == Tracking::slipped;
  return by_scan ? kStatedPart : 1.0;
}

/// Whether the encoders say what no wheels can do.
bool wheels_jump(const OdometryFrame& before, const OdometryFrame& after) {
  if (!before.T_odom_base || !after.T_odom_base) return false;
  const Pose T = before.T_odom_base->inverse() * *after.T_odom_base;
  const double dt_s = after.stamp_s - before.stamp_s;
  return T.translation().norm() > kFastest * dt_s ||
         Eigen::AngleAxisd(T.linear()).angle() > kFastestTurn * dt_s;
}

double squared_sigmas(const PosePrior& prior, const Pose& T_map_base) {
  const Vector6 xi = log_pose(prior.mean.inverse() * T_map_base);
  return xi.dot(prior.covariance.ldlt().solve(xi));
}

}  // namespace

VisualOdometry::VisualOdometry(const VisualOdometryParams& params, const Calibration& believed,
                               const Pose& T_map_base_start)
    : params_(params),
      believed_(believed),
      state_{T_map_base_start},
      local_map_(params.map, kHorizon) {
  check(believed);
  check_ranges(params.sampling);
  check_ranges(params.key);
  if (params.loops) check_ranges(*params.loops);
}

VisualOdometry::Expected VisualOdometry::expect(const OdometryFrame& frame) const {
  const double dt_s = frame.stamp_s - last_->stamp_s;
  const bool jumped = wheels_jump(*previous_, frame);
  const bool wheels = frame.T_odom_base && last_->T_odom_base && !jumped;
  const LastStep before{T_before_last_base_, last_step_s_};
  const MotionPrior motion =
      wheels ? wheel_motion(last_->T_odom_base->inverse() * *frame.T_odom_base, params_.wheel_noise)
      : params_.wheeled ? robot_motion(before, dt_s)
                        : hand_motion(before, dt_s);
  PosePrior prior{state_.T_map_base * motion.T_before_after,
                  moved(state_.relative, motion.T_before_after) + motion.noise};
  if (jumped) prior.covariance += jump_when_lost();
  return {wheels ? on_floor(prior) : prior, motion.T_before_after, jumped};
}

ScanMatch VisualOdometry::searched(const DepthScan& scan, const PosePrior& loose,
                                   const ScanMatch& first) const {
  ScanMatch best = first;
  for (const int step : {0, 1, -1, 2, -2, 3, -3}) {
    const Pose turned = loose.mean * Eigen::AngleAxisd(step * kSlipTurn, Eigen::Vector3d::UnitZ());
    const ScanMatch match = local_map_.match(scan, loose, turned);
    if (match.upright_support() > best.upright_support()) best = match;
  }
  return best;
}

bool VisualOdometry::sees_through_key(const cv::Mat1w& depth, const KeyFrame& key,
                                      const Pose& T_map_base) const {
  return seen_through(depth, T_map_base, key.scan, key.T_map_base, believed_) > kSeenThrough;
}

bool VisualOdometry::contradicts(const cv::Mat1w& depth, const Pose& T_map_base,
                                 std::span<const KeyFrame> keys) const {
  return std::ranges::count_if(keys, [&](const KeyFrame& key) {
           return seen_through(depth, T_map_base, key.scan, key.T_map_base, believed_) >
                  kMostlyThrough;
         }) >= kLeastContradicting;
}

std::span<const KeyFrame> VisualOdometry::keys_of_map() const {
  const std::span<const KeyFrame> keys = std::span(keys_).subspan(map_begins_);
  return keys.last(std::min(keys.size(), kHorizon));
}

Tracking VisualOdometry::track(const DepthScan& scan, const OdometryFrame& frame,
                               const Expected& expected, OdometryStep& step) {
  if (scan.size() < kLeastPoints) return Tracking::blind;
  const Pose T_key_base = keys_.back().T_map_base.inverse() * expected.prior.mean;
  const double seen_before = std::max(overlap(frame.depth, believed_, T_key_base),
                                      overlap(key_view_.depth(), believed_, T_key_base.inverse()));
  const double still_seen = kStillSeen * last_support_;
  ScanMatch match = local_map_.match(scan, expected.prior);
  Tracking tracking = expected.wheels_jumped ? Tracking::slipped : Tracking::tracked;
  const bool contradicts = squared_sigmas(expected.prior, match.T_map_base) > kContradiction;
  if (contradicts || match.support() < still_seen) {
    PosePrior loose = expected.prior;
    loose.covariance *= kDistrust;
    if (loose.on_floor) loose = on_floor(loose);  // a slip lifts no base and tilts none far
    const ScanMatch again = searched(scan, loose, match);
    if (again.support() >= still_seen &&
        (contradicts || again.upright_support() >= match.upright_support() + kSlipGain)) {
      match = again;
      tracking = Tracking::slipped;
    } else if (contradicts) {
      tracking = Tracking::unsure;
    }
  }
  step.known_share = match.known_share;
  step.inlier_share = match.inlier_share;
  step.upright_known_share = match.upright ? match.upright->known_share : match.known_share;
  if (lost_for_ > 0 && match.support() < still_seen) return Tracking::lost;
  const KeyFrame& key = keys_.back();
  if (sees_through_key(frame.depth, key, match.T_map_base) ||
      key_view_.misses(scan, match, believed_, key.T_map_base.inverse() * match.T_map_base))
    return Tracking::lost;
  if (match.support() < kLeastSupport * std::max(seen_before, kLittle)) {
    if (seen_before >= kLittle) return Tracking::lost;
    tracking = Tracking::beside;
  }
  if (tracking == Tracking::unsure) return tracking;
  if (tracking != Tracking::beside) last_support_ = match.support();
  state_.T_map_base = match.T_map_base;
  state_.relative = match.covariance;
  return tracking;
}

OdometryStep VisualOdometry::add(const OdometryFrame& frame) {
  if (!(frame.stamp_s > last_stamp_s_))
    throw Error("odometry: a stamp is not later than the one before; give frames in their order");
  last_stamp_s_ = frame.stamp_s;
  OdometryStep step = place(frame);
  previous_ = {frame.stamp_s, {}, frame.T_odom_base};
  return step;
}

OdometryStep VisualOdometry::place(const OdometryFrame& frame) {
  OdometryStep step{.stamp_s = frame.stamp_s};
  DepthScan scan = scan_of(frame.depth, believed_, params_.sampling);
  if (keys_.empty()) {
    begin(std::move(scan), frame, step);
  } else {
    const Expected expected = expect(frame);
    const State before = state_;
    const Pose T_map_last = state_.T_map_base;
    state_ = {expected.prior.mean, expected.prior.covariance,
              moved(before.drift, expected.T_last_base)};
    step.tracking = track(scan, frame, expected, step);
    if (hardly_moved(frame) && step.tracking == Tracking::tracked) {
      const State here = std::exchange(state_, before);
      return placed(step, here);
    }
    way_m_ += (T_map_last.inverse() * state_.T_map_base).translation().norm();
    T_before_last_base_ = T_map_last.inverse() * state_.T_map_base;
    last_step_s_ = frame.stamp_s - last_->stamp_s;
    if (step.tracking == Tracking::lost) recover(scan, frame, step, kMostLost);
    const bool places = step.tracking == Tracking::tracked || step.tracking == Tracking::slipped ||
                        step.tracking == Tracking::beside;
    const Pose T_key_base = keys_.back().T_map_base.inverse() * state_.T_map_base;
    bool keeps = places && is_key_frame(params_.key, frame.depth, believed_, T_key_base);
    if (keeps && contradicts(frame.depth, state_.T_map_base, keys_of_map())) {
      // Carried away unseen, some images ago: where it has been since is no better known.
      keeps = false;
      recover(scan, frame, step, 0);
    }
    if (step.tracking != Tracking::lost && step.tracking != Tracking::blind) lost_for_ = 0;
    if (keeps || step.tracking == Tracking::restarted) keep(std::move(scan), frame, step);
  }
  last_ = {frame.stamp_s, {}, frame.T_odom_base};
  return placed(step, state_);
}

void VisualOdometry::begin(DepthScan scan, const OdometryFrame& frame, OdometryStep& step) {
  if (last_) {
    const PosePrior prior = expect(frame).prior;
    state_.T_map_base = prior.mean;
    state_.relative = prior.covariance;
  }
  if (scan.size() < kLeastPoints) {
    step.tracking = Tracking::blind;
    return;
  }
  state_.drift = std::exchange(state_.relative, Covariance6::Zero());
  keep(std::move(scan), frame, step);
}

void VisualOdometry::recover(const DepthScan& scan, const OdometryFrame& frame, OdometryStep& step,
                             int most_lost) {
  // Once it may no longer be misjudged, or is certain, it may have been carried away.
  if (++lost_for_ == std::min(kMisjudged, most_lost) + 1) state_.relative += jump_when_lost();
  if (relocate(scan, frame)) {
    step.tracking = Tracking::relocated;
    step.key_frame = step.closed_loop = true;
  } else if (lost_for_ > most_lost) {
    local_map_ = LocalMap(params_.map, kHorizon);
    map_begins_ = keys_.size();
    step.tracking = Tracking::restarted;
  }
}

Covariance6 VisualOdometry::jump_when_lost() const {
  return params_.wheeled ? lost_jump() : sigmas6(0.5, 0.5, 30.0 * kDegree, 30.0 * kDegree);
}

bool VisualOdometry::hardly_moved(const OdometryFrame& frame) const {
  if (keys_.empty() || lost_for_ > 0 || !frame.T_odom_base || !last_->T_odom_base) return false;
  const Pose T_last_base = last_->T_odom_base->inverse() * *frame.T_odom_base;
  return T_last_base.translation().norm() < kMatchWay &&
         Eigen::AngleAxisd(T_last_base.linear()).angle() < kMatchTurn;
}

OdometryStep VisualOdometry::placed(OdometryStep step, const State& state) {
  step.T_map_base = state.T_map_base;
  step.covariance = stated_part(step.tracking) * state.relative + state.drift + map_bias();
  if (lost_for_ > 0 && lost_for_ <= kMisjudged) step.covariance += jump_when_lost();
  if (keys_.empty())
    placed_.push_back({step.stamp_s, {}, state.T_map_base});
  else
    placed_.push_back(
        {step.stamp_s, keys_.size() - 1, keys_.back().T_map_base.inverse() * state.T_map_base});
  return step;
}

void VisualOdometry::keep(DepthScan scan, const OdometryFrame& frame, OdometryStep& step) {
  step.key_frame = true;
  KeyFrame key{frame.stamp_s,
               state_.T_map_base,
               way_m_,
               params_.loops ? frame.depth.clone() : cv::Mat1w(),
               std::move(scan),
               params_.loops ? small_depth_of(frame.depth, believed_.range_max_m) : cv::Mat1f()};
  if (!keys_.empty()) {
    const double share =
        step.tracking == Tracking::restarted
            ? 1.0
            : taken_over(1.0 - std::min(step.known_share, step.upright_known_share));
    const Covariance6 growth =
        share * stated_part(step.tracking) * state_.relative + key_frame_floor();
    state_.drift += growth;
    state_.relative *= 1.0 - share;
    edges_.push_back({keys_.size() - 1, keys_.size(),
                      keys_.back().T_map_base.inverse() * key.T_map_base, growth, false});
  }
  local_map_.insert(scan_of(frame.depth, believed_, params_.sampling.of_map()), key.T_map_base);
  key_view_ =
      KeyView(frame.depth, key.scan, local_map_.upright_at(key.scan, key.T_map_base), believed_);
  keys_.push_back(std::move(key));
  if (params_.loops && way_m_ - loop_closed_at_m_ >= 1.0)
    step.closed_loop = close_loop(frame.depth, false);
}

std::vector<CorrectedPose> VisualOdometry::corrected() const {
  std::vector<CorrectedPose> poses;
  for (const Placed& placed : placed_)
    poses.push_back({placed.stamp_s, placed.key ? keys_[*placed.key].T_map_base * placed.T_key_base
                                                : placed.T_key_base});
  return poses;
}

}  // namespace mapscore
