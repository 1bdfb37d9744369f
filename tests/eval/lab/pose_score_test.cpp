// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/bench.hpp"
#include "eval/lab/trial_run.hpp"
#include "eval/score/metrics.hpp"
#include "files/file_bytes.hpp"
#include "tests/eval/lab/driven_recording.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace mapscore::eval {
namespace {

using testing::kOdometryScale;
using testing::study_of;

constexpr const char* kScore = "score: {poses: true}\nmap_yaw_deg: 30\n";

/// Trials on the tiny recording with the logs of its drive.
class PoseScoreTest : public ::testing::Test {
 protected:
  PoseScoreTest() : recording_(written()) {}

  [[nodiscard]] Counts counts(const std::string& lines, Labels labels = Labels::detected,
                              const std::string& score = kScore) const {
    const Study study = study_of(lines + '\n' + score);
    const Task task = task_of(study, trials(study)[0], labels, recording_.content_hash());
    Bench bench(recording_, recording_.info().table, false, std::size_t{1} << 24);
    const std::unique_ptr<TrialRun> run = bench.start(task);
    bench.run(*run);
    return run->finish().counts;
  }
  [[nodiscard]] const Recording& recording() const { return recording_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  [[nodiscard]] Recording written() const {
    testing::write_driven_recording(folder_.path() / "driven", true);
    return Recording::open(folder_.path() / "driven");
  }

  mapscore::testing::TemporaryFolder folder_;
  Recording recording_;
};

double figure(const Counts& counts, const char* name) {
  return value_of(counts.at(kBackground).poses.value().metrics(), name).value();
}

// The wheels make every way too long, from a right start.
TEST_F(PoseScoreTest, OdometryIsOffByItsScale) {
  const Counts scored = counts("localization: {source: odometry}");
  double sum = 0.0;
  const Pose start = recording().T_world_base_of_color(0);
  for (int frame = 0; frame < recording().frame_count(); ++frame) {
    const Pose& pose = recording().T_world_base_of_color(frame);
    const double off = (kOdometryScale - 1.0) * (pose.translation() - start.translation()).norm();
    sum += off * off;
  }
  EXPECT_EQ(scored[kBackground].poses->frames, recording().frame_count());
  EXPECT_NEAR(figure(scored, "ate_m"), std::sqrt(sum / recording().frame_count()), 1e-6);
  EXPECT_LT(figure(scored, "ate_aligned_m"), figure(scored, "ate_m"));
  EXPECT_NEAR(figure(scored, "ate_deg"), 0.0, 1e-6);
  EXPECT_EQ(scored[kBackground].poses->pairs, 0) << "the drive is shorter than a metre";
  for (std::size_t c = 1; c < scored.size(); ++c) EXPECT_EQ(scored[c].poses, PoseCounts{});
}

TEST_F(PoseScoreTest, TheTruthIsRightAndOfNoNees) {
  for (const Labels labels : {Labels::detected, Labels::truth}) {
    const Counts scored = counts("localization: {source: truth}", labels);
    EXPECT_EQ(figure(scored, "ate_m"), 0.0);
    EXPECT_EQ(scored[kBackground].poses->frames, recording().frame_count());
    EXPECT_EQ(scored[kBackground].poses->nees_frames, 0);
  }
}

TEST_F(PoseScoreTest, AGaussianIsOffByItsSigmas) {
  const std::string pose = "faults: {pose: {sigma_xy_m: 0.1, sigma_yaw_deg: 2}}";
  const Counts scored = counts(pose);
  EXPECT_GT(figure(scored, "ate_m"), 0.02);
  EXPECT_LT(figure(scored, "ate_m"), 0.5);
  EXPECT_EQ(scored[kBackground].poses->nees_frames, recording().frame_count());
  EXPECT_EQ(scored[kBackground].poses->nees6_frames, 0) << "it says nothing of z";
  const Counts other = counts(pose + "\nmap_origin_m: [0.2, 0.1, 0]\n");
  EXPECT_EQ(other[kBackground].poses, scored[kBackground].poses) << "whatever the lattice";
}

TEST_F(PoseScoreTest, AFilesPosesCountInSpace) {
  std::string text;
  for (int frame = 0; frame < recording().frame_count(); ++frame) {
    const Eigen::Vector3d p = recording().T_world_base_of_color(frame).translation();
    const Eigen::Quaterniond q(recording().T_world_base_of_color(frame).linear());
    text += fmt::format("{} {} {} {} {} {} {} {}", recording().color_stamp_s(frame), p.x(), p.y(),
                        p.z() + 0.3, q.x(), q.y(), q.z(), q.w());
    for (int cell = 0; cell < 36; ++cell) text += cell % 7 == 0 ? " 0.09" : " 0";
    text += '\n';
  }
  write_file(folder() / "poses.txt", text);
  const Counts scored = counts(fmt::format("localization: {{source: trajectory, trajectory: {}}}",
                                           (folder() / "poses.txt").string()));
  EXPECT_NEAR(figure(scored, "ate_m"), 0.3, 1e-9);
  EXPECT_NEAR(figure(scored, "ate_aligned_m"), 0.0, 1e-6);
  EXPECT_NEAR(figure(scored, "nees_mean"), 0.0, 1e-9);
  EXPECT_NEAR(figure(scored, "nees6_mean"), 1.0, 1e-9);
  EXPECT_EQ(figure(scored, "nees6_share"), 0.0) << "1 lies below the band of six";
}

TEST_F(PoseScoreTest, IsAsked) {
  for (const ClassCounts& c : counts("localization: {source: odometry}", Labels::detected, ""))
    EXPECT_FALSE(c.poses.has_value());
}

}  // namespace
}  // namespace mapscore::eval
