// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/tolerance.hpp"

#include "core/error.hpp"
#include "eval/statistics/dose_focus.hpp"
#include "eval/statistics/intervals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace mapscore::eval {
namespace {

constexpr double kDoubtDeviations = 2.0;  ///< standard errors beyond the target that raise doubt
constexpr std::size_t kDoubtRun = 4;      ///< neighbouring trials that may raise it together
constexpr std::size_t kBoundingRun = 8;   ///< trials that close a side that the curve leaves open
constexpr double kBoundingLevel = 0.005;  ///< at which they do, one-sided: many runs are looked at
constexpr std::size_t kLeastRepeats = 4;  ///< at an end of the range, to tell its side
constexpr double kDoubtLevel = 0.02;      ///< at which doubt is confirmed, one-sided

using Points = std::vector<DosePoint>;

void check(const ToleranceSearch& search) {
  if (!(search.low < search.high) || !std::isfinite(search.high - search.low))
    throw Error(
        fmt::format("the range of doses from {} to {} is empty; give two numbers, the "
                    "lesser first",
                    search.low, search.high));
  if (search.trials < kLeastTrials)
    throw Error(fmt::format("{} trials are too few for a tolerance; give {} or more", search.trials,
                            kLeastTrials));
}

std::vector<double> spaced(double first, double last, int count) {
  std::vector<double> doses;
  for (int n = 0; n < count; ++n) doses.push_back(first + (last - first) * n / (count - 1));
  return doses;
}

/// Trials made before fine stage `stage`; of kFineStages, all.
std::size_t trials_before(const ToleranceSearch& search, int stage) {
  return static_cast<std::size_t>(kCoarseDoses +
                                  (search.trials - kCoarseDoses) * stage / kFineStages);
}

/// Those with a score, by dose.
Points points_of(std::span<const DoseTrial> trials) {
  Points points;
  for (std::size_t n = 0; n < trials.size(); ++n)
    if (trials[n].score) points.push_back({trials[n].dose, *trials[n].score, n});
  std::ranges::stable_sort(points, {}, &DosePoint::dose);
  return points;
}

/// Whether the first stage has too few scores to look for anything.
bool too_few(std::span<const DoseTrial> trials) {
  return points_of(trials.first(std::min<std::size_t>(trials.size(), kCoarseDoses))).size() <
         kLeastPoints;
}

/// After so many fine stages.
DoseFocus focus_after(const ToleranceSearch& search, std::span<const DoseTrial> trials,
                      int stages) {
  DoseFocus focus = first_focus(search, points_of(trials.first(trials_before(search, 0))));
  for (int stage = 1; stage <= stages; ++stage)
    focus = refined(search, focus, points_of(trials.first(trials_before(search, stage))));
  return focus;
}

/// A dose below (`side` -1) or above (1) the crossing that bounds it without the curve: the far end
/// of the nearest kBoundingRun trials whose mean is surely on their side of the target. Since the
/// score falls with the dose, it is there at that end too.
std::optional<double> bound_of(const ToleranceSearch& search, double crossing, double side,
                               const Points& all) {
  const double t = student_t_quantile(1.0 - kBoundingLevel, static_cast<int>(kBoundingRun) - 1);
  std::deque<double> run;
  const auto surely = [&](const DosePoint& point) {
    run.push_back(point.score);
    if (run.size() > kBoundingRun) run.pop_front();
    if (run.size() < kBoundingRun) return false;
    const MeanInterval of_run = mean_interval(std::vector<double>(run.begin(), run.end()));
    const double error = of_run.sd / std::sqrt(static_cast<double>(run.size()));
    return side * (search.target - of_run.mean) > t * error;
  };
  Points outwards;
  for (const DosePoint& point : all)
    if (side * (point.dose - crossing) > 0.0) outwards.push_back(point);
  if (side < 0.0) std::ranges::reverse(outwards);
  const auto end = std::ranges::find_if(outwards, surely);
  return end == outwards.end() ? std::nullopt : std::optional(end->dose);
}

/// By a curve through the tolerance's points.
void read_curve(const ToleranceSearch& search, const DoseCurve& curve, const Points& all,
                Tolerance& tolerance) {
  const double target = search.target;
  const double first = tolerance.points.front().dose, last = tolerance.points.back().dose;
  const Crossing crossing = curve_crossing(curve, target, first, last);
  if (crossing.dose) {
    tolerance.low = crossing.low ? crossing.low : bound_of(search, *crossing.dose, -1.0, all);
    tolerance.high = crossing.high ? crossing.high : bound_of(search, *crossing.dose, 1.0, all);
    if (!tolerance.low && !tolerance.high) return;
    tolerance.verdict = ToleranceVerdict::found;
    tolerance.dose = crossing.dose;
  } else if (last >= search.high && curve.at(last) - curve.half_width(last) > target) {
    tolerance.verdict = ToleranceVerdict::above;
    tolerance.low = search.high;
  } else if (first <= search.low && curve.at(first) + curve.half_width(first) < target) {
    tolerance.verdict = ToleranceVerdict::below;
    tolerance.high = search.low;
  }
}

/// The dose beyond the interval at which neighbouring trials are most surely on the wrong side of
/// the target: the middle of up to kDoubtRun of them whose mean is there by most of its standard
/// errors; none where all are within chance.
std::optional<double> doubtful_dose(const ToleranceSearch& search, const Tolerance& tolerance,
                                    const Points& points) {
  const double sd = tolerance.curve ? tolerance.curve->residual_sd()
                                    : 0.25 * (tolerance.step->above - tolerance.step->below);
  const auto side_of = [&tolerance](double at) {  // of the interval; 0 within
    if (tolerance.low && at < *tolerance.low) return -1.0;
    return tolerance.high && at > *tolerance.high ? 1.0 : 0.0;
  };
  double most = kDoubtDeviations * sd;
  std::optional<double> dose;
  for (std::size_t first = 0; first < points.size(); ++first) {
    double sum = 0.0;
    const double side = side_of(points[first].dose);
    for (std::size_t n = 0; n < kDoubtRun && first + n < points.size(); ++n) {
      const DosePoint& point = points[first + n];
      if (side == 0.0 || side_of(point.dose) != side) break;
      sum += side * (point.score - search.target);
      const double wrong = sum / std::sqrt(n + 1.0);
      if (wrong <= most) continue;
      most = wrong;
      dose = points[first + n / 2].dose;
    }
  }
  return dose;
}

/// Whether repetitions at one dose are on the other side of the target than those around.
bool confirmed(const ToleranceSearch& search, const Tolerance& tolerance, const Points& repeated) {
  if (repeated.size() < 3) return false;
  std::vector<double> scores;
  for (const DosePoint& point : repeated) scores.push_back(point.score);
  const MeanInterval of_mean = mean_interval(scores);
  const double sign = tolerance.low && repeated.front().dose < *tolerance.low ? -1.0 : 1.0;
  const auto count = static_cast<double>(scores.size());
  const double t = student_t_quantile(1.0 - kDoubtLevel, static_cast<int>(scores.size()) - 1);
  return sign * (of_mean.mean - search.target) > t * of_mean.sd / std::sqrt(count);
}

/// By the points about the focus.
Tolerance read_window(const ToleranceSearch& search, const DoseFocus& focus, const Points& all) {
  DoseWindow window = window_about(focus, all, search.target);
  Tolerance tolerance;
  tolerance.points = std::move(window.points);
  tolerance.step = window.step;
  if (tolerance.step) {
    tolerance.verdict = ToleranceVerdict::found;
    tolerance.dose = tolerance.step->crossing.dose;
    tolerance.low = tolerance.step->crossing.low;
    tolerance.high = tolerance.step->crossing.high;
  } else {
    tolerance.curve = DoseCurve(tolerance.points, kDoseDegree);
    read_curve(search, *tolerance.curve, all, tolerance);
  }
  return tolerance;
}

/// Whether the mean of the scores at this very dose is surely (95 %) on one side of the target.
bool surely_at(double dose, double sign, const ToleranceSearch& search, const Points& all) {
  std::vector<double> scores;
  for (const DosePoint& point : all)
    if (point.dose == dose) scores.push_back(point.score);
  if (scores.size() < kLeastRepeats) return false;
  const MeanInterval mean = mean_interval(scores);
  return sign > 0.0 ? mean.low > search.target : mean.high < search.target;
}

/// By the trials of all stages, without repetitions.
Tolerance read_stages(const ToleranceSearch& search, std::span<const DoseTrial> trials) {
  const Points all = points_of(trials);
  Tolerance tolerance = read_window(search, focus_after(search, trials, kFineStages), all);
  if (surely_at(search.low, -1.0, search, all)) {
    tolerance.verdict = ToleranceVerdict::below;
    tolerance.low.reset();
    tolerance.high = search.low;
  } else if (surely_at(search.high, 1.0, search, all)) {
    tolerance.verdict = ToleranceVerdict::above;
    tolerance.high.reset();
    tolerance.low = search.high;
  }
  return tolerance;
}

/// Of the errors of two tolerances that curves gave.
double correlation_of(const Tolerance& a, const Tolerance& b) {
  double residuals_a = 0.0, residuals_b = 0.0, residuals = 0.0;  // sums of products, shared trials
  double influences = 0.0;
  for (const DosePoint& of_a : a.points) {
    const auto of_b = std::ranges::find(b.points, of_a.trial, &DosePoint::trial);
    if (of_b == b.points.end()) continue;
    const double error_a = of_a.score - a.curve->at(of_a.dose);
    const double error_b = of_b->score - b.curve->at(of_b->dose);
    residuals_a += error_a * error_a;
    residuals_b += error_b * error_b;
    residuals += error_a * error_b;
    influences += a.curve->influence(of_a.dose, *a.dose) * b.curve->influence(of_b->dose, *b.dose);
  }
  // The influence of a dose on itself is the sum of the squares of all influences on it.
  const double scale = residuals_a * residuals_b * a.curve->influence(*a.dose, *a.dose) *
                       b.curve->influence(*b.dose, *b.dose);
  return scale > 0.0 ? residuals * influences / std::sqrt(scale) : 0.0;
}

}  // namespace

std::vector<double> next_doses(const ToleranceSearch& search, std::span<const DoseTrial> trials) {
  check(search);
  if (trials.empty()) return spaced(search.low, search.high, kCoarseDoses);
  if (too_few(trials)) return {};
  for (int stage = 0; stage < kFineStages; ++stage) {
    const std::size_t before = trials_before(search, stage);
    if (trials.size() != before) continue;
    const DoseFocus focus = focus_after(search, trials, stage);
    std::vector<double> doses = spaced(std::max(search.low, focus.centre - focus.half_width),
                                       std::min(search.high, focus.centre + focus.half_width),
                                       static_cast<int>(trials_before(search, stage + 1) - before));
    if (focus.centre <= search.low || focus.centre >= search.high)
      for (std::size_t n = 0; n < doses.size(); n += 2) doses[n] = focus.centre;
    return doses;
  }
  if (trials.size() != trials_before(search, kFineStages)) return {};
  const auto doubt = doubtful_dose(search, read_stages(search, trials), points_of(trials));
  return doubt ? std::vector<double>(kDoubtTrials, *doubt) : std::vector<double>{};
}

Tolerance tolerance_of(const ToleranceSearch& search, std::span<const DoseTrial> trials) {
  check(search);
  const std::size_t staged = trials_before(search, kFineStages);
  const auto undefined = std::ranges::count_if(
      trials, [](const DoseTrial& trial) { return !trial.score.has_value(); });
  Tolerance tolerance;
  if (trials.size() >= kCoarseDoses && too_few(trials)) {
    tolerance.verdict = ToleranceVerdict::undefined;
    tolerance.trials = static_cast<int>(trials.size());
    tolerance.undefined = static_cast<int>(undefined);
    return tolerance;
  }
  if (trials.size() < staged)
    throw Error(fmt::format("{} of {} trials are there; make those of next_doses first",
                            trials.size(), staged));
  tolerance = read_stages(search, trials.first(staged));
  tolerance.trials = static_cast<int>(trials.size());
  tolerance.undefined = static_cast<int>(undefined);
  if (confirmed(search, tolerance, points_of(trials.subspan(staged))))
    tolerance.verdict = ToleranceVerdict::not_monotone;
  if (tolerance.verdict != ToleranceVerdict::found) tolerance.dose.reset();
  return tolerance;
}

Crossing difference_of(const Tolerance& a, const Tolerance& b) {
  Crossing difference;
  if (a.verdict == ToleranceVerdict::not_monotone || b.verdict == ToleranceVerdict::not_monotone)
    return difference;
  if (!a.dose || !b.dose) {
    if (a.low && b.high) difference.low = *a.low - *b.high;
    if (a.high && b.low) difference.high = *a.high - *b.low;
    return difference;
  }
  const double correlation = a.curve && b.curve ? correlation_of(a, b) : 0.0;
  const auto joined = [correlation](double of_a, double of_b) {
    return std::sqrt(of_a * of_a + of_b * of_b - 2.0 * correlation * of_a * of_b);
  };
  difference.dose = *a.dose - *b.dose;
  if (a.low && b.high)
    difference.low = *difference.dose - joined(*a.dose - *a.low, *b.high - *b.dose);
  if (a.high && b.low)
    difference.high = *difference.dose + joined(*a.high - *a.dose, *b.dose - *b.low);
  return difference;
}

}  // namespace mapscore::eval
