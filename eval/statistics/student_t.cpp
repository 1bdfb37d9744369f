// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/student_t.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace mapscore::eval {

namespace {

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
