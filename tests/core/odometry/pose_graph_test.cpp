// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/pose_graph.hpp"

#include "core/error.hpp"
#include "core/odometry/key_frames.hpp"
#include "core/odometry/loop_closure.hpp"
#include "tests/core/odometry/flat_depth.hpp"

#include <gtest/gtest.h>

namespace mapscore {
namespace {

Pose forward(double x_m) {
  return planar_pose(x_m, 0.0, 0.0);
}

TEST(PoseGraph, ThreeEqualEdgesShareTheirContradiction) {
  // 0 -> 1 -> 2 of 1 m each, and 0 -> 2 of 2.3 m: each takes a third of the 0.3 m.
  const std::vector<PoseEdge> edges{
      {0, 1, forward(1.0)}, {1, 2, forward(1.0)}, {0, 2, forward(2.3)}};
  const OptimisedPoses result = optimised({forward(0), forward(1), forward(2)}, edges);
  EXPECT_NEAR(result.nodes[1].translation().x(), 1.1, 1e-6);
  EXPECT_NEAR(result.nodes[2].translation().x(), 2.2, 1e-6);
  // Two edges in a row (variance 2) beside one (variance 1).
  EXPECT_NEAR(result.last_covariance(0, 0), 2.0 / 3.0, 1e-6);
  EXPECT_EQ(result.nodes[0].matrix(), forward(0).matrix());
}

TEST(PoseGraph, CovarianceIsInTheAxesOfTheLastNode) {
  Covariance6 along = Covariance6::Identity();
  along(0, 0) = 4.0;   // along x of node 0
  along(5, 5) = 1e-6;  // of yaw, small enough not to reach across
  const Pose turned = planar_pose(0.0, 0.0, std::numbers::pi / 2);
  const OptimisedPoses result = optimised({forward(0), turned}, {{0, 1, turned, along}});
  // The edge's covariance is in the axes of the node it leads to.
  EXPECT_NEAR(result.last_covariance(0, 0), 4.0, 1e-6);
  EXPECT_NEAR(result.last_covariance(1, 1), 1.0, 1e-6);
  EXPECT_NEAR(result.last_covariance(5, 5), 1e-6, 1e-9);
}

TEST(PoseGraph, AWrongLoopWeighsLittle) {
  Covariance6 tight = 1e-4 * Covariance6::Identity();
  std::vector<PoseEdge> edges{{0, 1, forward(1.0), tight}, {1, 2, forward(1.0), tight}};
  edges.push_back({0, 2, forward(9.0), tight, true});
  EXPECT_NEAR(optimised({forward(0), forward(1), forward(2)}, edges).nodes[2].translation().x(),
              2.0, 0.05);
}

TEST(PoseGraph, RefusesWhatItCannotSolve) {
  EXPECT_THROW(static_cast<void>(optimised({forward(0)}, {{0, 1, forward(1)}})), Error);
  EXPECT_THROW(static_cast<void>(
                   optimised({forward(0), forward(1)}, {{0, 1, forward(1), Covariance6::Zero()}})),
               Error);
  EXPECT_THROW(
      static_cast<void>(optimised({forward(0), forward(1), forward(2)}, {{0, 1, forward(1)}})),
      Error);
}

TEST(KeyFrames, OverlapIsAllOfTheSameViewAndNothingOfTheOppositeOne) {
  const testing::BoxFlat room(6.0, 5.0);
  const Calibration camera = testing::odometry_camera();
  const cv::Mat1w depth = testing::flat_depth(room, planar_pose(3.0, 2.5, 0.0), camera);
  EXPECT_EQ(overlap(depth, camera, Pose::Identity()), 1.0);
  EXPECT_EQ(overlap(depth, camera, planar_pose(0, 0, std::numbers::pi)), 0.0);
  EXPECT_EQ(overlap(cv::Mat1w::zeros(depth.size()), camera, Pose::Identity()), 0.0);
  const double quarter = overlap(depth, camera, planar_pose(0, 0, 0.5));
  EXPECT_GT(quarter, 0.3);
  EXPECT_LT(quarter, 0.7);
}

TEST(KeyFrames, WayTurnAndOverlapEachMakeOne) {
  const testing::BoxFlat room(6.0, 5.0);
  const Calibration camera = testing::odometry_camera();
  const cv::Mat1w depth = testing::flat_depth(room, planar_pose(3.0, 2.5, 0.0), camera);
  const KeyFrameRule rule{.key_way_m = 0.3, .key_turn_deg = {15}, .key_overlap = 0.5};
  EXPECT_FALSE(is_key_frame(rule, depth, camera, Pose::Identity()));
  EXPECT_FALSE(is_key_frame(rule, depth, camera, planar_pose(0.29, 0, 0)));
  EXPECT_TRUE(is_key_frame(rule, depth, camera, planar_pose(0.31, 0, 0)));
  EXPECT_TRUE(is_key_frame(rule, depth, camera, planar_pose(0, 0, 0.27)));
  const KeyFrameRule by_overlap{.key_way_m = 100, .key_turn_deg = {360}, .key_overlap = 0.9};
  EXPECT_FALSE(is_key_frame(by_overlap, depth, camera, planar_pose(0, 0, 0.02)));
  EXPECT_TRUE(is_key_frame(by_overlap, depth, camera, planar_pose(0, 0, 0.3)));
}

TEST(LoopClosure, CandidatesAreNearInPoseFarInWayAndAlike) {
  const testing::BoxFlat room(6.0, 5.0);
  const Calibration camera = testing::odometry_camera();
  const auto key = [&](const Pose& pose, double way_m) {
    const cv::Mat1w depth = testing::flat_depth(room, pose, camera);
    return KeyFrame{
        0.0, pose, way_m, depth, scan_of(depth, camera, {}), small_depth_of(depth, 8.0)};
  };
  const std::vector<KeyFrame> earlier{
      key(planar_pose(2.0, 2.5, 0.0), 0.0),   // the place
      key(planar_pose(2.0, 2.5, 3.0), 1.0),   // there, but looking back
      key(planar_pose(5.0, 2.5, 0.0), 2.0),   // elsewhere
      key(planar_pose(2.1, 2.5, 0.0), 9.5)};  // hardly a way ago
  const KeyFrame current = key(planar_pose(2.05, 2.5, 0.02), 10.0);
  EXPECT_EQ(loop_candidates(earlier, current, {}, 0.0), std::vector<std::size_t>{0});
  EXPECT_NEAR(current.small_depth.dot(current.small_depth), 1.0, 1e-5);
  EXPECT_GT(earlier[0].small_depth.dot(current.small_depth), 0.9);
}

}  // namespace
}  // namespace mapscore
