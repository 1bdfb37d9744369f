// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/mapping/semantic_map.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace mapscore {
namespace {

/// A camera at the map's origin that looks along z and sees a wall 2 m away; no depth in the left
/// fifth of the image.
class DecayInView : public ::testing::Test {
 protected:
  void SetUp() override {
    depth_.colRange(0, 20) = std::uint16_t{0};
    for (const VoxelKey& key : keys_) hits_.push_back({key, 1, 1, 1.0});
    map_.fuse(hits_, 1, rule_);
  }
  [[nodiscard]] DepthView view(const Pose& T_map_depth = Pose::Identity()) const {
    return DepthView({camera_, T_map_depth, 0.5, 4.0, depth_});
  }
  [[nodiscard]] double at(const VoxelKey& key) const {
    const auto entries = map_.classes_at(key);
    return entries.empty() ? 0.0 : entries.front().probability;
  }

  const BlendRule rule_{0.5, Decay::view};
  const CameraModel camera_ = CameraModel::from_hfov(100, 100, 1.2);
  cv::Mat1w depth_ = cv::Mat1w(100, 100, std::uint16_t{10000});
  const VoxelKey near_{0, 0, 10}, at_wall_{0, 0, 19}, behind_by_half_{0, 0, 20}, behind_{0, 0, 21},
      too_near_{0, 0, 3}, beside_{0, 30, 10}, no_depth_{-6, 0, 10}, back_{0, 0, -10};
  const std::vector<VoxelKey> keys_{no_depth_, back_,           too_near_, near_,
                                    at_wall_,  behind_by_half_, behind_,   beside_};
  std::vector<VoxelHit> hits_;
  SemanticMap map_{0.1};
};

TEST_F(DecayInView, DecaysWhatIsInTheFrustumAndNotBehindTheDepthByMoreThanAVoxel) {
  map_.decay_in_view(view(), rule_, {});
  for (const VoxelKey& key : {near_, at_wall_, behind_by_half_}) EXPECT_EQ(at(key), 0.25);
  for (const VoxelKey& key : {behind_, too_near_, beside_, no_depth_, back_})
    EXPECT_EQ(at(key), 0.5);
}

TEST_F(DecayInView, LeavesToTheBlendWhatADrawHit) {
  map_.decay_in_view(view(), rule_, std::vector<VoxelHit>{{near_, 2, 1, 1.0}});
  EXPECT_EQ(at(near_), 0.5);
  EXPECT_EQ(at(at_wall_), 0.25);
}

TEST_F(DecayInView, FollowsTheCamera) {
  Pose turned = Pose::Identity();
  turned.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY()).toRotationMatrix();
  map_.decay_in_view(view(turned), rule_, {});
  EXPECT_EQ(at(back_), 0.25);
  EXPECT_EQ(at(near_), 0.5);
}

TEST_F(DecayInView, WhatFadesAwayIsForgotten) {
  for (int frame = 0; frame < 30; ++frame) map_.decay_in_view(view(), rule_, {});
  EXPECT_TRUE(map_.classes_at(near_).empty());
  EXPECT_EQ(at(behind_), 0.5);
}

TEST_F(DecayInView, AnImageWithoutDepthSeesNothing) {
  depth_ = std::uint16_t{0};
  map_.decay_in_view(view(), rule_, {});
  for (const VoxelKey& key : keys_) EXPECT_EQ(at(key), 0.5);
}

TEST_F(DecayInView, RefusesAnotherSizeOfImage) {
  const PosedDepth other{camera_, Pose::Identity(), 0, 1, cv::Mat1w(90, 100, std::uint16_t{0})};
  EXPECT_THROW(DepthView{other}, Error);
  EXPECT_THROW(map_.decay_in_view(view(), BlendRule{-1.0}, {}), Error);
  EXPECT_EQ(at(near_), 0.5);
}

}  // namespace
}  // namespace mapscore
