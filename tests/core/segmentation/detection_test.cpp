// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/detection.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

namespace mapscore {
namespace {

/// Cups (class 1) and chairs (class 3) are detected, floors (class 2) are not.
ClassTable kitchen() {
  ClassTable table;
  table.classes.push_back({1, "cup", {}, true});
  table.classes.push_back({2, "floor", {}, false});
  table.classes.push_back({3, "chair", {}, true});
  table.instances.push_back({1, "chair_1", 3});
  table.instances.push_back({2, "floor", 2});
  table.instances.push_back({3, "cup_1", 1});
  table.instances.push_back({4, "cup_2", 1});
  return table;
}

const cv::Mat1w kLabel = (cv::Mat1w(4, 6) << 0, 3, 3, 2, 2, 2,  //
                          0, 0, 3, 2, 1, 2,                     //
                          9, 0, 0, 2, 2, 2,                     //
                          0, 1, 0, 2, 2, 2);

TEST(Detection, OnePerVisibleInstanceOfADetectedClassInTheOrderOfInstances) {
  const std::vector<Detection> detections = detections_of(kLabel, kitchen());
  ASSERT_EQ(detections.size(), 2u);
  EXPECT_EQ(detections[0].instance, 1);
  EXPECT_EQ(detections[0].class_id, 3);
  EXPECT_EQ(detections[1].instance, 3);
  EXPECT_EQ(detections[1].class_id, 1);
  EXPECT_EQ(detections[1].score, 1.0);
}

TEST(Detection, BoxIsTightAndTheMaskHasItsSize) {
  const Detection cup = detections_of(kLabel, kitchen()).at(1);
  EXPECT_EQ(cup.box, (PixelBox{1, 0, 2, 1}));
  const cv::Mat1b expected = (cv::Mat1b(2, 2) << 255, 255, 0, 255);
  EXPECT_EQ(cv::countNonZero(cup.mask != expected), 0);
}

TEST(Detection, InstanceInPiecesIsOneDetection) {
  const Detection chair = detections_of(kLabel, kitchen()).at(0);
  EXPECT_EQ(chair.box, (PixelBox{1, 1, 4, 3}));
  EXPECT_EQ(cv::countNonZero(chair.mask), 2);
  EXPECT_EQ(chair.mask(0, 3), 255);
  EXPECT_EQ(chair.mask(2, 0), 255);
}

TEST(Detection, EmptyImageAndEmptyTableGiveNone) {
  EXPECT_TRUE(detections_of(cv::Mat1w(4, 6, std::uint16_t{0}), kitchen()).empty());
  EXPECT_TRUE(detections_of(kLabel, ClassTable{}).empty());
}

TEST(Detection, RefusesTablesThatDoNotHoldTogether) {
  ClassTable beyond = kitchen();
  beyond.instances[2].class_id = 4;  // the last class is 3
  EXPECT_THROW((void)detections_of(kLabel, beyond), Error);
  ClassTable shuffled = kitchen();
  std::swap(shuffled.instances[1], shuffled.instances[2]);
  EXPECT_THROW((void)detections_of(kLabel, shuffled), Error);
  ClassTable gap = kitchen();
  gap.classes[3].id = 7;
  EXPECT_THROW((void)detections_of(kLabel, gap), Error);
}

TEST(Detection, WantedAreTheMasksAndTheMiddleOfEachBox) {
  const cv::Mat1b wanted = pixels_wanted(detections_of(kLabel, kitchen()), 6, 4);
  const cv::Mat1b expected = (cv::Mat1b(4, 6) << 0, 255, 255, 0, 0, 0,  // middle of the cup's box:
                              0, 0, 255, 0, 255, 0,                     // (1, 0), on its mask
                              0, 0, 255, 0, 0, 0,                       // of the chair's: (2, 2)
                              0, 255, 0, 0, 0, 0);
  EXPECT_EQ(cv::countNonZero(wanted != expected), 0);
}

}  // namespace
}  // namespace mapscore
