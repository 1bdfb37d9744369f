// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/calibration/calibrator.hpp"

#include "core/calibration/calibration_certainty.hpp"
#include "core/calibration/calibration_search.hpp"
#include "core/error.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace mapscore {
namespace {

using Numbers = CalibrationCorrection::Vector;

constexpr std::size_t kCoarseFit = 12000, kFineFit = 200000;  // edges
constexpr std::size_t kStarts = 6;
const std::vector<double> kTimes_s{-0.15, -0.11, -0.07, -0.035, 0, 0.035, 0.07, 0.11, 0.15};
constexpr float kShare_px = 1.5F;
constexpr double kFinestSpreads = 1.15, kFinest_px = 0.5, kCoarsest_px = 2.0;
/// Of the outlines, on which edges must lie if the last fit is a pixel wide or more. By chance they
/// lie on more of them the wider it is, so of a narrower one less will do.
constexpr double kLeastShare = 0.15, kLeastShareAt_px = 1.0;
constexpr double kBehind = 0.002;  // of the outlines, by which an estimate may be behind the start
/// Squared: an estimate can be worse than the start only if it is wrong by half of their
/// difference.
constexpr double kSurely = 4.0;
constexpr double kLittle = 0.01;      // of the outlines, by which what is surely better is ahead
constexpr double kMostBeyond = 1.5;   // of what the search tries
constexpr double kRadius_px = 150.0;  // of the edges about the image's middle, roughly

/// Pixels that a unit of each number moves outlines by, roughly.
Numbers pixels_by(const Calibration& start, const std::deque<OutlineEvidence>& frames) {
  double inverse = 0, speed = 0;
  for (const OutlineEvidence& frame : frames) {
    inverse += frame.mean_inverse_depth() / static_cast<double>(frames.size());
    speed += frame.speed_px() / static_cast<double>(frames.size());
  }
  const double f = start.color.fx_px, near = std::max(inverse, 0.05);
  Numbers pixels;
  pixels << f, f, kRadius_px, f * near, f * near, kRadius_px * near, kRadius_px, 1, 1,
      std::max(speed, 1.0), 1;
  return pixels;
}

/// What is not looked for stays as it is.
Numbers freed(const CalibratorSettings& settings, const std::deque<OutlineEvidence>& frames) {
  Numbers free = Numbers::Ones();
  if (!settings.focal_length) free[CalibrationCorrection::focal] = 0;
  if (!settings.principal_point) free.segment<2>(CalibrationCorrection::centre_u).setZero();
  const bool moves = std::ranges::any_of(frames, &OutlineEvidence::moves);
  if (!settings.time_offset || !moves) free[CalibrationCorrection::time] = 0;
  return free;
}

/// The correction that explains most outlines, of the start and those that a search finds.
CalibrationCorrection best_of_starts(const std::deque<OutlineEvidence>& frames,
                                     const CalibratorSettings& settings, double focal_px,
                                     Numbers free) {
  free.segment<3>(CalibrationCorrection::focal).setZero();
  const bool timed = free[CalibrationCorrection::time] > 0;
  std::vector<CalibrationCorrection> starts =
      searched(frames, settings.search_deg.rad(), settings.search_m, focal_px,
               timed ? kTimes_s : std::vector<double>{0.0}, timed ? 2 * kStarts : kStarts);
  for (CalibrationCorrection& start : starts)
    for (const float sigma_px : {8.0F, 5.0F, 3.0F})
      start = refined(frames, start, sigma_px, 5, kCoarseFit, free);
  starts.insert(starts.begin(), CalibrationCorrection{});
  CalibrationCorrection best;
  double most = -1;
  for (const CalibrationCorrection& start : starts) {
    const CalibrationCorrection fitted = refined(frames, start, 2.0F, 5, kCoarseFit, free);
    if (const double share = explained_share(frames, fitted, kShare_px); share > most)
      most = share, best = fitted;
  }
  return best;
}

/// The width of the last fit: as narrow as edges lie about outlines.
float finest_sigma(const std::deque<OutlineEvidence>& frames, const CalibrationCorrection& at) {
  double sum = 0;
  for (const OutlineEvidence& frame : frames)
    sum +=
        spread_px(frame, at, static_cast<float>(kCoarsest_px)) / static_cast<double>(frames.size());
  return static_cast<float>(std::clamp(kFinestSpreads * sum, kFinest_px, kCoarsest_px));
}

/// Of one frame; `all` are those of the estimate.
FrameContribution contribution_of(const OutlineEvidence& frame, const CalibrationCorrection& all,
                                  const CalibrationCorrection& without, double information,
                                  float sigma_px) {
  FrameContribution one;
  one.edges = frame.edges();
  one.length_px = frame.length_px();
  if (one.length_px > 0) one.explained = frame.explained(all, kShare_px) / one.length_px;
  one.information = information;
  one.residual_px = spread_px(frame, all, sigma_px);
  one.left_out_px = spread_px(frame, without, sigma_px);
  return one;
}

/// Squared Mahalanobis distance of an estimate from no correction, of the numbers looked for.
double distance_from_start(const CalibrationEstimate& estimate, const Numbers& free) {
  const Numbers change = estimate.correction.vector();
  std::vector<int> sought;
  for (int n = 0; n < CalibrationCorrection::kAxes; ++n)
    if (free[n] > 0) sought.push_back(n);
  const Eigen::MatrixXd covariance = estimate.covariance(sought, sought);
  const Eigen::VectorXd by = change(sought);
  return by.dot(covariance.ldlt().solve(by));
}

/// What chi-square of so many numbers exceeds once in a thousand times (E. B. Wilson, M. M.
/// Hilferty, 1931).
double largest_by_chance(double numbers) {
  constexpr double kNormal = 3.0902;
  const double spread = 2 / (9 * numbers);
  return numbers * std::pow(1 - spread + kNormal * std::sqrt(spread), 3);
}

/// What may make a direction known.
std::string advice_for(const std::string& direction, const CalibratorSettings& settings) {
  const auto holds = [&](std::string_view name) {
    return direction.find(name) != std::string::npos;
  };
  if (holds("time")) return "add frames in which the robot turns, or do not look for time_offset";
  if (holds("principal"))
    return "do not look for principal_point, which a turn is hardly told from";
  return std::string(
             "add frames with objects at other depths and at other places of the image; or the "
             "start is farther off than search_m and search_deg, or wrong in what is not looked "
             "for") +
         (settings.focal_length ? "" : ", as focal_length") +
         (settings.time_offset ? "; or do not look for time_offset" : "");
}

/// Why an estimate must not be used; empty where it may.
std::string objection(const CalibrationEstimate& estimate, const CalibratorSettings& settings) {
  const auto width = static_cast<double>(estimate.sigma_px);
  if (estimate.explained < kLeastShare * std::min(width / kLeastShareAt_px, 1.0))
    return "hardly any outline lies on a step of depth; see that masks and depth images belong "
           "together, that depth was not smoothed or averaged over steps, that focal lengths, "
           "principal points and the depth's scale are those of these images, and that the start "
           "is not farther off than search_m and search_deg";
  if (!(estimate.weakest_px < CalibrationEstimate::kMostWeak_px) ||
      !(estimate.condition < CalibrationEstimate::kMostCondition))
    return estimate.weakest + " cannot be told; " + advice_for(estimate.weakest, settings);
  const Pose& rigid = estimate.correction.rigid;
  if (Eigen::AngleAxisd(rigid.linear()).angle() > kMostBeyond * settings.search_deg.rad() ||
      rigid.translation().norm() > kMostBeyond * settings.search_m)
    return "the fit ran beyond what is searched; give a better start, find the focal length too if "
           "it may be wrong (focal_length), or search farther (search_m, search_deg)";
  return {};
}

}  // namespace

Calibrator::Calibrator(const Calibration& start, const CalibratorSettings& settings)
    : start_(start), settings_(settings) {
  check(start);
  check_ranges(settings);
}

void Calibrator::add(const Sight& sight, const std::optional<FrameMotion>& motion) {
  const Calibration& believed = sight.believed();
  if (!(believed.color == start_.color && believed.depth == start_.depth &&
        believed.T_color_depth.isApprox(start_.T_color_depth, 1e-12)))
    throw Error("calibrator: a frame believes in other cameras than the start");
  const double shift = settings_.search_m / std::max(start_.range_min_m, settings_.search_m);
  const double reach_px =
      start_.color.fx_px * (settings_.search_deg.rad() + std::min(shift, 0.1)) + 24.0;
  frames_.emplace_back(sight, motion, reach_px);
  if (frames_.size() > static_cast<std::size_t>(settings_.frames)) frames_.pop_front();
}

CalibrationEstimate Calibrator::estimate() const {
  CalibrationEstimate result;
  result.calibration = start_;
  const bool any = std::ranges::any_of(frames_, [](const auto& f) { return f.edges() > 0; });
  if (!any) {
    result.reason =
        "no frame has a mask near a step of depth; add frames with objects in view, and see that "
        "depth images hold depths within the cameras' range and that the start is near";
    result.frames.resize(frames_.size());
    return result;
  }
  const Numbers free = freed(settings_, frames_);
  CalibrationCorrection best = best_of_starts(frames_, settings_, start_.color.fx_px, free);
  best = refined(frames_, best, kCoarsest_px, 8, kFineFit, free);
  result.sigma_px = finest_sigma(frames_, best);
  best = refined(frames_, best, result.sigma_px, 15, kFineFit, free);
  result.explained_start = explained_share(frames_, {}, kShare_px);
  result.explained = explained_share(frames_, best, kShare_px);
  const CalibrationCertainty certainty =
      certainty_of(frames_, best, result.sigma_px, free, pixels_by(start_, frames_));
  result.covariance =
      certainty.covariance
          .topLeftCorner<CalibrationCorrection::kAxes, CalibrationCorrection::kAxes>();
  result.condition = certainty.condition;
  result.weakest = certainty.weakest;
  result.weakest_px = certainty.weakest_px;
  for (std::size_t n = 0; n < frames_.size(); ++n)
    result.frames.push_back(contribution_of(frames_[n], best, certainty.without[n],
                                            certainty.information[n], result.sigma_px));
  result.correction = best;
  result.objects = certainty.objects;
  result.reason = objection(result, settings_);
  if (result.reason.empty() && result.explained + kBehind < result.explained_start) {
    result.verdict = CalibrationVerdict::not_better;
    result.reason = "the start explains the outlines better than what was found";
  } else if (result.reason.empty()) {
    const double distance = distance_from_start(result, free),
                 chance = largest_by_chance(free.head<CalibrationCorrection::kAxes>().sum());
    if (distance < chance) {
      result.verdict = CalibrationVerdict::confirmed;
      result.reason = "what was found differs from the start by no more than chance";
    } else {
      result.verdict = CalibrationVerdict::calibrated;
      result.calibration = best.applied(start_);
      result.may_be_worse =
          distance < kSurely * chance || result.explained < result.explained_start + kLittle;
    }
  }
  return result;
}

}  // namespace mapscore
