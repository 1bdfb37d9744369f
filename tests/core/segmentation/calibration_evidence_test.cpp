// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/calibration_evidence.hpp"

#include "core/segmentation/segmentation.hpp"
#include "tests/core/segmentation/edge_aligned/plate_scene.hpp"

#include <gtest/gtest.h>

namespace mapscore {
namespace {

using testing::PlateScene;

/// A correction by 12 px explains twice as much as what is believed, which fits sharply.
constexpr FrameFits kTwice{.mended_px = {100, 100},
                           .believed_px = {50, 50},
                           .sharpness = 0.9,
                           .offset_px = 0.2,
                           .apart_px = 12};
/// What is believed explains next to nothing of what a correction does.
constexpr FrameFits kWrong{.mended_px = {400, 400},
                           .believed_px = {40, 40},
                           .sharpness = 0.4,
                           .offset_px = 0.2,
                           .apart_px = 12};

CalibrationEvidence after(const FrameFits& frame, int times) {
  CalibrationEvidence told;
  for (int n = 0; n < times; ++n) told.add(frame);
  return told;
}

bool stands_alone(const FrameFits& frame) {
  return CalibrationEvidence().stands_in(frame);
}

TEST(CalibrationEvidence, AFrameAloneKeepsWhatFitsSharplyInBothDirections) {
  EXPECT_TRUE(stands_alone(kTwice));
  FrameFits frame = kTwice;
  frame.believed_px = {39, 50};  // a shift along the rows leaves rows where they are
  EXPECT_FALSE(stands_alone(frame));
  frame.believed_px = {50, 39};
  EXPECT_FALSE(stands_alone(frame));
  frame.believed_px = {41, 41};
  EXPECT_TRUE(stands_alone(frame));
}

TEST(CalibrationEvidence, ABluntFitAndOneOfGrownMasksMayBeChance) {
  FrameFits frame = kTwice;
  frame.sharpness = 0.59;
  EXPECT_FALSE(stands_alone(frame));
  frame.sharpness = 0.61;
  EXPECT_TRUE(stands_alone(frame));
  for (const double offset_px : {-1.1, 1.1}) {
    frame.offset_px = offset_px;
    EXPECT_FALSE(stands_alone(frame)) << offset_px;
  }
  frame.offset_px = -0.9;
  EXPECT_TRUE(stands_alone(frame));
}

TEST(CalibrationEvidence, FramesBeforeItOutweighAFrame) {
  EXPECT_FALSE(after(kWrong, 1).stands_in(kTwice));
  FrameFits right = kTwice;
  right.believed_px = right.mended_px;
  right.apart_px = 0;
  FrameFits frame = kTwice;
  frame.believed_px = {20, 20};  // by itself too little
  EXPECT_FALSE(stands_alone(frame));
  EXPECT_TRUE(after(right, 1).stands_in(frame));
}

TEST(CalibrationEvidence, AFrameThatMovedIsMended) {
  FrameFits right = kTwice;
  right.mended_px = right.believed_px = {5000, 5000};
  const CalibrationEvidence told = after(right, 3);
  FrameFits frame = kTwice;
  frame.believed_px = {16, 16};
  EXPECT_TRUE(told.stands_in(frame));
  frame.believed_px = {14, 14};
  EXPECT_FALSE(told.stands_in(frame));
  frame.believed_px = {200, 200};
  frame.mended_px = {449, 449};
  EXPECT_TRUE(told.stands_in(frame));
  frame.mended_px = {451, 451};
  EXPECT_FALSE(told.stands_in(frame));
}

TEST(CalibrationEvidence, ASmallCorrectionIsKeptUnlessAllFitsToThePixel) {
  FrameFits small = kTwice;
  small.believed_px = {90, 90};
  small.apart_px = 2.9;
  EXPECT_FALSE(stands_alone(small));
  EXPECT_FALSE(after(small, 1).stands_in(small));  // of 200 px
  EXPECT_TRUE(after(small, 2).stands_in(small));
  FrameFits blunt = small;
  blunt.sharpness = 0.79;
  EXPECT_FALSE(after(blunt, 9).stands_in(blunt));
  blunt.apart_px = 3.1;
  EXPECT_TRUE(after(blunt, 9).stands_in(blunt));
}

PlateScene two_plates() {
  return PlateScene({{-0.6, -0.1, -0.4, 0.3, 1.4, 1}, {0.2, 0.7, -0.3, 0.4, 2.0, 2}});
}

Sight seen(const PlateScene& scene, const Calibration& believed) {
  return {believed, scene.depth(), scene.detections()};
}

TEST(CalibrationEvidence, IsWhatAFrameOfRightAndOfWrongCalibrationTells) {
  const PlateScene scene = two_plates();
  const LabelledDepth right = label_surfaces(seen(scene, scene.truth()), {});
  ASSERT_TRUE(right.fits);
  EXPECT_LT(right.fits->apart_px, 1);
  EXPECT_GT(right.fits->sharpness, 0.8);
  for (std::size_t n = 0; n < 2; ++n)
    EXPECT_NEAR(right.fits->believed_px[n], right.fits->mended_px[n],
                0.1 * right.fits->mended_px[n]);

  const LabelledDepth wrong =
      label_surfaces(seen(scene, scene.misregistered({0.04, 0, 0}, {0, 0, 0})), {});
  ASSERT_TRUE(wrong.fits);
  EXPECT_FALSE(wrong.is_as_believed);
  EXPECT_NEAR(wrong.fits->apart_px, 0.04 * 277 / 1.6, 2);
  EXPECT_LT(wrong.fits->believed_px[0], 0.3 * wrong.fits->mended_px[0]);
  EXPECT_GT(wrong.fits->believed_px[1], 0.7 * wrong.fits->mended_px[1]);
  for (std::size_t n = 0; n < 2; ++n)
    EXPECT_NEAR(wrong.fits->mended_px[n], right.fits->mended_px[n], 0.1 * right.fits->mended_px[n]);
}

TEST(CalibrationEvidence, FramesInTheirOrderLearnFromThoseBefore) {
  const PlateScene scene = two_plates();
  const Segmentation method = EdgeAligned();
  CalibrationEvidence told;
  const auto of = [&](const Calibration& believed) {
    return segment_after(told, seen(scene, believed), method, 0.05, false).front();
  };
  const Calibration off = scene.misregistered({0.03, 0, 0}, {0, 0, 0});
  const std::size_t alone = of(off).points.size();
  told = {};
  for (int n = 0; n < 9; ++n) static_cast<void>(of(scene.truth()));
  const Sight later = seen(scene, off).after(told);
  EXPECT_TRUE(label_surfaces(later, {}).is_as_believed);
  EXPECT_EQ(label_surfaces(later, {}).alignment.translation, Eigen::Vector3f(0, 0, 0));
  EXPECT_FALSE(label_surfaces(seen(scene, off), {}).is_as_believed);
  EXPECT_NE(of(off).points.size(), alone);
}

TEST(CalibrationEvidence, IsNoneWhereTheCalibrationIsKnown) {
  const PlateScene scene = two_plates();
  const LabelledDepth known =
      label_surfaces(seen(scene, scene.truth()), {.fit = OutlineFit::masks});
  EXPECT_FALSE(known.fits);
  EXPECT_TRUE(known.is_as_believed);
}

}  // namespace
}  // namespace mapscore
