// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/local_map.hpp"

#include "core/error.hpp"
#include "core/odometry/depth_scan.hpp"
#include "tests/core/odometry/flat_depth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mapscore {
namespace {

using testing::BoxFlat;
using testing::furnished_room;

DepthScan scan_at(const BoxFlat& flat, const Pose& T_map_base, double noise = 0.0,
                  std::uint64_t seed = 1) {
  const Calibration camera = testing::odometry_camera();
  return scan_of(testing::flat_depth(flat, T_map_base, camera, noise, seed), camera, {});
}

PosePrior prior_at(const Pose& mean, double sigma_m, double sigma_rad) {
  Vector6 sigmas;
  sigmas << sigma_m, sigma_m, sigma_m, sigma_rad, sigma_rad, sigma_rad;
  return {mean, sigmas.cwiseAbs2().asDiagonal()};
}

Pose off_by(const Pose& pose, double forward_m, double left_m, double yaw_rad) {
  return pose * planar_pose(forward_m, left_m, yaw_rad);
}

TEST(DepthScan, PointsLieOnTheirSurfacesAndNormalsLookBack) {
  const BoxFlat room(6.0, 5.0);
  const Pose T_map_base = planar_pose(2.0, 2.5, 0.0);
  const DepthScan scan = scan_at(room, T_map_base);
  ASSERT_GT(scan.size(), 1000U);
  const double wall_x = testing::kFlatOrigin.x() + 5.9;
  for (std::size_t n = 0; n < scan.size(); ++n) {
    const Eigen::Vector3d p = T_map_base * scan.points[n];
    const Eigen::Vector3d& normal = scan.normals[n];
    if (normal.z() > 0.99) {
      EXPECT_NEAR(p.z(), 0.0, 2e-3);
    } else if (normal.x() < -0.99) {
      EXPECT_NEAR(p.x(), wall_x, 2e-3);
    }
    EXPECT_LT(normal.dot(scan.points[n] - Eigen::Vector3d(0.05, 0.025, 1.15)), 0.0);
  }
}

TEST(DepthScan, BlocksAcrossAnEdgeOfDepthGiveNone) {
  const Calibration camera = testing::odometry_camera();
  cv::Mat1w depth(camera.depth.height_px, camera.depth.width_px, std::uint16_t{10000});
  depth.colRange(80, 160) = 20000;
  const DepthScan scan = scan_of(depth, camera, {});
  ASSERT_GT(scan.size(), 0U);
  const Pose T_depth_base = camera.T_base_depth.inverse();
  for (const Eigen::Vector3d& p : scan.points) {
    const double z = (T_depth_base * p).z();
    EXPECT_TRUE(std::abs(z - 2.0) < 1e-9 || std::abs(z - 4.0) < 1e-9) << z;
  }
}

TEST(DepthScan, WhatIsMatchedIsEverySecondBlockOfWhatEntersTheMap) {
  const DepthSampling sampling;
  ASSERT_EQ(sampling.of_map().points_across, 2 * sampling.points_across);
  const cv::Mat1w depth = testing::flat_depth(furnished_room(), planar_pose(2.0, 2.5, 0.3),
                                              testing::odometry_camera(), 1.0, 1);
  const DepthScan matched = scan_of(depth, testing::odometry_camera(), sampling);
  const DepthScan mapped = scan_of(depth, testing::odometry_camera(), sampling.of_map());
  ASSERT_GT(matched.size(), 500U);
  EXPECT_GT(mapped.size(), 3 * matched.size());
  for (std::size_t n = 0; n < matched.size(); ++n) {
    const auto same = std::ranges::find(mapped.points, matched.points[n]);
    ASSERT_NE(same, mapped.points.end());
    const auto i = static_cast<std::size_t>(same - mapped.points.begin());
    EXPECT_EQ(mapped.normals[i], matched.normals[n]);
    EXPECT_EQ(mapped.sigma_m[i], matched.sigma_m[n]);
  }
}

TEST(DepthScan, RefusesAnImageOfAnotherSize) {
  EXPECT_THROW(static_cast<void>(scan_of(cv::Mat1w(10, 10), testing::odometry_camera(), {})),
               Error);
}

TEST(LocalMap, FindsAPoseAgainFromCentimetresOff) {
  const BoxFlat flat = furnished_room();
  LocalMap map({}, 60);
  for (const double y : {2.2, 2.5, 2.8})
    map.insert(scan_at(flat, planar_pose(1.5, y, 0.0)), planar_pose(1.5, y, 0.0));
  const Pose truth = planar_pose(1.7, 2.6, 0.1);
  const ScanMatch match =
      map.match(scan_at(flat, truth), prior_at(off_by(truth, 0.06, -0.05, 0.03), 0.1, 0.1));
  const Vector6 error = log_pose(truth.inverse() * match.T_map_base);
  EXPECT_LT(error.head<3>().norm(), 0.004);
  EXPECT_LT(error.tail<3>().norm(), 0.003);
  EXPECT_GT(match.known_share, 0.6);
  EXPECT_GT(match.inlier_share, 0.9);
}

TEST(LocalMap, AlongABareWallThePriorStaysAsItIs) {
  const BoxFlat hall(3.0, 200.0);
  const Pose before = planar_pose(1.5, 100.0, 0.0), after = planar_pose(1.5, 100.3, 0.0);
  LocalMap map({}, 60);
  map.insert(scan_at(hall, before), before);
  const PosePrior prior = prior_at(after, 0.1, 0.02);
  const ScanMatch match = map.match(scan_at(hall, after), prior);
  // y is along the wall; the wall before the robot and the floor fix all else.
  EXPECT_NEAR(std::sqrt(match.covariance(1, 1)), 0.1, 0.005);
  EXPECT_LT(std::sqrt(match.covariance(0, 0)), 0.01);
  EXPECT_LT(std::sqrt(match.covariance(5, 5)), 0.01);
  EXPECT_NEAR((after.inverse() * match.T_map_base).translation().y(), 0.0, 0.01);
}

Pose tilted(const Pose& pose, double roll_deg, double pitch_deg, double z_m) {
  Vector6 xi = Vector6::Zero();
  xi[2] = z_m;
  xi[3] = roll_deg * std::numbers::pi / 180.0;
  xi[4] = pitch_deg * std::numbers::pi / 180.0;
  return pose * exp_pose(xi);
}
double tilt_deg(const Pose& pose) {
  return std::acos(std::min(1.0, pose.linear()(2, 2))) * 180.0 / std::numbers::pi;
}

TEST(LocalMap, ABaseOnTheFloorStandsLevelInAMapThatLeans) {
  const BoxFlat flat = furnished_room();
  const Pose truth = planar_pose(1.7, 2.6, 0.1);
  const DepthScan scan = scan_at(flat, truth);
  LocalMap map({}, 60);
  map.insert(scan, tilted(truth, 0.0, 0.15, 0.0));
  PosePrior prior = prior_at(truth, 0.1, 0.02);
  EXPECT_NEAR(tilt_deg(map.match(scan, prior).T_map_base), 0.15, 0.02);
  prior.on_floor = true;
  EXPECT_LT(tilt_deg(map.match(scan, prior).T_map_base), 0.13);
}

TEST(LocalMap, ABaseOnASillMayLean) {
  const BoxFlat flat = furnished_room();
  const Pose level = planar_pose(1.7, 2.6, 0.1);
  LocalMap map({}, 60);
  map.insert(scan_at(flat, level), level);
  const Pose truth = tilted(level, 1.5, -1.5, 0.03);
  PosePrior prior = prior_at(truth, 0.1, 0.05);
  prior.on_floor = true;
  const Vector6 error =
      log_pose(truth.inverse() * map.match(scan_at(flat, truth), prior).T_map_base);
  EXPECT_LT(error.head<3>().norm(), 0.004);
  EXPECT_LT(error.tail<3>().norm(), 0.05 * std::numbers::pi / 180.0);
}

TEST(LocalMap, AKnownFloorDoesNotMakeANewChestKnown) {
  const BoxFlat hall(40.0, 40.0);  // nothing but floor within range of its middle
  BoxFlat with_chest(40.0, 40.0);
  with_chest.add(21.8, 19.5, 0.0, 22.3, 20.5, 1.0);
  const Pose T_map_base = planar_pose(20.0, 20.0, 0.0);
  LocalMap map({}, 60);
  map.insert(scan_at(hall, T_map_base), T_map_base);
  const PosePrior prior = prior_at(T_map_base, 0.01, 0.01);
  const ScanMatch floor_alone = map.match(scan_at(hall, T_map_base), prior);
  EXPECT_FALSE(floor_alone.upright);
  const ScanMatch match = map.match(scan_at(with_chest, T_map_base), prior);
  EXPECT_GT(match.known_share, 0.05);
  ASSERT_TRUE(match.upright);
  EXPECT_EQ(match.upright->known_share, 0.0);
  EXPECT_EQ(match.upright->on_plane_share, 0.0);
}

TEST(LocalMap, OfAScanBesideItThePriorIsGiven) {
  const BoxFlat flat = furnished_room();
  LocalMap map({}, 60);
  EXPECT_TRUE(map.empty());
  const PosePrior prior = prior_at(planar_pose(1.5, 2.5, 0.0), 0.1, 0.1);
  const DepthScan scan = scan_at(flat, prior.mean);
  EXPECT_EQ(map.match(scan, prior).T_map_base.matrix(), prior.mean.matrix());
  map.insert(scan, planar_pose(100.0, 100.0, 0.0));
  const ScanMatch match = map.match(scan, prior);
  EXPECT_EQ(match.known_share, 0.0);
  EXPECT_EQ(match.covariance, prior.covariance);
}

TEST(LocalMap, RefusesParametersOutOfRange) {
  EXPECT_THROW(LocalMap({.plane_voxel_m = 0.0}, 60), Error);
  EXPECT_THROW(LocalMap({.correlation = -1.0}, 60), Error);
}

}  // namespace
}  // namespace mapscore
