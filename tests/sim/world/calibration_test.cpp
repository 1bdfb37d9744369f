// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "sim/world/world.hpp"
#include "tests/sim/world/scene_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace mapscore::sim {
namespace {

using testing::data_file;
using ::testing::HasSubstr;
using testing::kBox;
using testing::load_text;
using testing::message_of;
using testing::mjcf;
using testing::SceneFolder;

TEST(WorldCalibration, RigStandsAndLooksAsTheOverridesSay) {
  const auto load = [](const CameraOverrides& cameras) {
    const SceneFolder folder;
    const auto robot = std::filesystem::path(MAPSCORE_SOURCE_DIR) / "scenes" / "robot.xml";
    return World::load({folder.write("s.xml", mjcf(kBox)), {}, robot}, cameras).calibration();
  };
  const Calibration plain = load({});
  CameraOverrides overrides;
  overrides.height_m = 0.6;
  overrides.pan_rad = 0.5;
  overrides.tilt_rad = -0.25;
  const Calibration turned = load(overrides);
  // The depth camera sits 25 mm to the left of the rig, which stands 5 cm before the base's middle.
  EXPECT_LT((turned.T_base_depth.translation() -
             Eigen::Vector3d(0.05 - 0.025 * std::sin(0.5), 0.025 * std::cos(0.5), 0.6))
                .norm(),
            1e-12);
  const Eigen::Vector3d view(std::cos(0.25) * std::cos(0.5), std::cos(0.25) * std::sin(0.5),
                             std::sin(0.25));
  EXPECT_LT((turned.T_base_depth.linear().col(2) - view).norm(), 1e-12);
  EXPECT_NEAR(turned.T_base_depth.linear().col(0).z(), 0.0, 1e-12) << "no roll";
  EXPECT_EQ(turned.T_color_depth.matrix(), plain.T_color_depth.matrix());

  CameraOverrides as_it_is;
  as_it_is.height_m = 1.15;
  as_it_is.tilt_rad = 12.0 * M_PI / 180.0;
  EXPECT_TRUE(load(as_it_is).T_base_depth.isApprox(plain.T_base_depth, 1e-12));
}

TEST(WorldCalibration, AlignedCamerasAreExactlyAligned) {
  for (const auto& robot : {data_file("robot.xml"),
                            std::filesystem::path(MAPSCORE_SOURCE_DIR) / "scenes" / "robot.xml"}) {
    const SceneFolder folder;
    const World world = World::load({folder.write("s.xml", mjcf(kBox)), {}, robot}, {});
    const Pose& T_color_depth = world.calibration().T_color_depth;
    EXPECT_EQ(T_color_depth.linear(), Eigen::Matrix3d::Identity());
    EXPECT_EQ(T_color_depth.translation(), Eigen::Vector3d(-0.025, 0, 0));
  }
}

TEST(WorldCalibration, OpticalFrameLooksForwardOnALevelRobot) {
  const Pose T = load_text(mjcf(kBox)).calibration().T_base_depth;
  EXPECT_LT((T * Eigen::Vector3d::Zero() - Eigen::Vector3d(0.05, 0.025, 1.15)).norm(), 1e-12);
  EXPECT_LT((T.linear() * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((T.linear() * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

TEST(WorldCalibration, ResolutionKeepsTheHorizontalFieldOfView) {
  CameraOverrides cameras;
  cameras.width_px = 320;
  cameras.height_px = 200;
  const Calibration small = load_text(mjcf(kBox), {}, cameras).calibration();
  EXPECT_EQ(small.color.width_px, 320);
  EXPECT_EQ(small.color.height_px, 200);
  EXPECT_NEAR(2 * std::atan(160 / small.color.fx_px) * 180 / M_PI, 60.0, 1e-6);
  EXPECT_NEAR(2 * std::atan(160 / small.depth.fx_px) * 180 / M_PI, 58.4, 1e-6);
  EXPECT_EQ(small.color.fx_px, small.color.fy_px);
  EXPECT_EQ(small.color.cy_px, 99.5);
}

TEST(WorldCalibration, RefusesImpossibleCameras) {
  CameraOverrides cameras;
  cameras.range_max_m = 14;  // beyond 16 bits
  EXPECT_THAT(message_of([&] { return load_text(mjcf(kBox), {}, cameras); }), HasSubstr("range"));
  cameras = {};
  cameras.width_px = 0;
  EXPECT_THAT(message_of([&] { return load_text(mjcf(kBox), {}, cameras); }),
              HasSubstr("resolution"));
}

}  // namespace
}  // namespace mapscore::sim
