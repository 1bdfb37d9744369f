// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/dose_fit.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"
#include "eval/statistics/intervals.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mapscore::eval {
namespace {

std::vector<DosePoint> falling_points() {
  std::vector<DosePoint> points;
  RandomStream random(3, "falling points");
  for (int n = 0; n < 20; ++n) points.push_back({0.5 * n, 1.0 - 0.05 * n + 0.02 * random.normal()});
  return points;
}

TEST(DoseCurve, PassesThroughPointsOfItsDegree) {
  std::vector<DosePoint> points;
  for (const double dose : {0.0, 1.0, 2.0, 4.0, 7.0}) points.push_back({dose, 3.0 - dose * dose});
  const DoseCurve curve(points, 2);
  EXPECT_NEAR(curve.at(3.0), -6.0, 1e-12);
  EXPECT_NEAR(curve.slope(3.0), -6.0, 1e-12);
  EXPECT_NEAR(curve.residual_sd(), 0.0, 1e-12);
  EXPECT_LT(curve.p_of_highest(), 1e-6);
  EXPECT_THROW(DoseCurve(std::span(points).first(3), 2), Error);
  EXPECT_THROW(DoseCurve(std::vector<DosePoint>(9, {1.0, 2.0}), 1), Error);
}

TEST(DoseCurve, CrossingOfALineIsFiellersInterval) {
  // The closed form, from plain sums.
  const std::vector<DosePoint> points = falling_points();
  const double n = 20.0, target = 0.6;
  double mx = 0, my = 0, sxx = 0, sxy = 0, rss = 0;
  for (const auto& [x, y, trial] : points) mx += x / n, my += y / n;
  for (const auto& [x, y, trial] : points) sxx += (x - mx) * (x - mx), sxy += (x - mx) * (y - my);
  const double b = sxy / sxx;
  for (const auto& [x, y, trial] : points) rss += std::pow(y - my - b * (x - mx), 2);
  const double t = student_t_quantile(0.975, 18), s = std::sqrt(rss / 18);
  const double root = mx + (target - my) / b, g = t * t * s * s / (b * b * sxx);
  const double middle = mx + (root - mx) / (1 - g);
  const double half =
      t * s / std::abs(b) / (1 - g) * std::sqrt((1 - g) / n + (root - mx) * (root - mx) / sxx);
  const Crossing crossing = curve_crossing(DoseCurve(points, 1), target, 0.0, 9.5);
  EXPECT_NEAR(crossing.dose.value(), root, 1e-9);
  EXPECT_NEAR(crossing.low.value(), middle - half, 1e-9);
  EXPECT_NEAR(crossing.high.value(), middle + half, 1e-9);
}

TEST(DoseCurve, ASideIsOpenWhereTheBandHoldsTheTargetToTheEnd) {
  const DoseCurve line(falling_points(), 1);
  const double root = curve_crossing(line, 0.6, 0.0, 9.5).dose.value();
  const Crossing cut = curve_crossing(line, 0.6, root - 1e-3, 9.5);
  EXPECT_FALSE(cut.low);
  EXPECT_TRUE(cut.dose && cut.high);
  EXPECT_FALSE(curve_crossing(line, 5.0, 0.0, 9.5).dose);
  std::vector<DosePoint> rising = falling_points();
  for (DosePoint& point : rising) point.score = -point.score;
  EXPECT_FALSE(curve_crossing(DoseCurve(rising, 1), -0.6, 0.0, 9.5).dose);
}

TEST(DoseStep, LiesInTheGapAndHoldsScoresOnTheWrongSide) {
  std::vector<DosePoint> points;
  for (int n = 0; n < 10; ++n) points.push_back({1.0 * n, (n < 6 ? 0.9 : 0.3) + 0.001 * (n % 2)});
  const auto step = step_through(points, 0.5);
  ASSERT_TRUE(step);
  EXPECT_EQ(step->crossing.dose, 5.5);
  EXPECT_EQ(step->crossing.low, 5.0);
  EXPECT_EQ(step->crossing.high, 6.0);
  points[4].score = 0.45;  // below the target, left of the step
  const auto wider = step_through(points, 0.5);
  ASSERT_TRUE(wider);
  EXPECT_EQ(wider->crossing.low, 3.0);
  EXPECT_FALSE(step_through(points, 0.95));
}

}  // namespace
}  // namespace mapscore::eval
