// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/calibration_evidence.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"
#include "core/segmentation/segmentation.hpp"
#include "plate_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mapscore {
namespace {

using testing::PlateScene;

/// A frame of another method.
class OtherFit : public FittedFrame {
 public:
  OtherFit() : FittedFrame(1000, 1000) {}
  [[nodiscard]] double explained_px(const FittedFrame& /*other*/) const override { return 0; }
};

PlateScene two_plates(double aside_m) {
  return PlateScene({{-0.6 + aside_m, -0.1 + aside_m, -0.4, 0.3, 1.4, 1},
                     {0.2 + aside_m, 0.7 + aside_m, -0.3, 0.4, 2.0, 2}});
}

Sight seen(const PlateScene& scene, const Calibration& believed) {
  return {believed, scene.depth(), scene.detections()};
}

TEST(FittedFrames, TryEachOthersCorrections) {
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
  EXPECT_EQ(wrong->explained_px(OtherFit()), 0);  // of another method
}

TEST(FittedFrames, AreTheSameWithoutTheirVotes) {
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

TEST(FittedFrames, KeepOutlinesWhoseGroovesTheVotesOpenAgain) {
  const PlateScene near({{-0.6, -0.1, -0.4, 0.3, 1.4, 1}, {-0.085, 0.4, -0.4, 0.3, 1.4, 2}});
  const Calibration off = near.misregistered({0.04, 0, 0}, {0, 0, 0});
  ASSERT_FALSE(outline_field(near.detections(), 320, 240, 40).closed.empty());
  const auto untouched = fitted(seen(near, off), EdgeAligned()),
             voted = label_surfaces(seen(near, off), {}).fit;
  EXPECT_EQ(voted->explained_px(*untouched), untouched->explained_px(*untouched));
}

TEST(FittedFrames, LearnFromOthers) {
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
TEST(FittedFrames, ACalibrationThatStandsIsAsBelievedThoughTheFitHardlyDiffers) {
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
TEST(FittedFrames, AFrameThatErrsTakesTheOthersCorrection) {
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
TEST(FittedFrames, TogetherTellATurnFromAShift) {
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
  frames.push_back(std::make_shared<OtherFit>());
  EXPECT_FALSE(frames[1]->refined_on(frames));  // another method's frame
}

TEST(FittedFrames, AreNoneWhereTheCalibrationIsKnown) {
  const PlateScene scene = two_plates(0);
  const EdgeAligned known{.fit = OutlineFit::masks};
  const LabelledDepth labelled = label_surfaces(seen(scene, scene.truth()), known);
  EXPECT_FALSE(labelled.fit);
  EXPECT_TRUE(labelled.is_known);
  EXPECT_FALSE(fitted(seen(scene, scene.truth()), known));
}

}  // namespace
}  // namespace mapscore
