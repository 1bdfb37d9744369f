// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/random_stream.hpp"
#include "eval/statistics/intervals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

double t_quantile(std::size_t n) {
  return student_t_quantile(0.975, static_cast<int>(n) - 1) / std::sqrt(static_cast<double>(n));
}

/// The definition as it stands: raw moments in extended precision, Hall's cubic by bisection.
MeanInterval plain_interval(const std::vector<double>& values) {
  const auto n = static_cast<long double>(values.size());
  long double s1 = 0, s2 = 0, s3 = 0;
  for (const long double v : values) s1 += v, s2 += v * v, s3 += v * v * v;
  const long double mean = s1 / n;
  const long double variance = s2 / n - mean * mean;
  const long double third = s3 / n - 3 * mean * s2 / n + 2 * mean * mean * mean;
  const long double g = third / std::pow(variance, 1.5L), s = std::sqrt(variance * n / (n - 1));
  const auto inverse = [&](long double y) {
    long double low = -1000, high = 1000;
    for (int step = 0; step < 200; ++step) {
      const long double T = (low + high) / 2;
      (T + g * T * T / 3 + g * g * T * T * T / 27 + g / (6 * n) < y ? low : high) = T;
    }
    return low;
  };
  const long double x = t_quantile(values.size());
  return {static_cast<double>(mean), static_cast<double>(s),
          static_cast<double>(mean - s * std::max(x, inverse(x))),
          static_cast<double>(mean - s * std::min(-x, inverse(-x)))};
}

TEST(MeanInterval, EqualsItsPlainTwin) {
  for (std::uint64_t study = 0; study < 2000; ++study) {
    RandomStream random(1, "twin", {study});
    std::vector<double> values(2 + random.bits() % 40);
    const double power = 0.2 + 5.0 * random.uniform();
    for (double& value : values) value = std::pow(random.uniform(), power);
    const MeanInterval got = mean_interval(values), plain = plain_interval(values);
    ASSERT_NEAR(got.mean, plain.mean, 1e-12) << study;
    ASSERT_NEAR(got.sd, plain.sd, 1e-12) << study;
    ASSERT_NEAR(got.low, plain.low, 1e-9) << study;
    ASSERT_NEAR(got.high, plain.high, 1e-9) << study;
  }
}

TEST(MeanInterval, EqualsLimitsFoundByScipy) {
  // scipy.stats.skew, t.ppf and optimize.brentq on the cubic. Of Student t the limits are
  // 0.94076365857583 and 1.00323634142417, of Hall 0.8688539082008468 and 0.992450734.
  const MeanInterval one_failed =
      mean_interval(std::vector{.99, .98, .99, .97, 1.0, .99, .98, .85, .99, .98});
  EXPECT_NEAR(one_failed.low, 0.8688539082008468, 1e-12);
  EXPECT_NEAR(one_failed.high, 1.00323634142417, 1e-12);
  // Student t 0.0011510727, 0.0194489273; Hall 0.0011094650, 0.0194077963.
  const MeanInterval nearly_symmetric =
      mean_interval(std::vector{.012, -.004, .031, .008, .019, -.011, .025, .003, .014, .006});
  EXPECT_NEAR(nearly_symmetric.low, 0.001109464952540818, 1e-12);
  EXPECT_NEAR(nearly_symmetric.high, 0.019448927282889616, 1e-12);
}

TEST(MeanInterval, MovesScalesAndMirrorsWithTheValues) {
  const std::vector<double> values{0, 1, 1, 2, 2, 3, 5, 8, 13, 40};
  const MeanInterval base = mean_interval(values);
  for (const double scale : {1e-200, 0.01, 3.0, -1.0, 1e200}) {
    for (const double shift : {0.0, 7.0 * scale}) {
      std::vector<double> changed;
      for (const double value : values) changed.push_back(shift + scale * value);
      const MeanInterval got = mean_interval(changed);
      const double slack = 1e-12 * std::abs(scale) * 40;
      EXPECT_NEAR(got.low, shift + scale * (scale > 0 ? base.low : base.high), slack);
      EXPECT_NEAR(got.high, shift + scale * (scale > 0 ? base.high : base.low), slack);
    }
  }
}

TEST(MeanInterval, HasNoLengthForEqualValuesAndStaysFiniteNextToThem) {
  const MeanInterval equal = mean_interval(std::vector<double>(10, 0.1));
  EXPECT_EQ(equal.mean, 0.1);
  EXPECT_EQ(equal.sd, 0.0);
  EXPECT_EQ(equal.low, 0.1);
  EXPECT_EQ(equal.high, 0.1);
  std::vector<double> nearly(10, 0.1);
  nearly.back() = std::nextafter(0.1, 1.0);
  EXPECT_NEAR(mean_interval(nearly).low, 0.1, 1e-15);
  EXPECT_NEAR(mean_interval(nearly).high, 0.1, 1e-15);
  EXPECT_THROW(static_cast<void>(mean_interval(std::vector<double>{1.0})), Error);
}

// ---- coverage: the share of simulated studies whose interval holds the true mean ----

using Draw = std::function<double(RandomStream&)>;

struct Distribution {
  const char* name;
  double mean;
  Draw draw;
};

double exponential(RandomStream& random) {
  return -std::log(1.0 - random.uniform());
}

double two_valued(RandomStream& random, double share_low, double low, double high) {
  return random.uniform() < share_low ? low : high;
}

/// Beta(a, b) by rejection: U^(1/a) / (U^(1/a) + V^(1/b)) where the sum is at most 1.
double beta(RandomStream& random, double a, double b) {
  for (;;) {
    const double x = std::pow(random.uniform(), 1.0 / a), y = std::pow(random.uniform(), 1.0 / b);
    if (x + y > 0.0 && x + y <= 1.0) return x / (x + y);
  }
}

double binomial_share(RandomStream& random) {
  int hits = 0;
  for (int i = 0; i < 10; ++i) hits += random.uniform() < 0.9 ? 1 : 0;
  return hits / 10.0;
}

/// What figures of a seed look like: symmetric, crowded below their limit, skewed either way, of a
/// few values, of two kinds of seed.
std::vector<Distribution> distributions_of_scores() {
  return {
      {"normal", 0.8, [](RandomStream& r) { return 0.8 + 0.05 * r.normal(); }},
      {"uniform", 0.5, [](RandomStream& r) { return r.uniform(); }},
      {"Beta(20, 1)", 20.0 / 21.0, [](RandomStream& r) { return std::pow(r.uniform(), 0.05); }},
      {"Beta(8, 0.8)", 8.0 / 8.8, [](RandomStream& r) { return beta(r, 8.0, 0.8); }},
      {"exponential", 1.0, exponential},
      {"mirrored exponential", 0.98, [](RandomStream& r) { return 1.0 - 0.02 * exponential(r); }},
      {"lognormal(0.5)", std::exp(0.125), [](RandomStream& r) { return std::exp(r.normal() / 2); }},
      {"rounded normal", 0.0, [](RandomStream& r) { return std::round(0.8 * r.normal()); }},
      {"tenths of Binomial(10, 0.9)", 0.9, binomial_share},
      {"two values, 50 %", 0.9, [](RandomStream& r) { return two_valued(r, 0.5, 0.8, 1.0); }},
      {"two values, 30 %", 0.94, [](RandomStream& r) { return two_valued(r, 0.3, 0.8, 1.0); }},
      {"two kinds of seed, 30 %", 0.84,
       [](RandomStream& r) { return two_valued(r, 0.3, 0.7, 0.9) + 0.02 * r.normal(); }},
  };
}

struct Simulated {
  double coverage = 0.0;
  double length = 0.0;  ///< mean, by that of Student t
};

Simulated simulate(const Distribution& distribution, std::size_t seeds, int studies) {
  int covered = 0;
  double length = 0.0, length_of_t = 0.0;
  const double x = t_quantile(seeds);
  for (int study = 0; study < studies; ++study) {
    RandomStream random(7, distribution.name, {static_cast<std::uint64_t>(study)});
    std::vector<double> values(seeds);
    for (double& value : values) value = distribution.draw(random);
    const MeanInterval interval = mean_interval(values);
    covered +=
        interval.low <= distribution.mean + 1e-12 && distribution.mean - 1e-12 <= interval.high;
    length += interval.high - interval.low;
    length_of_t += 2.0 * x * interval.sd;
  }
  return {static_cast<double>(covered) / studies, length / length_of_t};
}

TEST(Coverage, IsAtLeast92PercentAtTenSeeds) {
  // Standard error of a share near 0.945 in 10000 studies: 0.0023; the least of the true shares is
  // 0.943, ten of them above 0.92.
  for (const Distribution& distribution : distributions_of_scores()) {
    const Simulated simulated = simulate(distribution, 10, 10000);
    RecordProperty(distribution.name, std::to_string(simulated.coverage));
    EXPECT_GE(simulated.coverage, 0.92) << distribution.name;
    EXPECT_GE(simulated.length, 1.0) << distribution.name;
    EXPECT_LE(simulated.length, 1.7) << distribution.name;
  }
}

TEST(Coverage, OfNormalSeedsIsNominalAndTheIntervalHardlyLonger) {
  for (const std::size_t seeds : {10, 20, 50}) {
    const Simulated simulated =
        simulate(distributions_of_scores().front(), seeds, seeds == 10 ? 20000 : 8000);
    EXPECT_GE(simulated.coverage, 0.943) << seeds;  // four standard errors below 0.955
    EXPECT_LE(simulated.coverage, 0.967) << seeds;
    EXPECT_LE(simulated.length, seeds == 10 ? 1.14 : 1.06) << seeds;
  }
}

TEST(Coverage, HasNoRemedyForWhatTenSeedsSeldomShow) {
  // One seed in ten fails: 0.9^10 = 35 % of the studies see no failure and take the mean for 1.
  const Distribution rare{"two values, 10 %", 0.98,
                          [](RandomStream& r) { return two_valued(r, 0.1, 0.8, 1.0); }};
  EXPECT_NEAR(simulate(rare, 10, 4000).coverage, 1.0 - std::pow(0.9, 10), 0.03);
}

}  // namespace
}  // namespace mapscore::eval
