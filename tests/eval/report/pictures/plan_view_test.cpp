// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/view.hpp"
#include "eval/study/picture_view.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

namespace mapscore::eval {
namespace {

TEST(PlanView, LooksStraightDownOnAllThatWasSeenAtOneScale) {
  JudgedMap map;
  map.seen_map = {Eigen::Vector3d(-1, 2, 0), Eigen::Vector3d(9, 7, 2.5)};
  const sim::View view = plan_view({map}, 640);
  EXPECT_EQ(view.width_px, 640);
  EXPECT_EQ(view.height_px, 320) << "10 m x 5 m";
  EXPECT_EQ(view.eye_m.head<2>(), Eigen::Vector2d(4, 4.5));
  const std::optional<double> metre_px = pixels_per_metre(view);
  ASSERT_TRUE(metre_px);
  EXPECT_NEAR(*metre_px, 640 / 10.4, 0.01) << "4 % around";
  // What is 2.5 m above another thing, 5 m beside the middle, is drawn close to it.
  const double near_m = view.eye_m.z() - 2.5, far_m = view.eye_m.z();
  EXPECT_LT(5.0 * (far_m / near_m - 1.0), 0.053 * 2.5);
}

TEST(PlanView, OnlyAViewStraightDownHasAScale) {
  EXPECT_FALSE(pixels_per_metre(view_of_numbers(std::vector<double>{0, 0, 5, 1, 1, 0})));
  EXPECT_FALSE(pixels_per_metre(view_of_numbers(std::vector<double>{0, 0, 0, 0, 0, 5})));
  // 960 pixels show 2 * 5 m * tan(45 degrees).
  const auto down = pixels_per_metre(view_of_numbers(std::vector<double>{1, 1, 5, 1, 1, 0, 90}));
  ASSERT_TRUE(down);
  EXPECT_NEAR(*down, 96.0, 1e-9);
}

TEST(PlanView, IsFiniteWithoutAnything) {
  const sim::View view = plan_view({JudgedMap{}}, 640);
  EXPECT_TRUE(view.eye_m.allFinite());
  EXPECT_GT(view.vfov_deg, 0.0);
  EXPECT_EQ(view.height_px, 640);
}

}  // namespace
}  // namespace mapscore::eval
