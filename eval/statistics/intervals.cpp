// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/intervals.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace mapscore::eval {
namespace {

constexpr double kConfidence = 0.95;

/// Central moments with 1 / n, of values divided by `scale`.
struct Moments {
  double mean = 0.0;  ///< not divided
  double second = 0.0, third = 0.0;
};

Moments moments_of(std::span<const double> values, double scale) {
  const auto count = static_cast<double>(values.size());
  Moments moments;
  for (const double value : values) moments.mean += value;
  moments.mean /= count;
  for (const double value : values) {
    const double offset = (value - moments.mean) / scale;
    moments.second += offset * offset / count;
    moments.third += offset * offset * offset / count;
  }
  return moments;
}

/// T with T + g T^2 / 3 + g^2 T^3 / 27 = y, i.e. 3 / g (c - 1) with c^3 = 1 + g y, written so that
/// it neither divides by g nor cancels.
double inverse_of_hall(double y, double skewness) {
  const double c = std::cbrt(1.0 + skewness * y);
  return 3.0 * y / (c * c + c + 1.0);
}

/// P(|T| <= t), t >= 0. With theta = atan(t / sqrt(n)): for even n
/// sin(theta) (1 + 1/2 cos^2 + (1 3)/(2 4) cos^4 + ...), for odd n
/// 2/pi (theta + sin(theta) (cos + 2/3 cos^3 + (2 4)/(3 5) cos^5 + ...)), up to the power n - 2.
double central_probability(double t, int degrees) {
  const double theta = std::atan(t / std::sqrt(static_cast<double>(degrees)));
  const double cosine = std::cos(theta);
  const bool odd = degrees % 2 == 1;
  double term = odd ? cosine : 1.0;
  double series = degrees > 1 ? term : 0.0;
  for (int power = odd ? 3 : 2; power <= degrees - 2; power += 2) {
    term *= cosine * cosine * (power - 1) / power;
    series += term;
  }
  const double sum = std::sin(theta) * series;
  return odd ? 2.0 / std::numbers::pi * (theta + sum) : sum;
}

}  // namespace

SeedSummary summarise(std::span<const std::optional<double>> values, const ValueLimits& limits) {
  std::vector<double> defined;
  for (const std::optional<double>& value : values) {
    if (value) defined.push_back(*value);
  }
  SeedSummary summary;
  summary.seeds = static_cast<int>(defined.size());
  summary.undefined = static_cast<int>(values.size() - defined.size());
  if (defined.empty()) return summary;

  summary.kind = SpreadKind::range;
  const auto [least, greatest] = std::minmax_element(defined.begin(), defined.end());
  summary.low = *least;
  summary.high = *greatest;
  summary.mean = defined.front();
  if (defined.size() < 2) return summary;

  const MeanInterval interval = mean_interval(defined);
  summary.mean = interval.mean;
  summary.sd = interval.sd;
  if (summary.seeds < kSeedsForInterval) return summary;
  summary.kind = SpreadKind::interval;
  summary.low = std::max(interval.low, limits.low);
  summary.high = std::min(interval.high, limits.high);
  return summary;
}

MeanInterval mean_interval(std::span<const double> values) {
  if (values.size() < 2) throw Error("mean_interval: fewer than two values; give one a seed");
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  if (*least == *greatest) return {*least, 0.0, *least, *least};  // not the sum's rounding

  const auto count = static_cast<double>(values.size());
  const double scale = *greatest - *least;
  const Moments moments = moments_of(values, scale);
  const double sd = scale * std::sqrt(moments.second * count / (count - 1.0));
  const double skewness = moments.third / std::pow(moments.second, 1.5);
  const double shift = skewness / (6.0 * count);
  const double x =
      student_t_quantile(0.5 + kConfidence / 2.0, static_cast<int>(values.size()) - 1) /
      std::sqrt(count);
  const double above = std::max(x, -inverse_of_hall(-x - shift, skewness));
  const double below = std::max(x, inverse_of_hall(x - shift, skewness));
  return {moments.mean, sd, moments.mean - below * sd, moments.mean + above * sd};
}

double student_t_cdf(double t, int degrees) {
  const double central = central_probability(std::abs(t), degrees);
  return t < 0.0 ? (1.0 - central) / 2.0 : (1.0 + central) / 2.0;
}

double student_t_quantile(double p, int degrees) {
  if (!(p > 0.0 && p < 1.0) || degrees < 1) {
    throw Error(fmt::format(
        "student_t_quantile: p = {}, degrees = {}; give 0 < p < 1, degrees >= 1", p, degrees));
  }
  if (p < 0.5) return -student_t_quantile(1.0 - p, degrees);
  double low = 0.0, high = 1.0;
  while (student_t_cdf(high, degrees) < p) high *= 2.0;
  for (double middle = 0.5 * (low + high); low < middle && middle < high;
       middle = 0.5 * (low + high)) {
    (student_t_cdf(middle, degrees) < p ? low : high) = middle;
  }
  return high;
}

}  // namespace mapscore::eval
