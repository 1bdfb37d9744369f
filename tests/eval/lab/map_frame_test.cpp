// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/map_frame.hpp"

#include "tests/eval/lab/tiny_experiment.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace mapscore::eval {
namespace {

using testing::study_of;

TEST(MapFrame, SequenceIsTheOneOfTheRootOfItsEquation) {
  double g = 1.2;  // Newton's steps towards g^4 = g + 1
  for (int step = 0; step < 20; ++step) g -= (std::pow(g, 4) - g - 1) / (4 * std::pow(g, 3) - 1);
  for (const int n : {0, 1, 2, 17, 1000}) {
    const Eigen::Vector3d point = low_discrepancy_point(n);
    for (int axis = 0; axis < 3; ++axis) {
      const double x = 0.5 + (n + 1) * std::pow(g, -(axis + 1));
      EXPECT_NEAR(point[axis], x - std::floor(x), 1e-9) << n << ' ' << axis;
    }
  }
}

TEST(MapFrame, SequenceFillsEachAxisEvenly) {
  constexpr int kPoints = 800;
  std::array<std::array<int, 8>, 3> in_eighth{};
  for (int n = 0; n < kPoints; ++n) {
    const Eigen::Vector3d p = low_discrepancy_point(n);
    ASSERT_TRUE((p.array() >= 0).all() && (p.array() < 1).all()) << n;
    for (std::size_t axis = 0; axis < 3; ++axis)
      ++in_eighth[axis][static_cast<std::size_t>(8 * p[static_cast<int>(axis)])];
  }
  for (const auto& counts : in_eighth) {
    double squares = 0;
    for (const int count : counts) squares += std::pow(count - kPoints / 8, 2);
    EXPECT_LT(squares / 8, 44);  // independent draws: 87.5 on average
  }
}

TEST(MapFrame, OriginIsDrawnWithinAVoxelAndDiffersBySeed) {
  const Study study = study_of("voxel_m: 0.1\n");
  EXPECT_EQ(map_frame(study, 3).origin_m, 0.1 * low_discrepancy_point(3));
  EXPECT_NE(map_frame(study, 3).origin_m, map_frame(study, 4).origin_m);
  EXPECT_EQ(map_frame(study, 3).edge_m, 0.1);
}

TEST(MapFrame, OriginMayBeFixed) {
  const Study study = study_of("map_origin_m: [1, -2, 0.25]\nmap_yaw_deg: 90\n");
  const MapFrame frame = map_frame(study, 5);
  EXPECT_EQ(frame.origin_m, Eigen::Vector3d(1, -2, 0.25));
  EXPECT_EQ(frame, map_frame(study, 6));
  EXPECT_NEAR(frame.yaw_rad, std::numbers::pi / 2, 1e-15);
  // p_map = Rz(90 deg)^T (p_world - origin): one step along the world's y is one along the map's x.
  const Eigen::Vector3d p_map = frame.T_map_world() * Eigen::Vector3d(1, -1, 0.25);
  EXPECT_LT((p_map - Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace mapscore::eval
