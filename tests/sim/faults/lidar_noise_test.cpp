// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/lidar_noise.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mapscore::sim {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

TEST(LidarNoise, ZeroDosesChangeNoBit) {
  const std::vector<float> clean = {0.0f, 0.2f, 3.3333333f, 11.9999f, kNothing};
  std::vector<float> noisy = clean;
  add_lidar_noise({0.0, 0.0, 0.0, 0.15, 12.0}, 7, 3, noisy);
  EXPECT_EQ(noisy, clean);
}

// 200 000 beams: a sigma is known to 0.16 %, a rate of 0.2 to 0.45 %.
TEST(LidarNoise, StatisticsAreTheDoses) {
  const LidarNoise noise{0.01, 0.02, 0.2, 0.15, 12.0};
  for (const float range_m : {0.5f, 2.0f, 6.0f}) {
    double sum = 0.0, squares = 0.0;
    int kept = 0, all = 0;
    for (std::uint64_t scan = 0; scan < 200; ++scan) {
      std::vector<float> ranges(1000, range_m);
      add_lidar_noise(noise, 1, scan, ranges);
      for (const float r : ranges) {
        ++all;
        if (r == 0.0f) continue;
        ++kept;
        sum += r - range_m;
        squares += (r - range_m) * (r - range_m);
      }
    }
    const double sigma = std::hypot(0.01, 0.02 * range_m);
    EXPECT_NEAR(1.0 - static_cast<double>(kept) / all, 0.2, 0.02 * 0.2);
    EXPECT_NEAR(std::sqrt(squares / kept), sigma, 0.02 * sigma);
    EXPECT_NEAR(sum / kept, 0.0, 5.0 * sigma / std::sqrt(kept));
  }
}

TEST(LidarNoise, DrawsDoNotDependOnTheDose) {
  std::vector<float> one(50, 2.0f), two(50, 2.0f);
  add_lidar_noise({0.01, 0.0, 0.0, 0.15, 12.0}, 5, 9, one);
  add_lidar_noise({0.02, 0.0, 0.3, 0.15, 12.0}, 5, 9, two);
  int dropped = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (two[i] == 0.0f) {
      ++dropped;
    } else {
      EXPECT_NEAR(two[i] - 2.0f, 2.0f * (one[i] - 2.0f), 1e-6);
    }
  }
  EXPECT_GT(dropped, 5);
  EXPECT_LT(dropped, 30);
}

TEST(LidarNoise, SeedsAndScansDiffer) {
  std::vector<float> a(5, 2.0f), b(5, 2.0f), c(5, 2.0f), again(5, 2.0f);
  const LidarNoise noise = LidarNoise::of(LidarPreset::rplidar_a2);
  add_lidar_noise(noise, 1, 0, a);
  add_lidar_noise(noise, 1, 1, b);
  add_lidar_noise(noise, 2, 0, c);
  add_lidar_noise(noise, 1, 0, again);
  EXPECT_NE(a, b);
  EXPECT_NE(a, c);
  EXPECT_EQ(a, again);
}

TEST(LidarNoise, BeyondTheRangesThereIsNoNumber) {
  std::vector<float> near(1000, 0.16f), far(1000, 11.99f);
  add_lidar_noise({0.05, 0.0, 0.0, 0.15, 12.0}, 1, 0, near);
  add_lidar_noise({0.05, 0.0, 0.0, 0.15, 12.0}, 1, 0, far);
  for (const float r : near) EXPECT_TRUE(r == 0.0f || r >= 0.15f);
  for (const float r : far) EXPECT_TRUE(r == kNothing || r <= 12.0f);
  EXPECT_NE(std::count(near.begin(), near.end(), 0.0f), 0);
  EXPECT_NE(std::count(far.begin(), far.end(), kNothing), 0);
}

TEST(LidarNoise, RefusesWhatIsNoDose) {
  std::vector<float> ranges(3, 1.0f);
  EXPECT_THROW(add_lidar_noise({-0.1, 0, 0, 0.15, 12}, 1, 0, ranges), Error);
  EXPECT_THROW(add_lidar_noise({0, NAN, 0, 0.15, 12}, 1, 0, ranges), Error);
  EXPECT_THROW(add_lidar_noise({0, 0, 1.1, 0.15, 12}, 1, 0, ranges), Error);
  EXPECT_THROW(add_lidar_noise({0, 0, 0, 3, 2}, 1, 0, ranges), Error);
}

}  // namespace
}  // namespace mapscore::sim
