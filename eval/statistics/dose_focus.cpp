// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/dose_focus.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

namespace mapscore::eval {
namespace {

constexpr double kCurvatureLevel = 0.2;  ///< a curve must hold well, so that its bias stays small
constexpr double kGapsAtFirst = 1.5;     ///< half of the first focus, in gaps of the first stage
constexpr double kLeastGaps = 0.25;      ///< half of any focus
constexpr double kWidthInDeviations = 3.0;  ///< residual_sd / |slope| that half a focus spans
constexpr double kCloser = 0.5;             ///< half of the next focus over a bent window
constexpr double kReach = 1.25;             ///< of a window, in half widths of the focus

using Points = std::vector<DosePoint>;

double gap_of(const ToleranceSearch& search) {
  return (search.high - search.low) / (kCoarseDoses - 1);
}

/// Between the last dose that keeps the target and the first that does not, by the falling curve
/// that is nearest to the scores (pool adjacent violators); an end of the range without both.
double falling_root(const ToleranceSearch& search, const Points& points) {
  struct Block {
    double sum;
    int count;
    [[nodiscard]] double mean() const { return sum / count; }
  };
  std::vector<Block> blocks;
  for (const DosePoint& point : points) {
    blocks.push_back({point.score, 1});
    for (std::size_t n = blocks.size(); n > 1 && blocks[n - 2].mean() < blocks[n - 1].mean(); --n) {
      blocks[n - 2] = {blocks[n - 2].sum + blocks[n - 1].sum,
                       blocks[n - 2].count + blocks[n - 1].count};
      blocks.pop_back();
    }
  }
  std::size_t keeping = 0;
  for (const Block& block : blocks)
    if (block.mean() >= search.target) keeping += static_cast<std::size_t>(block.count);
  if (keeping == 0) return search.low;
  if (keeping == points.size()) return search.high;
  return 0.5 * (points[keeping - 1].dose + points[keeping].dose);
}

int different_doses(std::span<const DosePoint> points) {
  std::set<double> doses;
  for (const DosePoint& point : points) doses.insert(point.dose);
  return static_cast<int>(doses.size());
}

/// Whether a curve of the next degree, or a step, is clearly better: the step by
/// n ln(RSS / RSS_step) > 2 ln n, since it may have two parameters more.
bool curve_holds(const Points& points, const std::optional<DoseStep>& step) {
  if (DoseCurve(points, kDoseDegree + 1).p_of_highest() < kCurvatureLevel) return false;
  const double rss = DoseCurve(points, kDoseDegree).rss();
  const auto n = static_cast<double>(points.size());
  return !step || step->rss >= rss || n * std::log(rss / step->rss) <= 2.0 * std::log(n);
}

}  // namespace

DoseFocus first_focus(const ToleranceSearch& search, const Points& points) {
  return {falling_root(search, points), kGapsAtFirst * gap_of(search)};
}

DoseWindow window_about(const DoseFocus& focus, const Points& all, double target) {
  Points nearest = all;
  const auto distance = [&focus](const DosePoint& point) {
    return std::abs(point.dose - focus.centre);
  };
  std::ranges::stable_sort(nearest, {}, distance);
  const auto near = static_cast<std::size_t>(std::ranges::count_if(
      all, [&](const DosePoint& point) { return distance(point) <= kReach * focus.half_width; }));
  std::size_t least = kLeastPoints;
  while (least < all.size() && different_doses(std::span(nearest).first(least)) < kDoseDegree + 2)
    ++least;
  DoseWindow window;
  for (std::size_t count = std::max(least, std::clamp(near, all.size() / 3, all.size() * 3 / 4));;
       count = std::max(least, count * 7 / 8)) {
    window.points.assign(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(count));
    std::ranges::stable_sort(window.points, {}, &DosePoint::dose);
    window.step = step_through(window.points, target);
    window.bent = !curve_holds(window.points, window.step);
    if (!window.bent) window.step.reset();
    if (!window.bent || count <= least) return window;
  }
}

DoseFocus refined(const ToleranceSearch& search, const DoseFocus& focus, const Points& points) {
  const DoseWindow window = window_about(focus, points, search.target);
  const double least = kLeastGaps * gap_of(search), most = 0.5 * (search.high - search.low);
  if (window.step) {
    const Crossing& of_step = window.step->crossing;
    return {0.5 * (*of_step.low + *of_step.high), std::max(least, *of_step.high - *of_step.low)};
  }
  const DoseCurve curve(window.points, kDoseDegree);
  const bool may_cross = std::ranges::any_of(window.points, [&](const DosePoint& point) {
    return std::abs(curve.at(point.dose) - search.target) <= curve.half_width(point.dose);
  });
  const double first = window.points.front().dose, last = window.points.back().dose;
  const auto root = curve_crossing(curve, search.target, first, last).dose;
  if (window.bent || (!root && !may_cross))
    return {falling_root(search, points), std::max(least, kCloser * focus.half_width)};
  const DoseCurve line(window.points, 1);
  const double slope = root ? curve.slope(*root) : line.slope(first);
  if (slope >= 0.0) return focus;
  const double centre = root.value_or(first + (search.target - line.at(first)) / slope);
  return {std::clamp(centre, first, last),
          std::clamp(kWidthInDeviations * curve.residual_sd() / -slope, least, most)};
}

}  // namespace mapscore::eval
