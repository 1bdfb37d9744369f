// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/render/baked_frames.hpp"

#include "core/error.hpp"
#include "eval/lab/trial_run.hpp"
#include "eval/lab/truth_cache.hpp"
#include "eval/recording/frame_cache.hpp"
#include "eval/recording/recording_writer.hpp"
#include "eval/render/replay_check.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"
#include "tests/support/expect_error.hpp"

#include <gmock/gmock.h>

#include <tuple>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using testing::study_of;

constexpr Channels kAll{.color = true, .label = true, .depth = true, .depth_label = true};

using Voxel = std::tuple<Eigen::Vector3d, ClassId, double>;

bool same(const cv::Mat1w& a, const cv::Mat1w& b) {
  return a.size() == b.size() && cv::countNonZero(a != b) == 0;
}

class Baked : public testing::TinyExperiment {
 protected:
  [[nodiscard]] BakedFrames baked_by(const Study& study) const {
    return {study, table(), recording().info().calibration.depth};
  }
  /// The tiny recording with a study's faults in its images.
  [[nodiscard]] Recording baked_copy(const Study& study) const {
    const BakedFrames baked = baked_by(study);
    RecordingInfo info = recording().info();
    info.baked = baked.faults();
    RecordingWriter writer(folder() / "baked", info);
    writer.write_shapes(recording().read_shapes());
    for (int i = 0; i < recording().frame_count(); ++i) {
      const Frame exact = recording().read(i, kAll);
      writer.write_color(baked.color(exact));
      writer.write_depth(baked.depth(exact));
    }
    writer.finish();
    return Recording::open(folder() / "baked");
  }
  /// The map that the trial of seed index 0 makes of a recording.
  [[nodiscard]] static std::vector<Voxel> map_of(const Recording& replayed, const Study& study) {
    const Task task = task_of(study, trials(study)[0], Labels::detected, replayed.content_hash());
    FrameCache frames(replayed, {.color = false, .label = true, .depth = true, .depth_label = true},
                      std::size_t{1} << 24);
    TruthCache truths(replayed, replayed.info().table, frames, 1);
    PoseSources poses(replayed);
    TrialRun run(task, replayed, replayed.info().table, truths, poses);
    for (int i = 0; i < replayed.frame_count(); ++i) run.advance(*frames.get(i, run.depth_of(i)));
    std::vector<Voxel> voxels;
    for (const MapVoxel& voxel : run.map().voxels())
      voxels.emplace_back(centre_of(voxel.key, 1.0), voxel.best_class, voxel.probability);
    return voxels;
  }
};

TEST_F(Baked, ImagesAreThoseThatATrialSees) {
  const Study noisy = study_of(
      "seed: 7\nfaults:\n  depth: {preset: astra, scale: 3}\n"
      "  labels: {boundary_px: 1, ragged_px: 1, holes: 0.2, islands: 0.1, miss: 0.5}\n");
  const Study exact = study_of("seed: 7\n");
  const auto expected = map_of(recording(), noisy);
  EXPECT_NE(expected, map_of(recording(), exact));
  EXPECT_EQ(map_of(baked_copy(noisy), exact), expected);
}

TEST_F(Baked, TruthStaysExact) {
  const BakedFrames baked = baked_by(study_of("faults: {depth: {axial: 3}, labels: {holes: 1}}\n"));
  const Frame exact = recording().read(1, kAll);
  EXPECT_FALSE(same(baked.depth(exact).depth, exact.depth));
  EXPECT_FALSE(same(baked.color(exact).label, exact.label));
  EXPECT_TRUE(same(baked.depth(exact).depth_label, exact.depth_label));
}

TEST_F(Baked, DosesOfZeroLeaveFramesAndInfoAlone) {
  for (const char* zero : {"depth: {preset: ideal}", "depth: {preset: astra, scale: 0}",
                           "labels: {confusion: 0.3, scores: 1}"}) {
    const BakedFrames baked = baked_by(study_of("faults: {" + std::string(zero) + "}\n"));
    EXPECT_EQ(baked.faults(), std::nullopt) << zero;
    for (int i = 0; i < recording().frame_count(); ++i) {
      const Frame exact = recording().read(i, kAll);
      EXPECT_TRUE(same(baked.depth(exact).depth, exact.depth)) << zero;
      EXPECT_TRUE(same(baked.color(exact).label, exact.label)) << zero;
    }
  }
}

TEST_F(Baked, TheRecordingSaysWhatIsInIt) {
  const Study study = study_of(
      "seed: 7\nfaults: {depth: {axial: 2, scale: 0.5}, labels: {boundary_px: -1, scores: 1}}\n");
  const BakedFaults expected{7, "axial: 1", "boundary_px: -1"};
  EXPECT_EQ(baked_by(study).faults(), expected);
  EXPECT_EQ(baked_copy(study).info().baked, expected);
  EXPECT_TRUE(has_verdict_faults(study));
  EXPECT_FALSE(has_verdict_faults(study_of("faults: {labels: {holes: 0.1}}\n")));
}

TEST_F(Baked, ASweptFaultIsRefused) {
  expect_error("--bake: the sweep gives faults.depth.axial several values",
               [&] { (void)baked_by(study_of("sweep: {faults.depth.axial: [0, 1]}\n")); });
  EXPECT_NO_THROW((void)baked_by(study_of("sweep: {faults.time_offset_ms: [0, 20]}\n")));
}

TEST_F(Baked, FaultsAreNotAddedToThoseThatAreBaked) {
  RecordingInfo info = recording().info();
  info.baked = BakedFaults{7, "axial: 1", ""};
  expect_error("faults.depth: the recording has such faults baked in (axial: 1)",
               [&] { check_replay(study_of("faults: {depth: {flying: 1}}\n"), info); });
  expect_error("faults.depth",
               [&] { check_replay(study_of("sweep: {faults.depth.axial: [0, 1]}\n"), info); });
  EXPECT_NO_THROW(check_replay(study_of("faults: {labels: {holes: 0.1}}\n"), info));
  EXPECT_NO_THROW(check_replay(study_of(""), info));
  EXPECT_THAT(note_on_baked(info), ::testing::HasSubstr("axial: 1"));
  info.baked = BakedFaults{7, "", "holes: 0.1"};
  EXPECT_EQ(note_on_baked(info), "");
}

TEST_F(Baked, AnotherSceneBesideARecordingIsSaid) {
  RecordingInfo info = recording().info();
  info.scene = "cottage.xml";
  Study study = study_of("");
  study.recording = "there";
  study.scene = "homes/cottage.xml";
  EXPECT_EQ(note_on_scene(study, info), "");
  study.scene = "home.xml";
  EXPECT_THAT(note_on_scene(study, info),
              ::testing::HasSubstr("home.xml is not the scene that was recorded, cottage.xml"));
}

TEST_F(Baked, AConfusionMatrixOfAnotherSizeIsRefusedBeforeTheFirstFrame) {
  const auto matrix = [](const char* text) {
    return study_of("faults: {labels: {confusion_matrix: " + std::string(text) + "}}\n");
  };
  expect_error("confusion_matrix: has 2 rows, but 1 classes are detected (crate)",
               [&] { check_classes(matrix("[[0.5, 0.5], [0, 1]]"), table()); });
  EXPECT_NO_THROW(check_classes(matrix("[[1]]"), table()));
}

}  // namespace
}  // namespace mapscore::eval
