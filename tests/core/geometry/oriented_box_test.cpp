// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/oriented_box.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"
#include "tests/core/points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace mapscore {
namespace {

using testing::Points;

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

/// Corners of a box, and points inside it.
Points filled(const Pose& T_frame_box, const Eigen::Vector3d& size, RandomStream& stream) {
  Points points;
  for (int n = 0; n < 8; ++n)
    points.emplace_back((n & 1 ? 0.5 : -0.5) * size.x(), (n & 2 ? 0.5 : -0.5) * size.y(),
                        (n & 4 ? 0.5 : -0.5) * size.z());
  for (int n = 0; n < 200; ++n)
    points.emplace_back((stream.uniform() - 0.5) * size.x(), (stream.uniform() - 0.5) * size.y(),
                        (stream.uniform() - 0.5) * size.z());
  for (Eigen::Vector3d& p : points) p = T_frame_box * p;
  return points;
}

void expect_holds(const OrientedBox& box, const Points& points) {
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Array3d q = (box.T_frame_box.inverse() * p).array().abs();
    EXPECT_TRUE((q <= 0.5 * box.size_m.array() + 1e-12).all());
  }
}

TEST(OrientedBox, TurnedBoxesAreRecovered) {
  for (std::uint64_t round = 0; round < 50; ++round) {
    RandomStream stream(3, "boxes", {round});
    const double yaw = 3.14 * (2 * stream.uniform() - 1);
    const Pose T = planar_pose(stream.normal(), stream.normal(), yaw);
    const Eigen::Vector3d size(1.0 + stream.uniform(), 0.2 + 0.5 * stream.uniform(), 0.8);
    const Points points = filled(T, size, stream);
    const OrientedBox box = upright_box(points, kUp).value();
    EXPECT_TRUE(box.size_m.isApprox(size, 1e-12));
    EXPECT_TRUE(box.T_frame_box.translation().isApprox(T.translation(), 1e-12));
    EXPECT_NEAR(std::abs(box.T_frame_box.linear().col(0).dot(T.linear().col(0))), 1.0, 1e-12);
    EXPECT_NEAR(box.T_frame_box.linear().determinant(), 1.0, 1e-12);
    EXPECT_GE(box.T_frame_box.linear()(0, 0), 0.0);
    expect_holds(box, points);
  }
}

TEST(OrientedBox, UpInTheDepthCamerasFrameGivesTheSameBoxAsInTheBases) {
  RandomStream stream(4, "tilted");
  Pose T_base_depth = Pose::Identity();
  T_base_depth.linear() =
      exp_rotation({0, 0.3, 0}) * (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished();
  T_base_depth.translation() << 0.1, 0.0, 1.2;
  const Eigen::Vector3d size(1.2, 0.4, 0.9);
  const Pose T_base_box = planar_pose(2.0, 0.3, 0.7);
  Points points = filled(T_base_box, size, stream);
  for (Eigen::Vector3d& p : points) p = T_base_depth.inverse() * p;
  const OrientedBox box = upright_box(points, 5.0 * up_in_depth(T_base_depth)).value();
  EXPECT_TRUE(box.size_m.isApprox(size, 1e-12));
  const Pose found = T_base_depth * box.T_frame_box;
  EXPECT_TRUE(found.translation().isApprox(T_base_box.translation(), 1e-12));
  EXPECT_TRUE(found.linear().col(2).isApprox(kUp, 1e-12));
  expect_holds(box, points);
}

/// Against the area at every hundredth of a degree.
TEST(OrientedBox, NoTurnGivesASmallerRectangle) {
  for (std::uint64_t round = 0; round < 20; ++round) {
    RandomStream stream(5, "areas", {round});
    Points points;
    for (int n = 0; n < 30; ++n) points.emplace_back(stream.normal(), 2 * stream.normal(), 0);
    const OrientedBox box = upright_box(points, kUp).value();
    for (int step = 0; step < 9000; ++step) {
      const double a = step * std::acos(-1.0) / 18000;
      Eigen::AlignedBox2d turned;
      for (const Eigen::Vector3d& p : points) turned.extend(Eigen::Rotation2Dd(-a) * p.head<2>());
      ASSERT_GE(turned.volume(), box.size_m.head<2>().prod() - 1e-12);
    }
    EXPECT_GE(box.size_m.x(), box.size_m.y());
    expect_holds(box, points);
  }
}

TEST(OrientedBox, FlatStraightAndSinglePointsHaveSidesOfNoLength) {
  const OrientedBox point = upright_box(Points{{1, 2, 3}, {1, 2, 3}}, kUp).value();
  EXPECT_EQ(point.size_m, Eigen::Vector3d::Zero());
  EXPECT_TRUE(point.T_frame_box.isApprox(Pose(Eigen::Translation3d(1, 2, 3))));

  const Points diagonal{{0, 0, 1}, {3, 4, 1}, {1.5, 2, 1}};
  const OrientedBox line = upright_box(diagonal, kUp).value();
  EXPECT_TRUE(line.size_m.isApprox(Eigen::Vector3d(5, 0, 0), 1e-12));
  EXPECT_TRUE(line.T_frame_box.linear().col(0).isApprox(Eigen::Vector3d(0.6, 0.8, 0), 1e-12));

  const Points post{{1, 1, 0}, {1, 1, 2}};
  EXPECT_EQ(upright_box(post, kUp)->size_m, Eigen::Vector3d(0, 0, 2));

  const Points wall{{0, 0, 0}, {0, 2, 0}, {0, 0, 1}, {0, 2, 1}, {0, 1, 0.5}};
  const OrientedBox plane = upright_box(wall, kUp).value();
  EXPECT_TRUE(plane.size_m.isApprox(Eigen::Vector3d(2, 0, 1), 1e-12));
  EXPECT_TRUE(plane.T_frame_box.linear().col(0).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
}

TEST(OrientedBox, PointsThatAreNotFiniteAreLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(upright_box(Points{}, kUp));
  EXPECT_FALSE(upright_box(Points{{nan, 0, 0}}, kUp));
  EXPECT_EQ(upright_box(Points{{0, nan, 0}, {0, 0, 0}, {1, 0, 0}}, kUp)->size_m,
            Eigen::Vector3d(1, 0, 0));
}

TEST(OrientedBox, RefusesAnUpWithoutDirection) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)upright_box(Points{{0, 0, 0}}, Eigen::Vector3d::Zero()), Error);
  EXPECT_THROW((void)upright_box(Points{{0, 0, 0}}, {0, infinity, 0}), Error);
}

}  // namespace
}  // namespace mapscore
