// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/mapped_frames.hpp"

#include "tests/support/expect_error.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mapscore {
namespace {

using testing::expect_error;

/// A camera that looks along x, 2 m before a wall.
class FrameChoiceTest : public ::testing::Test {
 protected:
  FrameChoiceTest() {
    camera_.depth = CameraModel::from_hfov(64, 48, std::numbers::pi / 3.0);
    camera_.T_base_depth.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  }

  [[nodiscard]] static Pose at(double x_m, double yaw_deg = 0.0) {
    Pose pose = Pose::Identity();
    pose.translation().x() = x_m;
    pose.linear() = Eigen::AngleAxisd(yaw_deg * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ())
                        .toRotationMatrix();
    return pose;
  }
  [[nodiscard]] static cv::Mat1w wall() { return cv::Mat1w(48, 64, std::uint16_t{10000}); }

  bool takes(FrameChoice& choice, const Pose& T_map_base) const {
    return choice.takes(wall(), camera_, T_map_base);
  }

  Calibration camera_;
};

TEST_F(FrameChoiceTest, AllTakesEveryFrameOfNoDepthToo) {
  FrameChoice choice{AllFrames{}};
  for (int n = 0; n < 3; ++n) EXPECT_TRUE(takes(choice, at(0.0)));
  EXPECT_TRUE(choice.takes(cv::Mat1w::zeros(48, 64), camera_, at(0.0)));
}

// The way counts from the last key frame, not from the last frame.
TEST_F(FrameChoiceTest, KeyFramesAreAWayOrATurnFromTheLastOne) {
  KeyFramesAlone rule;
  rule.key_overlap = 0.0;
  FrameChoice choice{rule};
  EXPECT_TRUE(takes(choice, at(0.0)));
  EXPECT_FALSE(takes(choice, at(0.2)));
  EXPECT_FALSE(takes(choice, at(0.29)));
  EXPECT_TRUE(takes(choice, at(0.31)));
  EXPECT_FALSE(takes(choice, at(0.02))) << "0.29 m back";
  EXPECT_FALSE(takes(choice, at(0.31, 14.9)));
  EXPECT_TRUE(takes(choice, at(0.31, 15.1)));
  EXPECT_FALSE(takes(choice, at(0.31, 29.9)));
}

// Of a wall that fills the image, a turn by half of the field of view leaves half.
TEST_F(FrameChoiceTest, KeyFramesSeeLittleOfWhatTheLastOneSaw) {
  KeyFramesAlone rule;
  rule.key_turn_deg = {90};
  rule.key_overlap = 0.7;
  FrameChoice choice{rule};
  EXPECT_TRUE(takes(choice, at(0.0)));
  EXPECT_FALSE(takes(choice, at(0.0, 5.0)));
  EXPECT_TRUE(takes(choice, at(0.0, 30.0)));
}

TEST_F(FrameChoiceTest, OfADarkFrameNoKeyFrameIsMade) {
  FrameChoice choice{KeyFramesAlone{}};
  EXPECT_FALSE(choice.takes(cv::Mat1w::zeros(48, 64), camera_, at(0.0)));
  EXPECT_TRUE(takes(choice, at(0.0))) << "the first one with depth";
  EXPECT_FALSE(choice.takes(cv::Mat1w::zeros(48, 64), camera_, at(1.0)));
  EXPECT_TRUE(takes(choice, at(0.5))) << "still 0.5 m from the last one";
}

TEST_F(FrameChoiceTest, RefusesAnImageOfAnotherSizeAndParametersOutOfRange) {
  FrameChoice choice{KeyFramesAlone{}};
  expect_error("key frames: a depth image is not of the depth camera's size", [&] {
    static_cast<void>(choice.takes(cv::Mat1w(24, 64, std::uint16_t{1}), camera_, at(0.0)));
  });
  KeyFramesAlone rule;
  rule.key_way_m = 0.0;
  expect_error("key_way_m", [&] { FrameChoice{rule}; });
}

}  // namespace
}  // namespace mapscore
