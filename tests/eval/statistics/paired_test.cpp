// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/paired.hpp"

#include "core/random_stream.hpp"
#include "tests/support/expect_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using Values = std::vector<std::optional<double>>;

/// Every pattern from scratch; differences are whole, so that sums are exact.
double plain_p(const std::vector<double>& differences) {
  double seen = 0.0;
  for (const double difference : differences) seen += difference;
  int hits = 0;
  const int patterns = 1 << differences.size();
  for (int pattern = 0; pattern < patterns; ++pattern) {
    double sum = 0.0;
    for (std::size_t i = 0; i < differences.size(); ++i)
      sum += (pattern >> i & 1) != 0 ? -differences[i] : differences[i];
    hits += std::abs(sum) >= std::abs(seen) ? 1 : 0;
  }
  return static_cast<double>(hits) / patterns;
}

TEST(SignFlip, EqualsBruteForceOverAllPatterns) {
  for (std::uint64_t study = 0; study < 300; ++study) {
    RandomStream random(3, "brute force", {study});
    std::vector<double> whole(1 + random.bits() % 11), tiny;
    const auto span = static_cast<double>(1 + random.bits() % 20);  // few values: ties, zeros
    for (double& d : whole) d = std::floor(span * random.uniform()) - std::floor(span / 3.0);
    for (const double d : whole) tiny.push_back(1e-5 * d);
    const double plain = plain_p(whole);
    ASSERT_DOUBLE_EQ(sign_flip_p(whole), plain) << study;
    ASSERT_DOUBLE_EQ(sign_flip_p(tiny), plain) << study;
  }
}

TEST(SignFlip, EqualsScipy) {
  // scipy.stats.permutation_test((d,), numpy.mean, permutation_type='samples', n_resamples=inf).
  EXPECT_EQ(sign_flip_p(std::vector{.012, -.004, .031, .008, .019, -.011, .025, .003, .014, .006}),
            38.0 / 1024.0);
  EXPECT_EQ(sign_flip_p(std::vector<double>{1, -2, 3, -4, 5, 6, -7, 8}), 0.546875);
  EXPECT_EQ(sign_flip_p(std::vector{.5, .5, -.5, .5, .5, .5, -.5, .5, .5, .5, .5, .5}),
            158.0 / 4096.0);
}

TEST(SignFlip, SmallCasesByHand) {
  EXPECT_EQ(sign_flip_p(std::vector<double>{}), 1.0);
  EXPECT_EQ(sign_flip_p(std::vector{0.3}), 1.0);
  EXPECT_EQ(sign_flip_p(std::vector{0.3, 0.1}), 0.5);
  EXPECT_EQ(sign_flip_p(std::vector{0.3, -0.1}), 1.0);
  EXPECT_EQ(sign_flip_p(std::vector{0.0, 0.0, 0.0}), 1.0);
  EXPECT_EQ(sign_flip_p(std::vector{0.0, 0.3, 0.1, 0.0}), 0.5);  // zeros change nothing
  const std::vector<double> ten{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  EXPECT_EQ(sign_flip_p(ten), 2.0 / 1024.0);
  EXPECT_EQ(sign_flip_p(ten), least_sign_flip_p(10));
  EXPECT_EQ(sign_flip_p(std::vector<double>(20, 1.0)), 2.0 / 1048576.0);
  EXPECT_EQ(least_sign_flip_p(1), 1.0);
  EXPECT_EQ(least_sign_flip_p(0), 1.0);
}

TEST(SignFlip, CountsSumsThatRoundingAloneParts) {
  // 0.3 - 0.1 and 0.9 - 0.7 are both 0.2, but not as doubles; likewise 0.1 + 0.2 and 0.3.
  const std::vector<double> d{0.3 - 0.1, 0.9 - 0.7, 0.1 + 0.2, -0.3};
  ASSERT_NE(d[0], d[1]);
  // |sum| is 0.4 + 0. Of the 16 patterns x + y, x in {.4, 0, 0, -.4}, y in {.6, 0, 0, -.6}, 0 + 0
  // (4) and .4 - .6 (2) are smaller.
  EXPECT_EQ(sign_flip_p(d), 10.0 / 16.0);
}

TEST(SignFlip, AboveTwentyDifferencesDrawsPatternsAndRepeatsThem) {
  // The exact p, 0.0041449, was counted over all 2^24 patterns by convolution of whole hundredths.
  const std::vector<double> d{.65,  1.12, .63,  -1.0, 1.21, .75, -.24, .88, .66, .59, .33,  .85,
                              -.44, .14,  -.18, .9,   .34,  .01, -.48, .04, .31, .02, 1.59, 1.31};
  const double p = sign_flip_p(d);
  EXPECT_NEAR(p, 0.0041449, 5 * std::sqrt(0.0041449 / 1e5));
  EXPECT_EQ(p, sign_flip_p(d));
  EXPECT_EQ(sign_flip_p(std::vector<double>(70, 1.0)), 1e-5);
  EXPECT_EQ(least_sign_flip_p(70), 1e-5);
}

TEST(SignFlip, IsUniformWithoutADifference) {
  // Eight symmetric differences: p is k / 128, each k as likely. 16 cells of 8 steps, 16000
  // studies; chi-squared with 15 degrees of freedom exceeds 44.3 once in 10^4.
  constexpr int kStudies = 16000;
  std::array<int, 16> cells{};
  for (std::uint64_t study = 0; study < kStudies; ++study) {
    RandomStream random(5, "null", {study});
    std::vector<double> d(8);
    for (double& difference : d) difference = std::pow(random.normal(), 3.0);
    const int step = static_cast<int>(std::lround(128.0 * sign_flip_p(d)));
    ASSERT_GE(step, 1);
    ++cells[static_cast<std::size_t>((step - 1) / 8)];
  }
  double chi_squared = 0.0;
  for (const int count : cells) chi_squared += (count - 1000.0) * (count - 1000.0) / 1000.0;
  EXPECT_LT(chi_squared, 44.3);
}

TEST(Holm, ByHand) {
  // 0.01 x 4; 0.02 x 3; 0.03 x 2 = 0.06, no less than before; 0.5 x 1. The undefined row is none.
  const Values p{0.03, 0.01, std::nullopt, 0.5, 0.02};
  const Values adjusted = holm_adjusted(p);
  ASSERT_EQ(adjusted.size(), 5u);
  EXPECT_DOUBLE_EQ(*adjusted[0], 0.06);
  EXPECT_DOUBLE_EQ(*adjusted[1], 0.04);
  EXPECT_EQ(adjusted[2], std::nullopt);
  EXPECT_DOUBLE_EQ(*adjusted[3], 0.5);
  EXPECT_DOUBLE_EQ(*adjusted[4], 0.06);
  EXPECT_EQ(holm_adjusted(Values{0.9, 0.8}), (Values{1.0, 1.0}));
  EXPECT_TRUE(holm_adjusted(Values{}).empty());
}

TEST(ComparePaired, TakesThePairsAndCountsTheRest) {
  const Values a{0.9, std::nullopt, 0.8, 0.7, std::nullopt};
  const Values b{0.5, 0.5, 0.6, std::nullopt, std::nullopt};
  const PairedComparison comparison = compare_paired(a, b);
  EXPECT_EQ(comparison.difference.seeds, 2);
  EXPECT_EQ(comparison.difference.undefined, 3);
  EXPECT_DOUBLE_EQ(*comparison.difference.mean, 0.3);
  EXPECT_DOUBLE_EQ(*comparison.mean_a, 0.85);
  EXPECT_DOUBLE_EQ(*comparison.mean_b, 0.55);
  EXPECT_EQ(comparison.difference.kind, SpreadKind::range);
  EXPECT_EQ(comparison.p, 0.5);
  EXPECT_TRUE(comparison.exact);
}

TEST(ComparePaired, SeesAConstantGainUnderLargeDifferencesOfTheSeeds) {
  Values a, b;
  for (int seed = 0; seed < 10; ++seed) {
    b.emplace_back(0.09 * seed);
    a.emplace_back(0.09 * seed + 0.01 + 0.001 * seed);
  }
  const PairedComparison comparison = compare_paired(a, b);
  EXPECT_EQ(comparison.difference.kind, SpreadKind::interval);
  EXPECT_NEAR(*comparison.difference.mean, 0.0145, 1e-12);
  EXPECT_GT(*comparison.difference.low, 0.01);
  EXPECT_EQ(comparison.p, 2.0 / 1024.0);
}

TEST(ComparePaired, SwappingTheMethodsMirrorsTheAnswer) {
  for (std::uint64_t study = 0; study < 200; ++study) {
    RandomStream random(9, "swap", {study});
    Values a, b;
    for (std::uint64_t seed = 0; seed < 8 + study % 8; ++seed) {
      a.emplace_back(random.uniform());
      b.emplace_back(std::pow(random.uniform(), 3.0));
    }
    const PairedComparison ab = compare_paired(a, b), ba = compare_paired(b, a);
    ASSERT_EQ(ab.p, ba.p);
    ASSERT_EQ(ab.mean_a, ba.mean_b);
    ASSERT_NEAR(*ab.difference.mean, -*ba.difference.mean, 1e-15);
    ASSERT_NEAR(*ab.difference.low, -*ba.difference.high, 1e-12);
  }
}

TEST(ComparePaired, SaysWhenPIsNotExact) {
  const Values zeros(25, 0.0), ones(25, 1.0);
  EXPECT_FALSE(compare_paired(ones, zeros).exact);
  EXPECT_EQ(compare_paired(ones, zeros).p, 1e-5);
  EXPECT_TRUE(compare_paired(ones, ones).exact);
  EXPECT_EQ(compare_paired(ones, ones).p, 1.0);
}

TEST(ComparePaired, WithoutAPairHasNothing) {
  const PairedComparison comparison =
      compare_paired(Values{0.5, std::nullopt}, Values{std::nullopt, 0.5});
  EXPECT_EQ(comparison.difference.kind, SpreadKind::none);
  EXPECT_EQ(comparison.difference.mean, std::nullopt);
  EXPECT_EQ(comparison.p, std::nullopt);
  expect_error("1 values against 2", [] { (void)compare_paired(Values{0.5}, Values{0.5, 0.5}); });
}

}  // namespace
}  // namespace mapscore::eval
