// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/dose_fit.hpp"

#include "core/error.hpp"
#include "eval/statistics/intervals.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace mapscore::eval {
namespace {

constexpr int kStepsOfScan = 400;  ///< of a curve between its ends

double t_975(int degrees) {
  return student_t_quantile(0.975, degrees);
}

/// RSS of a step behind a point; infinite where the next point has the same dose.
struct Split {
  double rss = std::numeric_limits<double>::infinity();
  double above = 0.0, below = 0.0;
};

std::vector<Split> splits_of(std::span<const DosePoint> points) {
  const auto n = static_cast<double>(points.size());
  double offset = 0.0;  // sums of squares about the mean do not cancel
  for (const DosePoint& point : points) offset += point.score / n;
  double squares = 0.0, left = 0.0;
  for (const DosePoint& point : points) squares += (point.score - offset) * (point.score - offset);
  std::vector<Split> splits(points.size() - 1);
  for (std::size_t i = 0; i < splits.size(); ++i) {
    left += points[i].score - offset;
    if (points[i + 1].dose <= points[i].dose) continue;
    const auto n_left = static_cast<double>(i + 1), n_right = n - n_left;
    splits[i] = {std::max(0.0, squares - left * left / n_left - left * left / n_right),
                 offset + left / n_left, offset - left / n_right};
  }
  return splits;
}

/// Where a condition that differs at both doses changes.
double change_between(double a, double b, const std::function<bool(double)>& holds) {
  const bool at_a = holds(a);
  for (double middle = 0.5 * (a + b); middle > std::min(a, b) && middle < std::max(a, b);
       middle = 0.5 * (a + b))
    (holds(middle) == at_a ? a : b) = middle;
  return b;
}

}  // namespace

DoseCurve::DoseCurve(std::span<const DosePoint> points, int degree)
    : degrees_(static_cast<int>(points.size()) - degree - 1) {
  if (degrees_ < 1) throw Error("DoseCurve: too few points; give more trials");
  const auto [least, most] = std::ranges::minmax_element(points, {}, &DosePoint::dose);
  centre_ = 0.5 * (least->dose + most->dose);
  scale_ = std::max(0.5 * (most->dose - least->dose), std::numeric_limits<double>::min());
  coefficients_.resize(degree + 1);
  Eigen::MatrixXd design(points.size(), degree + 1);
  Eigen::VectorXd scores(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    design.row(static_cast<Eigen::Index>(i)) = powers(points[i].dose);
    scores[static_cast<Eigen::Index>(i)] = points[i].score;
  }
  t_ = t_975(degrees_);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(design);
  if (solver.rank() <= degree) throw Error("DoseCurve: too few doses; give more trials");
  coefficients_ = solver.solve(scores);
  residual_sd_ = (scores - design * coefficients_).norm() / std::sqrt(degrees_);
  unit_covariance_ = (design.transpose() * design)
                         .householderQr()
                         .solve(Eigen::MatrixXd::Identity(degree + 1, degree + 1));
}

Eigen::VectorXd DoseCurve::powers(double dose) const {
  Eigen::VectorXd powers(coefficients_.size());
  powers[0] = 1.0;
  for (Eigen::Index n = 1; n < powers.size(); ++n)
    powers[n] = powers[n - 1] * (dose - centre_) / scale_;
  return powers;
}

double DoseCurve::slope(double dose) const {
  const Eigen::VectorXd of_dose = powers(dose);
  double slope = 0.0;
  for (Eigen::Index n = 1; n < of_dose.size(); ++n)
    slope += static_cast<double>(n) * coefficients_[n] * of_dose[n - 1] / scale_;
  return slope;
}

double DoseCurve::half_width(double dose) const {
  return t_ * residual_sd_ * std::sqrt(influence(dose, dose));
}

double DoseCurve::influence(double of, double dose) const {
  return powers(of).dot(unit_covariance_ * powers(dose));
}

double DoseCurve::p_of_highest() const {
  const Eigen::Index highest = coefficients_.size() - 1;
  const double error = residual_sd_ * std::sqrt(unit_covariance_(highest, highest));
  if (error <= 0.0) return coefficients_[highest] == 0.0 ? 1.0 : 0.0;
  return 2.0 * (1.0 - student_t_cdf(std::abs(coefficients_[highest]) / error, degrees_));
}

Crossing curve_crossing(const DoseCurve& curve, double target, double first, double last) {
  const auto dose_at = [&](int step) { return first + (last - first) * step / kStepsOfScan; };
  const auto keeps = [&](double dose) { return curve.at(dose) >= target; };
  const auto holds = [&](double dose) {
    return std::abs(curve.at(dose) - target) <= curve.half_width(dose);
  };
  int at = 0;
  while (at < kStepsOfScan && !(keeps(dose_at(at)) && !keeps(dose_at(at + 1)))) ++at;
  if (at == kStepsOfScan) return {};
  const double dose = change_between(dose_at(at), dose_at(at + 1), keeps);
  const auto end = [&](int step, int stride) -> std::optional<double> {
    double inside = dose;
    for (; step >= 0 && step <= kStepsOfScan; step += stride) {
      if (!holds(dose_at(step))) return change_between(inside, dose_at(step), holds);
      inside = dose_at(step);
    }
    return std::nullopt;
  };
  return {dose, end(at, -1), end(at + 1, 1)};
}

std::optional<DoseStep> step_through(std::span<const DosePoint> points, double target) {
  const std::vector<Split> splits = splits_of(points);
  const auto best =
      static_cast<std::size_t>(std::ranges::min_element(splits, {}, &Split::rss) - splits.begin());
  const Split& step = splits[best];
  if (!(step.above > target && step.below < target)) return std::nullopt;
  const int degrees = static_cast<int>(points.size()) - 3;
  const double most = step.rss * (1.0 + t_975(degrees) * t_975(degrees) / degrees);
  std::size_t first = best, last = best;
  for (std::size_t i = 0; i < splits.size(); ++i) {
    if (splits[i].rss > most) continue;
    first = std::min(first, i);
    last = std::max(last, i);
  }
  const auto misses = [target](const DosePoint& point) { return point.score < target; };
  const auto first_missing =
      static_cast<std::size_t>(std::ranges::find_if(points, misses) - points.begin());
  std::size_t last_keeping = points.size() - 1;
  while (last_keeping > 0 && misses(points[last_keeping])) --last_keeping;
  first = std::min(first, std::max<std::size_t>(first_missing, 1) - 1);
  last = std::max(last, std::min(last_keeping, points.size() - 2));
  const double middle = 0.5 * (points[best].dose + points[best + 1].dose);
  return DoseStep{
      {middle, points[first].dose, points[last + 1].dose}, step.above, step.below, step.rss};
}

}  // namespace mapscore::eval
