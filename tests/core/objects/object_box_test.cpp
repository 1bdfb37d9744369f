// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/object_box.hpp"

#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mapscore {
namespace {

ObjectBox box_at(const Eigen::Vector3d& centre, const Eigen::Vector3d& size, double yaw_rad = 0.0) {
  ObjectBox box = oriented(Eigen::AlignedBox3d(centre - 0.5 * size, centre + 0.5 * size));
  box.T_frame_box.linear() = exp_rotation({0, 0, yaw_rad});
  return box;
}

ObjectBox random_box(RandomStream& stream, bool upright) {
  const auto draw = [&] { return 2.0 * stream.uniform() - 1.0; };
  ObjectBox box;
  box.T_frame_box.translation() = Eigen::Vector3d(draw(), draw(), draw());
  if (!upright)
    box.T_frame_box.linear() = exp_rotation(3.0 * Eigen::Vector3d(draw(), draw(), draw()));
  box.size_m =
      Eigen::Vector3d(0.1 + stream.uniform(), 0.1 + stream.uniform(), 0.1 + stream.uniform());
  return box;
}

TEST(ObjectBox, CornersAndContains) {
  const ObjectBox box = box_at({1, 2, 3}, {2, 4, 6}, std::numbers::pi / 2);
  EXPECT_NEAR((box.corners()[0] - Eigen::Vector3d(3, 1, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((box.corners()[7] - Eigen::Vector3d(-1, 3, 6)).norm(), 0.0, 1e-12);
  EXPECT_TRUE(box.contains({2.9, 2.9, 5.9}));
  EXPECT_FALSE(box.contains({1, 3.1, 3}));
  EXPECT_NEAR((box.bounds().sizes() - Eigen::Vector3d(4, 2, 6)).norm(), 0.0, 1e-12);
}

TEST(ObjectBox, EighthTurnByHand) {
  // Two unit squares a eighth of a turn apart share a regular octagon of area 2 (sqrt 2 - 1).
  const ObjectBox a = box_at({0, 0, 0}, {1, 1, 1}),
                  b = box_at({0, 0, 0.5}, {1, 1, 1}, std::numbers::pi / 4);
  EXPECT_NEAR(intersection_m3(a, b), 0.5 * 2.0 * (std::sqrt(2.0) - 1.0), 1e-8);
}

TEST(ObjectBox, SharedFacesCountOnce) {
  const ObjectBox a = box_at({0, 0, 0}, {1, 1, 1});
  EXPECT_NEAR(intersection_m3(a, a), 1.0, 1e-8);
  EXPECT_NEAR(iou(a, a), 1.0, 1e-8);
  EXPECT_NEAR(intersection_m3(a, box_at({0.25, 0, 0}, {0.5, 1, 1})), 0.5, 1e-8);
  EXPECT_NEAR(intersection_m3(a, box_at({1, 0, 0}, {1, 1, 1})), 0.0, 1e-8);  // touch
  EXPECT_NEAR(overlap_share(a, box_at({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2})), 1.0, 1e-8);
  EXPECT_EQ(iou(box_at({0, 0, 0}, {1, 1, 0}), box_at({0, 0, 0}, {1, 1, 0})), 0.0);
}

TEST(ObjectBox, IntersectionOfAlignedBoxesIsTheirCommonBox) {
  RandomStream stream(7, "boxes", {0});
  for (int n = 0; n < 2000; ++n) {
    const ObjectBox a = random_box(stream, true), b = random_box(stream, true);
    const Eigen::AlignedBox3d common = a.bounds().intersection(b.bounds());
    EXPECT_NEAR(intersection_m3(a, b), common.isEmpty() ? 0.0 : common.volume(), 1e-8);
    EXPECT_EQ(meet(a, b), !common.isEmpty());
  }
}

TEST(ObjectBox, IntersectionIsThatOfSampledPoints) {
  RandomStream stream(8, "boxes", {0});
  for (int n = 0; n < 60; ++n) {
    const ObjectBox a = random_box(stream, false), b = random_box(stream, false);
    constexpr int kSide = 40;
    int common = 0;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j)
        for (int k = 0; k < kSide; ++k) {
          const Eigen::Array3d at = Eigen::Array3d(i + 0.5, j + 0.5, k + 0.5) / kSide - 0.5;
          common += b.contains(a.T_frame_box * (at * a.size_m.array()).matrix());
        }
    EXPECT_NEAR(intersection_m3(a, b) / a.volume_m3(), common / std::pow(kSide, 3), 0.01);
    EXPECT_NEAR(intersection_m3(a, b), intersection_m3(b, a), 1e-8);
    if (common > 0) {
      EXPECT_TRUE(meet(a, b));
    }
    if (!meet(a, b)) {
      EXPECT_NEAR(intersection_m3(a, b), 0.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace mapscore
