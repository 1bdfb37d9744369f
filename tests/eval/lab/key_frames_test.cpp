// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT
//
// Maps of key frames against maps of recordings from which the other frames were left out.

#include "core/odometry/key_frames.hpp"

#include "eval/lab/bench.hpp"
#include "eval/lab/trial_run.hpp"
#include "files/file_bytes.hpp"
#include "tests/eval/lab/driven_recording.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

using mapscore::testing::ray_cast;
using mapscore::testing::tiny_info;
using testing::study_of;

constexpr int kDrivenFrames = 30;
/// Draws are numbered by frame, and the frames of a thinned recording are others.
constexpr const char* kNoDraws = "faults: {pose: {reported_scale: 0}}\n";

/// A drive past the crate, with a stop and turns; 5 frames a second.
std::vector<Frame> drive_past_the_crate() {
  const RecordingInfo info = tiny_info();
  const Calibration& calibration = info.calibration;
  std::vector<Frame> frames;
  for (int n = 0; n < kDrivenFrames; ++n) {
    Frame& frame = frames.emplace_back();
    frame.stamp_s = 0.2 * n;
    const double way_m = 0.07 * (n < 12 ? n : std::max(12, n - 6));  // stands for 6 frames
    const double yaw = 0.2 * std::sin(0.4 * n) - 0.1;
    frame.T_world_base.linear() =
        Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    frame.T_world_base.translation() = Eigen::Vector3d(-0.3 + 0.2 * way_m, 0.8 - way_m, 0.0);
    const Pose T_world_depth = frame.T_world_base * calibration.T_base_depth;
    const auto seen = ray_cast(testing::driven_home(), calibration.depth, T_world_depth,
                               calibration.range_min_m, calibration.range_max_m);
    frame.depth = seen.depth;
    frame.depth_label = seen.label;
    frame.label = ray_cast(testing::driven_home(), calibration.color,
                           T_world_depth * calibration.T_color_depth.inverse(), 0.0, 100.0)
                      .label;
    frame.color = cv::Mat3b(frame.label.size(), cv::Vec3b(0, 0, 0));
  }
  return frames;
}

/// A trial that was run to its end, and its map.
struct Ran {
  TrialResult result;
  std::vector<PoseBelief> beliefs;
  std::string map;
};

class KeyFramesInTheMap : public ::testing::Test {
 protected:
  KeyFramesInTheMap() : frames_(drive_past_the_crate()) {}

  /// A recording of these frames, with the odometry of all.
  [[nodiscard]] Recording recording_of(const std::string& name,
                                       const std::vector<int>& kept) const {
    RecordingInfo info = tiny_info();
    info.frame_count = static_cast<int>(kept.size());
    RecordingWriter writer(folder_.path() / name, info);
    for (std::size_t n = 0; n < kept.size(); ++n) {
      Frame frame = frames_[static_cast<std::size_t>(kept[n])];
      frame.index = static_cast<int>(n);
      mapscore::testing::write_frame(writer, frame);
    }
    writer.write_shapes(testing::driven_home());
    writer.write_odometry(testing::driven_odometry(frames_));
    for (const Frame& frame : frames_)
      if (std::ranges::none_of(kept, [&](int index) {
            return frames_[static_cast<std::size_t>(index)].stamp_s == frame.stamp_s;
          }))
        writer.add_poses({{frame.stamp_s, frame.T_world_base}});
    writer.finish();
    return Recording::open(folder_.path() / name);
  }

  [[nodiscard]] Ran run(const Recording& recording, const std::string& source,
                        const std::string& mapped) const {
    const Study study = study_of("localization: {source: " + source + "}\n" + kNoDraws,
                                 {"methods.direct.frames=" + mapped});
    const Task task = task_of(study, trials(study)[0], Labels::detected, recording.content_hash());
    Bench bench(recording, recording.info().table, false, std::size_t{1} << 24);
    const std::unique_ptr<TrialRun> trial = bench.start(task);
    bench.run(*trial);
    Ran ran{trial->finish(), trial->beliefs(), {}};
    trial->map().save(folder_.path() / "map.ot");
    ran.map = read_file(folder_.path() / "map.ot");
    return ran;
  }

  /// Key frames by the rule itself.
  [[nodiscard]] std::vector<int> plainly_chosen(const std::vector<PoseBelief>& beliefs) const {
    std::vector<int> chosen{0};
    const auto pose = [&](int n) {
      const PoseBelief& belief = beliefs[static_cast<std::size_t>(n)];
      return Pose(belief.T_map_odom * belief.T_odom_base);
    };
    for (int n = 1; n < kDrivenFrames; ++n)
      if (is_key_frame({}, frames_[static_cast<std::size_t>(n)].depth, tiny_info().calibration,
                       pose(chosen.back()).inverse() * pose(n)))
        chosen.push_back(n);
    return chosen;
  }

  [[nodiscard]] static std::vector<int> all() {
    std::vector<int> kept;
    for (int n = 0; n < kDrivenFrames; ++n) kept.push_back(n);
    return kept;
  }

 private:
  mapscore::testing::TemporaryFolder folder_;
  std::vector<Frame> frames_;
};

TEST_F(KeyFramesInTheMap, GiveTheMapOfARecordingWithoutTheOthers) {
  const Recording whole = recording_of("whole", all());
  int n = 0;
  for (const std::string source : {"truth", "odometry"}) {
    const Ran of_keys = run(whole, source, "key_frames"), of_all = run(whole, source, "all");
    const std::vector<int> keys = plainly_chosen(of_all.beliefs);
    ASSERT_GT(keys.size(), 4u);
    ASSERT_LT(keys.size(), 20u);
    const Recording thinned = recording_of("thinned_" + std::to_string(n++), keys);
    EXPECT_TRUE(run(thinned, source, "all").map == of_keys.map) << source;
    EXPECT_TRUE(of_all.map != of_keys.map) << source;
    const Accounting& accounting = of_keys.result.accounting;
    EXPECT_EQ(accounting.frames, kDrivenFrames);
    EXPECT_EQ(accounting.frames_left_out, kDrivenFrames - static_cast<int>(keys.size())) << source;
    EXPECT_EQ(of_all.result.accounting.frames_left_out, 0);
    EXPECT_LT(accounting.detections, of_all.result.accounting.detections);
  }
}

TEST_F(KeyFramesInTheMap, DependOnTheRobotsBeliefs) {
  const Recording whole = recording_of("whole", all());
  const auto left_out = [&](const std::string& source) {
    return run(whole, source, "{key_frames: {key_turn_deg: 360, key_overlap: 0, key_way_m: 0.22}}")
        .result.accounting.frames_left_out;
  };
  EXPECT_LT(left_out("odometry"), left_out("truth")) << "the wheels make every way longer";
}

TEST_F(KeyFramesInTheMap, CanBeSwept) {
  const Study study = parse_study(
      "recording: tiny\n"
      "methods:\n"
      "  direct: {segmentation: {direct: {}}, frames: {key_frames: {key_way_m: 0.5}}}\n"
      "sweep: {methods.direct.frames: [all, key_frames]}\n",
      "study.yaml");
  const LazyList<TrialSpec> specs = trials(study);
  ASSERT_EQ(specs.size(), 2u);
  const auto frames_of = [&](std::size_t n) {
    return task_of(study, specs[n], Labels::detected, "recording").config.methods.front().frames;
  };
  EXPECT_TRUE(std::holds_alternative<AllFrames>(frames_of(0)));
  ASSERT_TRUE(std::holds_alternative<KeyFramesAlone>(frames_of(1)));
  EXPECT_EQ(std::get<KeyFramesAlone>(frames_of(1)).key_way_m, 0.5) << "as the study has it";
}

TEST_F(KeyFramesInTheMap, TheLatticeCeilingMapsEveryFrame) {
  const Recording whole = recording_of("whole", all());
  const Study study = study_of("", {"methods.direct.frames=key_frames"});
  const Task task = task_of(study, trials(study)[0], Labels::truth, whole.content_hash());
  Bench bench(whole, whole.info().table, false, std::size_t{1} << 24);
  const std::unique_ptr<TrialRun> trial = bench.start(task);
  bench.run(*trial);
  EXPECT_EQ(trial->finish().accounting.frames_left_out, 0);
}

}  // namespace
}  // namespace mapscore::eval
