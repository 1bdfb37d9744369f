// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/object_run.hpp"
#include "eval/lab/sights.hpp"
#include "eval/lab/trial_run.hpp"
#include "tests/core/segmentation/edge_aligned/plate_scene.hpp"
#include "tests/support/tiny_recording.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace mapscore::eval {
namespace {

using mapscore::testing::PlateScene;

const PlateScene kScene({{-0.6, -0.1, -0.4, 0.3, 1.4, 1}, {0.2, 0.7, -0.3, 0.4, 2.0, 2}});

PlateScene moved_aside(double aside_m) {
  return PlateScene({{-0.6 + aside_m, -0.1 + aside_m, -0.4, 0.3, 1.4, 1},
                     {0.2 + aside_m, 0.7 + aside_m, -0.3, 0.4, 2.0, 2}});
}

/// The masks of plates that the depth image has elsewhere, by 11 px: alone, it is mended.
Sight first_sight() {
  const PlateScene moved({{-0.54, -0.04, -0.4, 0.3, 1.4, 1}, {0.29, 0.79, -0.3, 0.4, 2.0, 2}});
  return {kScene.truth(), moved.depth(), kScene.detections()};
}

/// 64 frames, of which every sixteenth shows nothing, and the
/// others two plates, elsewhere each time.
struct Frames {
  Frames() : all(64) { std::iota(all.begin(), all.end(), 0); }

  [[nodiscard]] CalibrationEvidence look(const Segmentation& segmentation) {
    return first_look(segmentation, mapped, kScene.truth(), all, [&](int frame) -> Sight {
      asked.push_back(frame);
      if (frame % 16 == 0) return {kScene.truth(), kScene.depth(), {}};
      const PlateScene scene = moved_aside(0.002 * frame);
      return {kScene.truth(), scene.depth(), scene.detections()};
    });
  }

  std::vector<int> all;
  std::vector<int> asked = {};
  MappedFrames mapped = AllFrames();
};

TEST(FirstLook, FitsSomeFramesWithObjectsSpreadOverAll) {
  Frames frames;
  static_cast<void>(frames.look(EdgeAligned()));
  EXPECT_EQ(frames.asked, (std::vector<int>{0, 32, 16, 48, 8, 40, 24, 56, 4, 36, 20, 52}));
}

TEST(FirstLook, EndsAfter64FramesThatShowNothingAndTakesNoMore) {
  int asked = 0;
  std::vector<int> frames(1000);
  std::iota(frames.begin(), frames.end(), 0);
  CalibrationEvidence told =
      first_look(EdgeAligned(), AllFrames(), kScene.truth(), frames, [&](int) -> Sight {
        ++asked;
        return {kScene.truth(), kScene.depth(), {}};
      });
  EXPECT_EQ(asked, 64);
  told.add(fitted(Sight(kScene.truth(), kScene.depth(), kScene.detections()), EdgeAligned()));
  EXPECT_FALSE(label_surfaces(first_sight().among(told), {}).is_known);
}

TEST(FirstLook, IsNoneWhereFramesThatAreLeftOutAreToChangeNothing) {
  Frames frames;
  frames.mapped = KeyFramesAlone();
  CalibrationEvidence told = frames.look(EdgeAligned());
  EXPECT_TRUE(frames.asked.empty());
  told.add(fitted(Sight(kScene.truth(), kScene.depth(), kScene.detections()), EdgeAligned()));
  EXPECT_TRUE(label_surfaces(first_sight().among(told), {}).is_known);
}

TEST(FirstLook, ReadsNothingWhereTheCalibrationIsTakenAsItIs) {
  Frames frames;
  static_cast<void>(frames.look(Direct()));
  static_cast<void>(frames.look(EdgeAligned{.fit = OutlineFit::masks}));
  EXPECT_TRUE(frames.asked.empty());
}

TEST(FirstLook, TellsTheFirstFrameOfAMapThatTheCalibrationStands) {
  EXPECT_FALSE(label_surfaces(first_sight(), {}).is_known);
  Frames frames;
  EXPECT_TRUE(label_surfaces(first_sight().among(frames.look(EdgeAligned())), {}).is_known);
}

/// The first sight and three frames that show that the calibration stands.
class LookedAtFirst : public ::testing::Test {
 protected:
  [[nodiscard]] const Recording& recording() const { return recording_; }
  [[nodiscard]] static Task task(const std::string& unit) {
    const Study study = parse_study(
        "recording: plates\nmethods: {ours: {segmentation: {edge_aligned: {}}}}\n"
        "map_origin_m: [0, 0, 0]\nscore: {unit: " +
            unit + "}\n",
        "study.yaml", {});
    const Plan plan = plan_of(study, "");
    return plan.tasks[plan.trials[0].task];
  }
  [[nodiscard]] static std::size_t points_of(const Sight& sight) {
    std::size_t points = 0;
    for (const Segment& found : segment(sight, Segmentation(EdgeAligned()), 0.05, false))
      points += found.points.size();
    return points;
  }

 private:
  [[nodiscard]] std::filesystem::path written() const {
    RecordingInfo info;
    info.calibration = kScene.truth();
    info.calibration.T_base_depth.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    info.color_rate_hz = info.depth_rate_hz = 1;
    info.table.classes.push_back({1, "thing", {255, 0, 0}, true});
    info.table.instances.push_back({1, "left", 1});
    info.table.instances.push_back({2, "right", 1});
    info.scene = "plates.xml";
    info.frame_count = 4;
    RecordingWriter writer(folder_.path() / "plates", info);
    for (int index = 0; index < info.frame_count; ++index) {
      const PlateScene scene = moved_aside(0.05 * index);
      Frame frame;
      frame.index = index;
      frame.stamp_s = index;
      frame.label = index == 0 ? kScene.label() : scene.label();
      frame.depth = index == 0 ? first_sight().depth() : scene.depth();
      frame.depth_label = scene.depth_label();
      frame.color = cv::Mat3b(frame.label.size(), cv::Vec3b(0, 0, 0));
      mapscore::testing::write_frame(writer, frame);
    }
    writer.write_shapes(mapscore::testing::tiny_shapes());
    writer.finish();
    return folder_.path() / "plates";
  }

  mapscore::testing::TemporaryFolder folder_;
  Recording recording_ = Recording::open(written());
};

TEST_F(LookedAtFirst, ATrialsFirstFrameKnowsWhatTheOthersShow) {
  const ClassTable& table = recording().info().table;
  const auto first_points = [&](const std::string& unit) {
    FrameCache frames(recording(),
                      {.color = false, .label = true, .depth = true, .depth_label = true},
                      std::size_t{1} << 24);
    TruthCache truths(recording(), table, frames, 1);
    PoseSources poses(recording());
    const Task one = task(unit);
    TrialRun run(one, recording(), table, truths, poses);
    run.advance(*frames.get(0));
    return run.finish().accounting.points;
  };
  const auto alone = static_cast<std::int64_t>(points_of(first_sight()));
  EXPECT_EQ(first_points("frame"), alone);
  EXPECT_LT(first_points("map") + 500, alone);
}

TEST_F(LookedAtFirst, SoDoesAMapOfObjects) {
  const ClassTable& table = recording().info().table;
  const Task one = task("map");
  PoseSources poses(recording());
  ObjectRun run(one, recording(), table, poses, {});
  run.advance(
      recording().read(0, 0, {.color = false, .label = true, .depth = true, .depth_label = false}));
  const auto boxes =
      object_detections(segment(first_sight(), Segmentation(EdgeAligned()), 0.05, false),
                        recording().info().calibration.T_base_depth, {});
  ASSERT_EQ(boxes.size(), 2u);
  ASSERT_EQ(run.map().objects().size(), 2u);
  for (std::size_t n = 0; n < 2; ++n)
    EXPECT_GT((run.map().objects()[n].box.size_m - boxes[n].box.size_m).norm(), 0.01);
}

}  // namespace
}  // namespace mapscore::eval
