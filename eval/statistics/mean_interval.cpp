// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/mean_interval.hpp"

#include "core/error.hpp"
#include "eval/statistics/student_t.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

}  // namespace

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

}  // namespace mapscore::eval
