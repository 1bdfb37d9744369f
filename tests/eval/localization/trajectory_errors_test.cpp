// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/localization/trajectory_errors.hpp"

#include "core/error.hpp"
#include "core/localization/planar_pose.hpp"
#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Along x, so many poses.
std::vector<Pose> straight(std::size_t count, double step_m) {
  std::vector<Pose> poses;
  for (std::size_t n = 0; n < count; ++n)
    poses.push_back(planar_pose(step_m * static_cast<double>(n), 0, 0));
  return poses;
}

/// Once around a square of 2 m, in steps of 0.25 m, turning at the corners.
std::vector<Pose> square() {
  std::vector<Pose> poses;
  Pose at = Pose::Identity();
  for (int side = 0; side < 4; ++side) {
    for (int step = 0; step < 8; ++step, at = at * planar_pose(0.25, 0, 0)) poses.push_back(at);
    at = at * planar_pose(0, 0, 90 * kDegree);
  }
  return poses;
}

std::vector<Pose> moved(const Pose& T, std::vector<Pose> poses) {
  for (Pose& pose : poses) pose = T * pose;
  return poses;
}

/// Each pose off by a draw of its own.
std::vector<Pose> scattered(std::vector<Pose> poses, double sigma) {
  RandomStream stream(7, "scatter");
  for (Pose& pose : poses) {
    Vector6 xi;
    for (double& axis : xi) axis = sigma * stream.normal();
    pose = pose * exp_pose(xi);
  }
  return poses;
}

TEST(TrajectoryErrors, AConstantOffsetIsNoErrorOnceAligned) {
  const std::vector<Pose> truth = square();
  const Pose T = planar_pose(0.3, -0.4, 0);
  const TrajectoryErrors errors = trajectory_errors(truth, moved(T, truth));
  EXPECT_NEAR(errors.position.rms().value(), 0.5, 1e-12);
  EXPECT_NEAR(errors.aligned.rms().value(), 0.0, 1e-12);
  EXPECT_NEAR(errors.rotation.rms().value(), 0.0, 1e-12);
  EXPECT_NEAR(errors.relative_position.rms().value(), 0.0, 1e-12);
}

TEST(TrajectoryErrors, ATurnAboutTheStartIsOneOfAllPoses) {
  const std::vector<Pose> truth = straight(3, 1.0);
  const double turn = 2.0 * std::asin(0.05);  // the pose n metres ahead is n * 0.1 m off
  const TrajectoryErrors errors = trajectory_errors(truth, moved(planar_pose(0, 0, turn), truth));
  EXPECT_NEAR(errors.position.sum, 0.01 + 0.04, 1e-12);
  EXPECT_NEAR(errors.rotation.rms().value(), turn, 1e-12);
  EXPECT_NEAR(errors.aligned.sum, 0.0, 1e-12);
  EXPECT_NEAR(errors.relative_rotation.sum, 0.0, 1e-12);
}

TEST(TrajectoryErrors, AnErrorOfScaleIsTheRelativeOne) {
  std::vector<Pose> believed = straight(21, 0.25);
  for (Pose& pose : believed) pose.translation() *= 1.05;
  const TrajectoryErrors errors = trajectory_errors(straight(21, 0.25), believed);
  EXPECT_EQ(errors.relative_position.count, 17);  // the last four poses have no metre ahead
  EXPECT_NEAR(errors.relative_position.rms().value(), 0.05, 1e-12);
  // 0.05 * 0.25 n m off, whose mean alignment takes away: n is of a variance of (21^2 - 1) / 12
  EXPECT_NEAR(errors.aligned.rms().value(), 0.0125 * std::sqrt(440.0 / 12.0), 1e-12);
}

TEST(TrajectoryErrors, AHeadingThatDriftsIsTheRelativeTurn) {
  std::vector<Pose> believed = straight(9, 0.5);
  for (std::size_t n = 0; n < believed.size(); ++n)
    believed[n] = believed[n] * planar_pose(0, 0, 0.5 * static_cast<double>(n) * 3.0 * kDegree);
  const TrajectoryErrors errors = trajectory_errors(straight(9, 0.5), believed);
  EXPECT_NEAR(errors.relative_rotation.rms().value(), 3.0 * kDegree, 1e-12);
}

TEST(TrajectoryErrors, ARigidMotionOfBothChangesNothing) {
  const std::vector<Pose> truth = square(), believed = scattered(truth, 0.05);
  const Pose T = exp_pose((Vector6() << 5, -3, 1, 0.3, -0.8, 2).finished());
  const TrajectoryErrors here = trajectory_errors(truth, believed);
  const TrajectoryErrors there = trajectory_errors(moved(T, truth), moved(T, believed));
  for (const auto sum :
       {&TrajectoryErrors::position, &TrajectoryErrors::aligned, &TrajectoryErrors::rotation,
        &TrajectoryErrors::relative_position, &TrajectoryErrors::relative_rotation}) {
    EXPECT_EQ((here.*sum).count, (there.*sum).count);
    EXPECT_NEAR((here.*sum).sum, (there.*sum).sum, 1e-12);
    EXPECT_GT((here.*sum).sum, 0.0);
  }
}

TEST(TrajectoryErrors, AlignmentIsTheBestMotion) {
  const std::vector<Pose> truth = square();
  const std::vector<Pose> believed = moved(planar_pose(1, 2, 2.5), scattered(truth, 0.1));
  const TrajectoryErrors errors = trajectory_errors(truth, believed);
  const Pose best = rigid_alignment(truth, believed);
  RandomStream stream(2, "other motions");
  for (int n = 0; n < 100; ++n) {
    Vector6 xi;
    for (double& axis : xi) axis = 0.01 * stream.normal();
    EXPECT_GT(trajectory_errors(truth, moved(best * exp_pose(xi), believed)).position.sum,
              errors.aligned.sum);
  }
  EXPECT_NEAR(trajectory_errors(truth, moved(best, believed)).position.sum, errors.aligned.sum,
              1e-12);
}

TEST(TrajectoryErrors, ALineAndAPointAreAlignedToo) {
  const std::vector<Pose> line = straight(5, 0.4);
  EXPECT_NEAR(trajectory_errors(line, moved(planar_pose(1, 1, 3), line)).aligned.sum, 0, 1e-12);
  const std::vector<Pose> point{planar_pose(3, 4, 1)};
  const TrajectoryErrors errors = trajectory_errors(point, std::vector<Pose>{Pose::Identity()});
  EXPECT_NEAR(errors.position.sum, 25.0, 1e-12);
  EXPECT_NEAR(errors.aligned.sum, 0.0, 1e-12);
  EXPECT_FALSE(errors.relative_position.rms().has_value());
}

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(PairsOfWay, AreAMetreOfTheWayApartAndNotOfTheAirLine) {
  std::vector<Pose> there_and_back = straight(3, 0.5);  // 0, 0.5, 1, and back to 0
  there_and_back.push_back(planar_pose(0.5, 0, 0));
  there_and_back.push_back(planar_pose(0, 0, 0));
  EXPECT_EQ(pairs_of_way(there_and_back), (Pairs{{0, 2}, {1, 3}, {2, 4}}));
}

TEST(PairsOfWay, TakeTheNearestWithinATenthAndTheFirstOfEquals) {
  EXPECT_EQ(pairs_of_way(straight(5, 0.35)), (Pairs{{0, 3}, {1, 4}}));          // 1.05 m
  EXPECT_EQ(pairs_of_way(straight(5, 0.46)), (Pairs{{0, 2}, {1, 3}, {2, 4}}));  // 0.92 m
  EXPECT_TRUE(pairs_of_way(straight(5, 0.4)).empty());                          // 0.8 and 1.2 m
  std::vector<Pose> standing = straight(3, 0.5);
  standing.insert(standing.begin() + 2, 2, standing[2]);  // three poses at 1 m
  EXPECT_EQ(pairs_of_way(standing), (Pairs{{0, 2}}));
  EXPECT_TRUE(pairs_of_way({}).empty());
}

PoseBelief belief_of(const Pose& T_map_base, const Vector6& sigma) {
  PoseBelief belief;
  belief.T_odom_base = T_map_base;
  belief.covariance = sigma.cwiseAbs2().asDiagonal();
  return belief;
}

TEST(TrajectoryErrors, NeesIsOfThePlaneOfAllAndOfSpaceOfThoseThatHaveIt) {
  Vector6 plane = Vector6::Zero();
  plane[0] = plane[1] = 0.1;
  plane[5] = 0.02;
  const Pose off = planar_pose(0.1, -0.2, 0);
  const std::vector<Pose> truth(5, Pose::Identity());
  const TrajectoryErrors errors = trajectory_errors(
      truth, std::vector<PoseBelief>{belief_of(off, plane), belief_of(off, Vector6::Constant(0.1)),
                                     belief_of(off, Vector6::Zero()),  // says nothing
                                     // Certain of y and yaw: wrong, and right.
                                     belief_of(off, 0.1 * Vector6::Unit(0)),
                                     belief_of(planar_pose(0.1, 0, 0), 0.1 * Vector6::Unit(0))});
  EXPECT_EQ(errors.planar.count, 3);
  EXPECT_EQ(errors.planar.in_band, 2);
  EXPECT_EQ(errors.planar.infinite, 1);
  EXPECT_NEAR(errors.planar.sum, 5.0 + 5.0, 1e-12);
  EXPECT_NEAR(errors.planar.share().value(), 2.0 / 3.0, 1e-12);
  EXPECT_FALSE(errors.planar.mean().has_value());
  EXPECT_EQ(errors.spatial.count, 1);
  EXPECT_NEAR(errors.spatial.mean().value(), 5.0, 1e-12);
  EXPECT_EQ(errors.spatial.share(), 1.0);
}

TEST(TrajectoryErrors, RefuseTrajectoriesOfUnequalLength) {
  const std::vector<Pose> none, one(1, Pose::Identity());
  EXPECT_THROW((void)trajectory_errors(one, none), Error);
  EXPECT_THROW((void)trajectory_errors(none, none), Error);
}

}  // namespace
}  // namespace mapscore::eval
