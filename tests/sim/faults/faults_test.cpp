// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/geometry/pose.hpp"
#include "sim/faults/calibration_faults.hpp"
#include "sim/faults/pose_fault.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mapscore::sim {
namespace {

Calibration some_calibration() {
  Calibration calibration;
  calibration.color = CameraModel::from_hfov(640, 480, 1.047);
  calibration.depth = CameraModel::from_hfov(640, 480, 1.019);
  calibration.T_color_depth.translation() = Eigen::Vector3d(-0.025, 0, 0);
  calibration.T_base_depth = planar_pose(0.05, 0.0125, -1.5);
  return calibration;
}

TEST(Misregistration, ZeroDoseChangesNoBit) {
  const Calibration truth = some_calibration();
  const Calibration believed = misregister(truth, {}, 5);
  EXPECT_EQ(believed.T_color_depth.matrix(), truth.T_color_depth.matrix());
  EXPECT_EQ(believed.color, truth.color);
  EXPECT_EQ(misplace_mount(truth, {}, 5).T_base_depth.matrix(), truth.T_base_depth.matrix());
}

TEST(Misregistration, DirectionLiesInTheImagePlaneAndDoesNotDependOnTheDose) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Pose small = rigid_error({.magnitude_m = 0.005}, seed, "misregistration");
    const Pose large = rigid_error({.magnitude_m = 0.040}, seed, "misregistration");
    EXPECT_EQ(small.translation().z(), 0.0);
    EXPECT_NEAR(small.translation().norm(), 0.005, 1e-15);
    EXPECT_TRUE(large.translation().isApprox(8.0 * small.translation(), 1e-12));
    const Pose turned = rigid_error({.angle_deg = {1.2}}, seed, "misregistration");
    const Eigen::AngleAxisd rotation(turned.linear());
    EXPECT_NEAR(rotation.angle(), 1.2 * std::numbers::pi / 180, 1e-12);
    EXPECT_NEAR(rotation.axis().z(), 0.0, 1e-9);
    EXPECT_EQ(turned.translation().norm(), 0.0);
  }
}

TEST(Misregistration, DirectionsCoverTheCircle) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::uint64_t seed = 0; seed < 4000; ++seed)
    sum += rigid_error({.magnitude_m = 1.0}, seed, "misregistration").translation();
  EXPECT_LT(sum.norm() / 4000, 0.05);
}

TEST(Misregistration, StandsOnTheLeftAndMovesLabelsOnly) {
  const Calibration truth = some_calibration();
  Misregistration dose;
  dose.rigid.translation_m = {0.01, -0.02, 0.003};
  dose.focal_error_percent = 2;
  dose.principal_point_px = {3, -4};
  const Calibration believed = misregister(truth, dose, 1);
  EXPECT_TRUE(believed.T_color_depth.translation().isApprox(Eigen::Vector3d(-0.015, -0.02, 0.003)));
  EXPECT_DOUBLE_EQ(believed.color.fx_px, 1.02 * truth.color.fx_px);
  EXPECT_DOUBLE_EQ(believed.color.cy_px, truth.color.cy_px - 4);
  EXPECT_EQ(believed.T_base_depth.matrix(), truth.T_base_depth.matrix());
  EXPECT_EQ(believed.depth, truth.depth);
}

TEST(Mount, StandsOnTheRightAndMovesPointsOnly) {
  const Calibration truth = some_calibration();
  const MountError dose{{.translation_m = {0.0, 0.0, 0.1}}};
  const Calibration believed = misplace_mount(truth, dose, 1);
  EXPECT_TRUE((truth.T_base_depth.inverse() * believed.T_base_depth)
                  .translation()
                  .isApprox(Eigen::Vector3d(0, 0, 0.1)));
  EXPECT_EQ(believed.T_color_depth.matrix(), truth.T_color_depth.matrix());
}

std::vector<Pose> drive(std::size_t frames, double distance_m) {
  return std::vector<Pose>(frames, planar_pose(distance_m, 0.0, 1.0));
}

/// Believed poses of a drive whose errors have these standard deviations.
std::vector<Pose> believe(const std::vector<Pose>& truth, double sigma_m, double sigma_yaw_rad,
                          std::uint64_t seed, PoseNoiseKind kind = PoseNoiseKind::white) {
  Covariance6 covariance = Covariance6::Zero();
  covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, 0, 0, 0,
      sigma_yaw_rad * sigma_yaw_rad;
  return believe_poses(truth, covariance, kind, seed);
}

TEST(PoseNoise, ZeroDoseChangesNoBit) {
  const auto truth = drive(5, 3.0);
  const auto believed = believe(truth, 0.0, 0.0, 9);
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_EQ(believed[i].matrix(), truth[i].matrix());
}

class InjectedCovariance : public ::testing::TestWithParam<double> {};

TEST_P(InjectedCovariance, EqualsTheSampledOneAtAnyDistance) {
  const auto truth = drive(40000, GetParam());
  const auto believed = believe(truth, 0.02, 0.0175, 3);
  Covariance6 sum = Covariance6::Zero();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Vector6 xi = log_pose(truth[i].inverse() * believed[i]);
    sum += xi * xi.transpose();
  }
  sum /= static_cast<double>(truth.size());
  EXPECT_NEAR(std::sqrt(sum(0, 0)), 0.02, 2e-4);
  EXPECT_NEAR(std::sqrt(sum(1, 1)), 0.02, 2e-4);
  EXPECT_NEAR(std::sqrt(sum(5, 5)), 0.0175, 2e-4);
  EXPECT_LT(std::sqrt(sum(2, 2)), 1e-9);
  EXPECT_LT(std::abs(sum(0, 5)), 0.02 * 0.0175 * 0.02);
}

INSTANTIATE_TEST_SUITE_P(FromTheOrigin, InjectedCovariance, ::testing::Values(0.0, 10.0));

TEST(PoseNoise, DirectionDoesNotDependOnTheDose) {
  const auto truth = drive(20, 0.0);
  const auto small = believe(truth, 0.01, 0.0, 4);
  const auto large = believe(truth, 0.04, 0.0, 4);
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_TRUE((large[i].translation() - truth[i].translation())
                    .isApprox(4.0 * (small[i].translation() - truth[i].translation()), 1e-9));
}

TEST(PoseNoise, ConstantIsOneDrawAndWalkAddsUp) {
  const auto truth = drive(400, 0.0);
  const auto constant = believe(truth, 0.01, 0.0, 4, PoseNoiseKind::constant);
  EXPECT_EQ(constant.front().matrix(), constant.back().matrix());
  double squared = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto walk = believe(truth, 0.01, 0.0, seed, PoseNoiseKind::walk);
    squared += walk.back().translation().squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squared / 200 / 2), 0.01 * 20, 0.02) << "root of 400 steps";
}

TEST(PoseNoise, RefusesACovarianceThatIsNone) {
  Covariance6 covariance = Covariance6::Zero();
  covariance(2, 2) = -1.0;
  EXPECT_THROW((void)believe_poses(drive(1, 0), covariance, PoseNoiseKind::white, 1), Error);
}

}  // namespace
}  // namespace mapscore::sim
