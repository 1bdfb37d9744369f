// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/placement/point_parts.hpp"

#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace mapscore {
namespace {

Eigen::Vector3d random_vector(RandomStream& stream) {
  return Eigen::Vector3d(stream.uniform(), stream.uniform(), stream.uniform()).array() - 0.5;
}

/// A wall of 40 x 40 points, `step_m` apart.
std::vector<Eigen::Vector3d> wall(double step_m) {
  std::vector<Eigen::Vector3d> points;
  for (int v = 0; v < 40; ++v)
    for (int u = 0; u < 40; ++u)
      points.push_back({step_m * u - 1, step_m * v, 2 + 0.3 * step_m * u});
  return points;
}

std::size_t points_of(const std::vector<PointPart>& parts, std::uint32_t object) {
  std::size_t points = 0;
  for (const PointPart& part : parts)
    if (part.object == object) points += part.points.size();
  return points;
}

TEST(PointParts, HoldEachPointOnceWithinHalfAVoxel) {
  constexpr double kEdge_m = 0.05;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Observation observation{{1, 1.0, wall(0.005)}, {2, 1.0, wall(0.06)}, {3, 1.0, wall(0.005)}};
  observation[2].positions.insert(observation[2].positions.begin() + 100,
                                  {{nan, 0, 0}, {0, 1e6 * kEdge_m, 0}});
  const Eigen::Matrix3d to_voxels = exp_rotation({0.1, 0.7, -0.3}) / kEdge_m;
  const PointParts parts = sort_into_parts(observation, to_voxels, 10);
  EXPECT_EQ(points_of(parts.small, 0), 1600u);
  EXPECT_EQ(points_of(parts.loose, 0), 0u);
  EXPECT_EQ(points_of(parts.small, 1), 0u) << "a point a part saves nothing";
  EXPECT_EQ(points_of(parts.loose, 1), 1600u);
  EXPECT_EQ(points_of(parts.small, 2), 1600u);
  EXPECT_EQ(points_of(parts.loose, 2), 2u);
  ASSERT_EQ(parts.boxes.size(), parts.small.size());
  for (std::size_t n = 0; n < parts.small.size(); ++n) {
    EXPECT_LE(parts.boxes[n].sizes().maxCoeff(), 0.5);
    for (const Eigen::Vector3d& p : parts.small[n].points)
      EXPECT_TRUE(parts.boxes[n].contains(to_voxels * p));
  }
}

TEST(PointParts, AreNotMadeForThreeDraws) {
  const Observation observation{{1, 1.0, wall(0.002)}};
  const Eigen::Matrix3d to_voxels = Eigen::Matrix3d::Identity() / 0.05;
  EXPECT_TRUE(sort_into_parts(observation, to_voxels, 3).small.empty());
  EXPECT_FALSE(sort_into_parts(observation, to_voxels, 4).small.empty());
}

bool between(const VoxelKey& key, const VoxelKey& low, const VoxelKey& high) {
  return key.i >= low.i && key.i <= high.i && key.j >= low.j && key.j <= high.j && key.k >= low.k &&
         key.k <= high.k;
}

/// Two corners of each box are points, which lie on faces of voxels in the first draw; distances of
/// the boxes up to 30000 voxels, of the sensor up to 500000.
TEST(PartBoxes, NoPointLiesOutsideTheVoxelsReached) {
  constexpr double kEdge_m = 0.05;
  RandomStream stream(1, "boxes");
  for (const double far : {3.0, 300.0, 30000.0})
    for (const double shift : {0.0, 100.0, 500000.0}) {
      const Eigen::Matrix3d turn = exp_rotation(3 * random_vector(stream));
      std::vector<Pose> poses(20, Pose::Identity());
      for (Pose& pose : poses) pose.linear() = exp_rotation(0.1 * random_vector(stream)) * turn;
      poses.front().linear() = turn;
      for (Pose& pose : poses) pose.translation() = kEdge_m * shift * random_vector(stream);
      const Eigen::Vector3d t = poses.front().translation() / kEdge_m;
      std::vector<Eigen::AlignedBox3d> boxes;
      for (int n = 0; n < 500; ++n) {
        const Eigen::Vector3d on_face = (far * random_vector(stream) + t).array().round();
        boxes.emplace_back(Eigen::Vector3d(on_face - t));
        boxes.back().extend(Eigen::Vector3d(on_face - t + 0.5 * random_vector(stream)));
      }
      PartBoxes moved(boxes, turn / kEdge_m, poses, kEdge_m);
      int one = 0;
      for (const Pose& pose : poses) {
        ASSERT_TRUE(moved.move_to(pose));
        for (std::size_t n = 0; n < boxes.size(); ++n) {
          for (const Eigen::Vector3d& q : {boxes[n].min(), boxes[n].max()}) {
            const Eigen::Vector3d p_sensor = kEdge_m * (turn.transpose() * q);
            const VoxelKey key = voxel_of(pose * p_sensor, kEdge_m);
            EXPECT_TRUE(between(key, moved.low(n), moved.high(n))) << far << " " << shift;
          }
          EXPECT_EQ(moved.within_one_voxel(n), moved.low(n) == moved.high(n));
          one += moved.within_one_voxel(n) ? 1 : 0;
        }
      }
      EXPECT_GT(one, 500) << "of 10000 " << far << " " << shift;
    }
}

TEST(PartBoxes, RefuseDrawsThatTheirMarginDoesNotCover) {
  const std::vector<Eigen::AlignedBox3d> boxes{Eigen::AlignedBox3d(Eigen::Vector3d::Ones())};
  std::vector<Pose> poses(4, Pose::Identity());
  poses[1].translation().x() = 600000;
  poses[2].linear() *= 3;
  poses[3].translation().z() = std::numeric_limits<double>::quiet_NaN();
  PartBoxes moved(boxes, Eigen::Matrix3d::Identity(), poses, 1.0);
  EXPECT_TRUE(moved.move_to(poses[0]));
  for (std::size_t n = 1; n < poses.size(); ++n) EXPECT_FALSE(moved.move_to(poses[n])) << n;
}

}  // namespace
}  // namespace mapscore
