// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/trial_run.hpp"
#include "eval/lab/truth_cache.hpp"
#include "files/file_bytes.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using testing::study_of;

/// The tiny recording, colour and depth at 0, 0.5, 1 and 1.5 s, and the same images told with other
/// stamps.
class TimeOffset : public ::testing::Test {
 protected:
  TimeOffset() : recorded_(written("recorded")) {}

  [[nodiscard]] const Recording& recorded() const { return recorded_; }

  /// Depth images `earlier_s` earlier than they are; poses by depth image, from `poses`.
  [[nodiscard]] Recording retold(double earlier_s, const std::vector<Pose>& poses) {
    const std::filesystem::path folder = folder_.path() / "retold";
    mapscore::testing::write_tiny_recording(folder);
    std::vector<StampedImage> depth = read_stamp_list(folder / "depth.txt");
    std::vector<TrajectoryPose> trajectory;
    for (std::size_t i = 0; i < depth.size(); ++i) {
      depth[i].stamp_s -= earlier_s;
      trajectory.push_back({depth[i].stamp_s, poses.at(i)});
    }
    write_file(folder / "depth.txt", stamp_list_text(depth));
    write_file(folder / "groundtruth.txt", trajectory_text(trajectory));
    return Recording::open(folder);
  }

  /// Counts of the whole trial, and those of each frame that is scored by itself.
  struct Outcome {
    Counts counts;
    std::vector<FrameResult> frames;
  };
  static Outcome result(const Recording& recording, const std::string& text) {
    const ClassTable& table = recording.info().table;
    const Task task = plan_of(study_of(text), "recording").tasks[0];
    FrameCache frames(recording,
                      {.color = false, .label = true, .depth = true, .depth_label = true},
                      std::size_t{1} << 24);
    TruthCache truths(recording, table, frames, 1);
    PoseSources poses(recording);
    TrialRun run(task, recording, table, truths, poses);
    run.keep_frames();
    for (int i = 0; i < recording.frame_count(); ++i) run.advance(*frames.get(i, run.depth_of(i)));
    return {run.finish().counts, run.frames()};
  }

 private:
  [[nodiscard]] Recording written(const char* name) const {
    mapscore::testing::write_tiny_recording(folder_.path() / name);
    return Recording::open(folder_.path() / name);
  }

  mapscore::testing::TemporaryFolder folder_;
  Recording recorded_;
};

constexpr const char* kByFrame = "score: {unit: frame}\nmap_origin_m: [0.01, 0.02, 0.03]\n";

std::string offset_of(const char* ms, const char* more = "") {
  return fmt::format("{}faults: {{time_offset_ms: {}{}}}\n", kByFrame, ms, more);
}

TEST_F(TimeOffset, OfZeroChangesNothing) {
  EXPECT_EQ(result(recorded(), offset_of("0")).counts, result(recorded(), kByFrame).counts);
}

TEST_F(TimeOffset, IsADepthCameraWhoseStampsAreLate) {
  std::vector<Pose> poses;
  for (int i = 0; i < 4; ++i) poses.push_back(recorded().T_world_base_of_depth(i));
  const Recording late = retold(0.5, poses);
  EXPECT_EQ(late.depth_of(0), 1);
  const Outcome offset = result(recorded(), offset_of("500"));
  EXPECT_EQ(offset.counts, result(late, kByFrame).counts);
  EXPECT_NE(offset.counts, result(recorded(), kByFrame).counts);
  // Half of the spacing is still nearest to the image itself, the earlier of two equally near.
  EXPECT_EQ(result(recorded(), offset_of("250")).counts, result(recorded(), kByFrame).counts);
  EXPECT_EQ(result(recorded(), offset_of("251")).counts, offset.counts);
}

TEST_F(TimeOffset, LooksThePoseUpAtTheColourStampIfAsked) {
  // The same poses by a trajectory that has them at the wrong images: depth image i + 1 as if taken
  // from where colour image i was.
  std::vector<Pose> poses{Pose::Identity()};
  for (const int i : {0, 1, 2}) poses.push_back(recorded().T_world_base_of_color(i));
  const Outcome retold_poses = result(retold(0.5, poses), kByFrame),
                at_color = result(recorded(), offset_of("500", ", pose: {stamp: color}")),
                at_depth = result(recorded(), offset_of("500"));
  // What is mapped does not depend on the truth, which stays where it was.
  for (const std::size_t frame : {0u, 1u, 2u}) {
    const auto predicted = [&](const Outcome& outcome) {
      return outcome.frames.at(frame).counts.at(1).predicted;
    };
    EXPECT_EQ(predicted(at_color), predicted(retold_poses)) << frame;
    EXPECT_NE(predicted(at_color), predicted(at_depth)) << frame;
    EXPECT_EQ(at_color.frames.at(frame).counts.at(1).visible,
              at_depth.frames.at(frame).counts.at(1).visible);
  }
}

TEST_F(TimeOffset, FusedMapsAreScoredAgainstWhatTheRecordingSaw) {
  const std::string text = "map_origin_m: [0.01, 0.02, 0.03]\n";
  const ClassCounts plain = result(recorded(), text).counts.at(1),
                    offset =
                        result(recorded(), text + "faults: {time_offset_ms: 500}\n").counts.at(1);
  EXPECT_EQ(offset.visible, plain.visible);
  EXPECT_NE(offset.predicted, plain.predicted);
}

TEST_F(TimeOffset, DefaultsTheDepthCameraToItsOwnRate) {
  const auto rate = [](const std::string& text) { return depth_rate(study_of(text)); };
  EXPECT_EQ(rate("trajectory: {frames_per_s: 5}\n"), 5.0);
  EXPECT_EQ(rate("trajectory: {frames_per_s: 5, depth_frames_per_s: 15}\n"), 15.0);
  EXPECT_EQ(rate("faults: {time_offset_ms: 20}\n"), 30.0);
  EXPECT_EQ(rate("sweep: {faults.time_offset_ms: [0, 20]}\n"), 30.0);
  EXPECT_DOUBLE_EQ(rate("trajectory: {frames_per_s: 1.4}\nfaults: {time_offset_ms: 20}\n"), 30.8);
  EXPECT_EQ(rate("trajectory: {frames_per_s: 60}\nfaults: {time_offset_ms: 20}\n"), 60.0);
}

}  // namespace
}  // namespace mapscore::eval
