// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/frame_yields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const TrialYields kBefore{
    "direct", {}, {{{"cup", {50, 5}}, {"chair", {70, 0}}}, {{"cup", {10, 1}}}, {}}};

std::vector<int> frames_of(const std::vector<FrameLoss>& losses) {
  std::vector<int> frames;
  for (const FrameLoss& loss : losses) frames.push_back(loss.frame);
  return frames;
}

TEST(FrameLosses, AreVoxelsNotFoundAnyMoreAndNewFalseOnesMostFirst) {
  TrialYields after = kBefore;
  after.frames[0]["cup"] = {48, 5};  // 2 lost
  after.frames[1]["cup"] = {9, 3};   // 1 lost, 2 false
  after.frames[2]["cup"] = {0, 1};   // 1 false
  EXPECT_THAT(frames_of(frame_losses(kBefore, after, {"cup"})), ElementsAre(1, 0, 2));
  after.frames[0]["chair"] = {60, 0};
  const auto losses = frame_losses(kBefore, after, {"cup", "chair"});
  EXPECT_THAT(frames_of(losses), ElementsAre(0, 1, 2));
  EXPECT_EQ(losses[0].voxels(), 12);
  EXPECT_EQ(losses[0].before, (FrameYield{120, 5}));
}

TEST(FrameLosses, WithoutALossThereAreNone) {
  EXPECT_THAT(frame_losses(kBefore, kBefore, {"cup", "chair"}), IsEmpty());
  TrialYields better = kBefore;
  better.frames[0]["cup"] = {55, 0};
  EXPECT_THAT(frame_losses(kBefore, better, {"cup"}), IsEmpty());
}

}  // namespace
}  // namespace mapscore::eval
