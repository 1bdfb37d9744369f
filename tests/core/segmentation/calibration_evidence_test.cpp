// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/calibration_evidence.hpp"

#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"
#include "core/segmentation/segmentation.hpp"
#include "tests/core/segmentation/edge_aligned/plate_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mapscore {
namespace {

using testing::PlateScene;

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

PlateScene two_plates(double aside_m) {
  return PlateScene({{-0.6 + aside_m, -0.1 + aside_m, -0.4, 0.3, 1.4, 1},
                     {0.2 + aside_m, 0.7 + aside_m, -0.3, 0.4, 2.0, 2}});
}

Sight seen(const PlateScene& scene, const Calibration& believed) {
  return {believed, scene.depth(), scene.detections()};
}

TEST(CalibrationEvidence, FramesOfEdgeAlignedTryEachOthersCorrections) {
  const PlateScene here = two_plates(0), there = two_plates(0.1);
  const auto fit = [](const PlateScene& scene, const Calibration& believed) {
    return label_surfaces(seen(scene, believed), {}).fit;
  };
  const Calibration off = here.misregistered({0.04, 0, 0}, {0, 0, 0});
  const auto right = fit(here, here.truth()), wrong = fit(here, off), too = fit(there, off);
  ASSERT_TRUE(right && wrong && too);
  EXPECT_NEAR(right->believed_px(), right->mended_px(), 0.1 * right->mended_px());
  EXPECT_NEAR(wrong->mended_px(), right->mended_px(), 0.1 * right->mended_px());
  EXPECT_LT(wrong->believed_px(), 0.7 * wrong->mended_px());
  EXPECT_NEAR(wrong->explained_px(*wrong), wrong->mended_px(), 1e-3);
  EXPECT_GT(wrong->explained_px(*too), 0.8 * wrong->mended_px());
  EXPECT_LT(right->explained_px(*too), 0.7 * right->mended_px());
  EXPECT_EQ(wrong->explained_px(kFrame), 0);  // of another method
}

TEST(CalibrationEvidence, IsWhatFramesWithoutTheirVotesTell) {
  const PlateScene scene = two_plates(0);
  const Calibration off = scene.misregistered({0.04, 0, 0}, {0, 0, 0});
  const auto alone = fitted(seen(scene, off), Segmentation(EdgeAligned())),
             labelled = label_surfaces(seen(scene, off), {}).fit;
  ASSERT_TRUE(alone && labelled);
  EXPECT_EQ(alone->mended_px(), labelled->mended_px());
  EXPECT_EQ(alone->believed_px(), labelled->believed_px());
  EXPECT_EQ(alone->explained_px(*labelled), labelled->explained_px(*alone));
  EXPECT_FALSE(fitted(seen(scene, off), Segmentation(Direct())));
}

TEST(CalibrationEvidence, KeepsOutlinesWhoseGroovesTheVotesOpenAgain) {
  const PlateScene near({{-0.6, -0.1, -0.4, 0.3, 1.4, 1}, {-0.085, 0.4, -0.4, 0.3, 1.4, 2}});
  const Calibration off = near.misregistered({0.04, 0, 0}, {0, 0, 0});
  ASSERT_FALSE(outline_field(near.detections(), 320, 240, 40).closed.empty());
  const auto untouched = fitted(seen(near, off), EdgeAligned()),
             voted = label_surfaces(seen(near, off), {}).fit;
  EXPECT_EQ(voted->explained_px(*untouched), untouched->explained_px(*untouched));
}

TEST(CalibrationEvidence, FramesLearnFromOthers) {
  const PlateScene scene = two_plates(0);
  const Calibration off = scene.misregistered({0.03, 0, 0}, {0, 0, 0});
  const Segmentation method = EdgeAligned();
  CalibrationEvidence told;
  const auto of = [&](double aside_m, const Calibration& believed) {
    return segment_after(told, seen(two_plates(aside_m), believed), method, 0.05, false).front();
  };
  const std::size_t alone = of(0, off).points.size();
  told = {};
  for (const double aside_m : {0.1, -0.1}) static_cast<void>(of(aside_m, scene.truth()));
  const LabelledDepth later = label_surfaces(seen(scene, off).among(told), {});
  EXPECT_TRUE(later.is_known);
  EXPECT_EQ(later.alignment.translation, Eigen::Vector3f(0, 0, 0));
  EXPECT_NE(of(0, off).points.size(), alone);
  EXPECT_FALSE(label_surfaces(seen(scene, off), {}).is_known);

  told = {};
  for (const double aside_m : {0.1, -0.1}) static_cast<void>(of(aside_m, off));
  EXPECT_FALSE(label_surfaces(seen(scene, off).among(told), {}).is_known);
}

/// What a fit changes of a right calibration is chance: a shift against a turn, that what lies
/// nearer than the outlines would be moved by.
TEST(CalibrationEvidence, ACalibrationThatStandsIsAsBelievedThoughTheFitHardlyDiffers) {
  const auto plates = [](double aside_m) {
    return PlateScene({{-0.75 + aside_m, -0.45 + aside_m, -0.5, -0.25, 1.6, 1},
                       {0.2 + aside_m, 0.5 + aside_m, -0.4, -0.15, 1.2, 2},
                       {-0.6 + aside_m, -0.2 + aside_m, 0.2, 0.6, 2.2, 3},
                       {0.2 + aside_m, 0.5 + aside_m, 0.1, 0.4, 1.5, 4}});
  };
  const PlateScene scene = plates(0);
  const Sight sight = seen(scene, scene.truth());
  CalibrationEvidence told;
  for (const double aside_m : {0.1, -0.1})
    told.add(fitted(seen(plates(aside_m), scene.truth()), EdgeAligned()));
  const LabelledDepth alone = label_surfaces(sight, {}),
                      among = label_surfaces(sight.among(told), {});
  EXPECT_GT(alone.alignment.translation.norm(), 0);
  EXPECT_LT(alone.alignment.translation.norm(), 0.01);
  EXPECT_TRUE(among.is_known);
  EXPECT_EQ(among.alignment.translation, Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(among.alignment.rotation, Eigen::Matrix3f(Eigen::Matrix3f::Identity()));
  EXPECT_EQ(among.alignment.focal, 1.0F);
  EXPECT_EQ(among.alignment.offset_px, alone.alignment.offset_px);
}

/// A frame whose own fit errs by 11 px takes the correction that the others agree on, with its
/// masks' size fitted anew.
TEST(CalibrationEvidence, AFrameThatErrsTakesTheOthersCorrection) {
  const PlateScene scene = two_plates(0);
  const PlateScene moved({{-0.54, -0.04, -0.4, 0.3, 1.4, 1}, {0.29, 0.79, -0.3, 0.4, 2.0, 2}});
  const Calibration off = scene.misregistered({0, 0.05, 0}, {0, 0, 0});
  CalibrationEvidence told;
  for (const double aside_m : {0.1, -0.1, 0.2})
    told.add(fitted(seen(two_plates(aside_m), off), EdgeAligned()));
  const Sight errs(off, moved.depth(), scene.detections());
  const LabelledDepth alone = label_surfaces(errs, {}),
                      among = label_surfaces(errs.among(told), {});
  EXPECT_FALSE(alone.is_known);
  ASSERT_TRUE(among.is_known);
  const Eigen::Vector3f mend = among.alignment.translation;
  EXPECT_NEAR(mend.y() + among.alignment.rotation(1, 2) * 1.7F, -0.05, 0.015);
  EXPECT_GT((mend - alone.alignment.translation).norm(), 0.01);
}

/// How far a correction leaves a point at `z` m from where a shift of 5 cm downwards would be
/// undone, px at 500 px of focal length.
double left_px(const FittedFrame& frame, float z) {
  const OutlineAlignment mend = correction_of(frame).value();
  const Eigen::Vector3f p = mend.rotation * Eigen::Vector3f(0, 0, z) + mend.translation;
  return std::abs(500.0F * (p.y() / p.z() + 0.05F / z));
}

/// One plate does not tell a turn from a shift; plates at three depths together do.
TEST(CalibrationEvidence, FramesTogetherTellATurnFromAShift) {
  std::vector<std::shared_ptr<const FittedFrame>> frames;
  for (const double z : {1.0, 1.6, 2.4}) {
    const PlateScene scene({{-0.3 * z, 0.25 * z, -0.2 * z, 0.25 * z, z, 1}});
    frames.push_back(
        fitted(seen(scene, scene.misregistered({0, 0.05, 0}, {0, 0, 0})), EdgeAligned()));
  }
  ASSERT_TRUE(frames[1]);
  const auto refined = frames[1]->refined_on(frames);
  ASSERT_TRUE(refined);
  EXPECT_GT(left_px(*frames[1], 1.0F), 2);
  for (const float z : {1.0F, 1.6F, 2.4F}) EXPECT_LT(left_px(*refined, z), 1) << z;
  frames.push_back(std::make_shared<Witness>(1000, 1000, 0));
  EXPECT_FALSE(frames[1]->refined_on(frames));  // another method's frame
}

TEST(CalibrationEvidence, IsNoneWhereTheCalibrationIsKnown) {
  const PlateScene scene = two_plates(0);
  const EdgeAligned known{.fit = OutlineFit::masks};
  const LabelledDepth labelled = label_surfaces(seen(scene, scene.truth()), known);
  EXPECT_FALSE(labelled.fit);
  EXPECT_TRUE(labelled.is_known);
  EXPECT_FALSE(fitted(seen(scene, scene.truth()), known));
}

}  // namespace
}  // namespace mapscore
