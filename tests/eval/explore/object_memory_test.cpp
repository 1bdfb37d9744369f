// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/explore/object_memory.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

constexpr int kWidth = 80, kHeight = 60;

/// Both cameras look along z of the base.
Calibration looking_along_z() {
  Calibration calibration;
  calibration.color = calibration.depth = CameraModel{kWidth, kHeight, 80.0, 80.0, 40.0, 30.0};
  calibration.range_min_m = 0.1;
  calibration.range_max_m = 5.0;
  return calibration;
}

/// A surface at 1 m before all pixels.
Sight surface_at_1_m() {
  return {looking_along_z(),
          cv::Mat1w(kHeight, kWidth, static_cast<std::uint16_t>(kDepthUnitsPerMetre)),
          {}};
}

/// A cup's points: 20 cm x 20 cm of that surface, about the optical axis.
std::vector<Segment> cup_segment() {
  Segment segment;
  segment.class_id = 1;
  segment.score = 1.0;
  for (double x = -0.1; x <= 0.101; x += 0.025)
    for (double y = -0.1; y <= 0.101; y += 0.025) segment.points.emplace_back(x, y, 1.0);
  return {segment};
}

TEST(ObjectMemory, AnObjectThatShouldHaveBeenSeenAndWasNotIsLookedForUntilItIsFound) {
  ObjectMemory memory(2, 120.0);
  const PoseBelief belief{Pose::Identity(), Pose::Identity(), Covariance6::Zero()};
  memory.add(cup_segment(), surface_at_1_m(), belief, 0.0);
  EXPECT_EQ(memory.objects(), 1u);
  EXPECT_TRUE(memory.again().empty());

  memory.add({}, surface_at_1_m(), belief, 1.0);
  ASSERT_EQ(memory.again().size(), 1u);
  EXPECT_TRUE(memory.again()[0].p_map.isApprox(Eigen::Vector3d(0, 0, 1), 0.02));
  EXPECT_EQ(memory.again()[0].priority_voxels, 120.0);
  EXPECT_EQ(memory.missed(), 1u);
  EXPECT_EQ(memory.found_again(), 0u);

  memory.add(cup_segment(), surface_at_1_m(), belief, 2.0);
  EXPECT_TRUE(memory.again().empty());
  EXPECT_EQ(memory.found_again(), 1u);
}

TEST(ObjectMemory, AnObjectOutOfViewIsNotMissed) {
  ObjectMemory memory(2, 120.0);
  PoseBelief belief{Pose::Identity(), Pose::Identity(), Covariance6::Zero()};
  memory.add(cup_segment(), surface_at_1_m(), belief, 0.0);
  belief.T_odom_base.translation().x() = 3.0;
  memory.add({}, surface_at_1_m(), belief, 1.0);
  EXPECT_TRUE(memory.again().empty());
}

}  // namespace
}  // namespace mapscore::eval
