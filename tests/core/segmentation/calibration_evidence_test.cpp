// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/calibration_evidence.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace mapscore {
namespace {

/// A frame of which every other correction explains the same.
class Witness : public FittedFrame {
 public:
  Witness(double mended_px, double believed_px, double by_others_px)
      : FittedFrame(mended_px, believed_px), by_others_px_(by_others_px) {}
  [[nodiscard]] double explained_px(const FittedFrame& /*other*/) const override {
    ++asked;
    return by_others_px_;
  }
  mutable int asked = 0;

 private:
  double by_others_px_;
};

const Witness kFrame(400, 200, 0);  ///< the one that is judged, twice as good with its correction

bool stands_beside(double mended_px, double believed_px, double by_others_px) {
  CalibrationEvidence told;
  told.add(std::make_shared<Witness>(mended_px, believed_px, by_others_px));
  return told.judge(kFrame).stands;
}

TEST(CalibrationEvidence, AFrameByItselfIsMended) {
  CalibrationEvidence told;
  EXPECT_FALSE(told.judge(kFrame).stands);
  told.add(nullptr);  // of a method that mends nothing
  EXPECT_FALSE(told.judge(kFrame).stands);
}

TEST(CalibrationEvidence, ACorrectionIsTakenThatExplainsMoreOfOtherFrames) {
  EXPECT_TRUE(stands_beside(1000, 800, 700));
  EXPECT_TRUE(stands_beside(1000, 800, 840));
  EXPECT_FALSE(stands_beside(1000, 800, 844));  // 800 are 95 % of 842
}

TEST(CalibrationEvidence, OtherFramesThatCorrectionsExplainFarBetterDoNotStand) {
  EXPECT_TRUE(stands_beside(1000, 601, 0));
  EXPECT_FALSE(stands_beside(1000, 599, 0));
}

TEST(CalibrationEvidence, OtherFramesMustShowSomething) {
  EXPECT_TRUE(stands_beside(101, 101, 0));
  EXPECT_FALSE(stands_beside(99, 99, 0));
}

TEST(CalibrationEvidence, NoFrameCountsForMoreThanItsOwnCorrectionExplains) {
  CalibrationEvidence told;
  told.add(std::make_shared<Witness>(300, 110, 50));
  told.add(std::make_shared<Witness>(200, 900, 0));  // as believed 200: with 110 more than 60 %
  EXPECT_TRUE(told.judge(kFrame).stands);
  told.add(std::make_shared<Witness>(150, 10, 0));  // 320 of 650 are less
  EXPECT_FALSE(told.judge(kFrame).stands);
  EXPECT_TRUE(stands_beside(100, 100, 900));  // by others 100, too
}

TEST(CalibrationEvidence, AFrameThatMovedIsMended) {
  CalibrationEvidence told;
  told.add(std::make_shared<Witness>(5000, 5000, 0));
  EXPECT_TRUE(told.judge(Witness(400, 61, 0)).stands);
  EXPECT_FALSE(told.judge(Witness(400, 59, 0)).stands);  // 15 %
  EXPECT_TRUE(told.judge(Witness(1499, 1000, 0)).stands);
  EXPECT_FALSE(told.judge(Witness(1501, 1000, 0)).stands);  // by 500 px
}

TEST(CalibrationEvidence, AFrameIsNoWitnessOfItself) {
  const Witness frame(400, 300, 0);
  CalibrationEvidence told;
  told.add(std::make_shared<Witness>(400, 300, 0));  // the same view again
  told.add(std::make_shared<Witness>(400, 300, 0));
  EXPECT_FALSE(told.judge(frame).stands);
  told.add(std::make_shared<Witness>(400, 301, 0));
  EXPECT_TRUE(told.judge(frame).stands);
}

TEST(CalibrationEvidence, OfManyFramesItKeepsAFewSpreadOverAll) {
  CalibrationEvidence told;
  std::vector<std::shared_ptr<Witness>> frames;
  for (int n = 0; n < 100; ++n) {
    frames.push_back(std::make_shared<Witness>(500 + n, 500, 0));
    told.add(frames.back());
  }
  for (const auto& frame : frames) frame->asked = 0;  // to tell which are kept
  EXPECT_TRUE(told.judge(kFrame).stands);
  std::vector<int> asked;
  for (int n = 0; n < 100; ++n)
    if (frames[static_cast<std::size_t>(n)]->asked > 0) asked.push_back(n);
  EXPECT_EQ(asked, (std::vector<int>{0, 16, 32, 48, 64, 80, 96}));
}

/// A frame whose correction explains the same of every other.
class Mended : public FittedFrame {
 public:
  Mended(double mended_px, double explains_px, double believed_px = 10)
      : FittedFrame(mended_px, believed_px), explains_px_(explains_px) {}
  [[nodiscard]] double explained_px(const FittedFrame& other) const override {
    return static_cast<const Mended&>(other).explains_px_;
  }
  [[nodiscard]] std::shared_ptr<const FittedFrame> refined_on(
      const std::vector<std::shared_ptr<const FittedFrame>>& frames) const override {
    return refined && frames.size() == 3 ? refined : nullptr;
  }
  std::shared_ptr<const FittedFrame> refined = {};

 private:
  double explains_px_;
};

/// Whose correction a frame takes, of frames that corrections explain by 1000, 1001, ... px.
std::shared_ptr<const FittedFrame> agreed_by(const std::vector<double>& explain_px,
                                             const Mended& frame, double believed_px = 10) {
  CalibrationEvidence told;
  for (std::size_t n = 0; n < explain_px.size(); ++n)
    told.add(std::make_shared<Mended>(1000 + static_cast<double>(n), explain_px[n], believed_px));
  EXPECT_FALSE(told.judge(frame).stands);
  return told.judge(frame).agreed;
}

TEST(CalibrationEvidence, AFrameTakesTheCorrectionThatExplainsMostOfTheOthers) {
  const Mended frame(900, 300);
  const auto best = agreed_by({200, 700, 600}, frame);
  ASSERT_TRUE(best);
  EXPECT_EQ(best->mended_px(), 1001);
  EXPECT_FALSE(agreed_by({}, frame));
  EXPECT_FALSE(agreed_by({700}, frame));  // of no other
}

TEST(CalibrationEvidence, ACorrectionThatServesAllExplainsHalfOfThemAndMoreThanTheFramesOwn) {
  EXPECT_TRUE(agreed_by({510, 100, 100}, Mended(900, 300)));
  EXPECT_FALSE(agreed_by({490, 100, 100}, Mended(900, 300)));
  EXPECT_TRUE(agreed_by({700, 100, 100}, Mended(900, 580)));
  EXPECT_FALSE(agreed_by({700, 100, 100}, Mended(900, 590)));
}

TEST(CalibrationEvidence, ACorrectionThatServesAllExplainsHalfAsMuchAgainAsWhatIsBelieved) {
  EXPECT_TRUE(agreed_by({700, 100, 100}, Mended(900, 300), 460));
  EXPECT_FALSE(agreed_by({700, 100, 100}, Mended(900, 300), 475));
}

TEST(CalibrationEvidence, ACorrectionThatServesAllIsRefinedOnAllUnlessThatExplainsLess) {
  for (const double explains_px : {690.0, 710.0}) {
    CalibrationEvidence told;
    const auto refined = std::make_shared<Mended>(50, explains_px);
    for (const double by_px : {200, 700, 600}) {
      const auto frame = std::make_shared<Mended>(1000 + by_px / 100, by_px);
      frame->refined = by_px == 700 ? refined : nullptr;
      told.add(frame);
    }
    const auto agreed = told.judge(Mended(900, 300)).agreed;
    ASSERT_TRUE(agreed);
    EXPECT_EQ(agreed->mended_px(), explains_px > 700 ? 50 : 1007);
  }
}

TEST(CalibrationEvidence, WhatIsBelievedIsHeldAgainstACorrectionAsItWasBeforeItWasRefined) {
  for (const double believed_px : {460.0, 475.0}) {
    CalibrationEvidence told;
    for (const double by_px : {200, 700, 600}) {
      const auto frame = std::make_shared<Mended>(1000 + by_px / 100, by_px, believed_px);
      frame->refined = std::make_shared<Mended>(50, 990);
      told.add(frame);
    }
    EXPECT_EQ(told.judge(Mended(900, 300)).agreed != nullptr, believed_px < 470);
  }
}

TEST(CalibrationEvidence, AFrameThatMovedTakesNoOthersCorrection) {
  EXPECT_TRUE(agreed_by({700, 100, 100}, Mended(1190, 300)));
  EXPECT_FALSE(agreed_by({700, 100, 100}, Mended(1210, 300)));  // 510 px more
  EXPECT_FALSE(agreed_by({700, 100, 100}, Mended(1000, 700)));  // its own explains as much
}

TEST(CalibrationEvidence, TakesNoMoreOnceItIsClosed) {
  CalibrationEvidence told;
  told.close();
  told.add(std::make_shared<Witness>(1000, 1000, 0));
  EXPECT_FALSE(told.judge(kFrame).stands);
}

}  // namespace
}  // namespace mapscore
