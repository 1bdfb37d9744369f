// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/pose_sources.hpp"

#include "core/localization/occupancy_grid.hpp"
#include "eval/lab/bench.hpp"
#include "eval/lab/map_frame.hpp"
#include "eval/lab/trial_run.hpp"
#include "eval/localization/believed_trajectory.hpp"
#include "eval/recording/grid_file.hpp"
#include "eval/truth/floor_grid.hpp"
#include "files/file_bytes.hpp"
#include "tests/eval/lab/driven_recording.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"
#include "tests/support/expect_error.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using testing::kLidarHeight_m;
using testing::kOdometryScale;
using testing::study_of;

/// The tiny recording with the logs of its drive: an odometry that makes every way too long, and
/// turns of a lidar against the crate and the wall.
class PoseSourcesTest : public ::testing::Test {
 protected:
  PoseSourcesTest() : recording_(written("driven", true)) {}

  [[nodiscard]] const Recording& recording() const { return recording_; }
  [[nodiscard]] Recording without_logs() const { return written("plain", false); }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

  [[nodiscard]] std::vector<PoseBelief> beliefs(const Recording& recording,
                                                const std::string& lines) const {
    PoseSources sources(recording);
    return sources.beliefs(task(lines), {0, 1, 2, 3});
  }
  [[nodiscard]] static Task task(const std::string& lines) {
    return plan_of(study_of(lines), "recording").tasks[0];
  }
  [[nodiscard]] Pose true_pose(int frame) const { return recording_.T_world_base_of_depth(frame); }

 private:
  [[nodiscard]] Recording written(const char* name, bool logs) const {
    testing::write_driven_recording(folder_.path() / name, logs);
    return Recording::open(folder_.path() / name);
  }

  mapscore::testing::TemporaryFolder folder_;
  Recording recording_;
};

constexpr const char* kMap = "map_origin_m: [0.01, 0.02, 0.03]\n";

std::string source(const std::string& name, const std::string& more = "") {
  return fmt::format("{}localization: {{source: {}{}}}\n", kMap, name, more);
}

Pose mean_of(const PoseBelief& belief) {
  return belief.T_map_odom * belief.T_odom_base;
}

Pose T_map_world() {
  Pose pose = Pose::Identity();
  pose.translation() = -Eigen::Vector3d(0.01, 0.02, 0.03);
  return pose;
}

TEST_F(PoseSourcesTest, TruthIsTheTruePoseWhateverTheDose) {
  const auto truth =
      beliefs(recording(), source("truth") + "faults: {pose: {sigma_xy_m: 0.1, sigma_yaw_deg: 5}}");
  ASSERT_EQ(truth.size(), 4U);
  for (int frame = 0; frame < 4; ++frame) {
    EXPECT_EQ(mean_of(truth[frame]).matrix(), (T_map_world() * true_pose(frame)).matrix());
    EXPECT_TRUE(truth[frame].covariance.isZero(0.0));
  }
}

TEST_F(PoseSourcesTest, OdometryDriftsFromTheTrueStart) {
  const auto believed = beliefs(recording(), source("odometry"));
  double last = -1.0;
  for (int frame = 0; frame < 4; ++frame) {
    Pose off = true_pose(0).inverse() * true_pose(frame);
    off.translation() *= kOdometryScale;
    EXPECT_TRUE(mean_of(believed[frame]).isApprox(T_map_world() * true_pose(0) * off, 1e-12));
    EXPECT_TRUE((believed[frame].T_odom_base.isApprox(off, 1e-12)));
    EXPECT_GT(believed[frame].covariance.trace(), last);
    last = believed[frame].covariance.trace();
  }
}

TEST_F(PoseSourcesTest, ParticleFilterFindsWhereOdometryIsOff) {
  const auto filter =
      beliefs(recording(), source("particle_filter",
                                  ", grid_resolution_m: 0.02, filter: {start_sigma_xy_m: 0, "
                                  "start_sigma_yaw_deg: 0, temper: 0.01}"));
  const auto odometry = beliefs(recording(), source("odometry"));
  const auto error_m = [&](const std::vector<PoseBelief>& believed) {
    return (mean_of(believed[3]).translation() - (T_map_world() * true_pose(3)).translation())
        .norm();
  };
  EXPECT_GT(error_m(odometry), 0.03);
  EXPECT_LT(error_m(filter), 0.5 * error_m(odometry));
  EXPECT_GT(filter[3].covariance(0, 0), 0.0);
}

TEST_F(PoseSourcesTest, AreTheSameForEveryMethodAndThread) {
  PoseSources sources(recording());
  const Task of_filter = task(source("particle_filter"));
  std::vector<std::vector<PoseBelief>> made(4);
  {
    std::vector<std::jthread> threads;
    for (auto& beliefs : made)
      threads.emplace_back([&] { beliefs = sources.beliefs(of_filter, {0, 1, 2, 3}); });
  }
  for (const auto& beliefs : made)
    for (int frame = 0; frame < 4; ++frame)
      EXPECT_EQ(mean_of(beliefs[frame]).matrix(), mean_of(made[0][frame]).matrix());
}

TEST_F(PoseSourcesTest, CountHowDepthImagesWereTracked) {
  PoseSources sources(recording());
  const Task visual = task(source("visual_odometry"));
  const TrialPoses poses = sources.poses(visual, {0, 1, 2, 3});
  ASSERT_TRUE(poses.tracking);
  EXPECT_EQ(*poses.tracking, TrackingCounts::of(visual_trajectory(recording(), visual)));
  EXPECT_EQ(poses.tracking->images(), recording().depth_count());
  EXPECT_EQ(poses.tracking->images_started, 1);
  EXPECT_EQ(sources.poses(visual, {0, 1, 2, 3}).tracking, poses.tracking) << "kept with the poses";
  for (const char* other : {"truth", "gaussian", "odometry", "particle_filter"})
    EXPECT_FALSE(sources.poses(task(source(other)), {0, 1, 2, 3}).tracking) << other;
}

TEST_F(PoseSourcesTest, TrackingStandsInTheAccountingOfATrialAndNotOfItsCeilings) {
  const Study study = study_of(source("visual_odometry"));
  const Plan plan = plan_of(study, recording().content_hash());
  const PlannedTrial trial = plan.trials[0];
  Bench bench(recording(), recording().info().table, false, std::size_t{1} << 24);
  const auto accounting = [&](std::size_t position) {
    const Task task = plan.tasks[position];
    const std::unique_ptr<TrialRun> run = bench.start(task);
    bench.run(*run);
    return run->finish().accounting;
  };
  ASSERT_TRUE(accounting(trial.task).tracking);
  EXPECT_EQ(accounting(trial.task).tracking->images(), recording().depth_count());
  EXPECT_FALSE(accounting(trial.registration_ceiling).tracking);
  EXPECT_FALSE(accounting(trial.lattice_ceiling).tracking);
}

TEST_F(PoseSourcesTest, ReportAScaledCovariance) {
  const auto plain = beliefs(recording(), source("odometry"));
  const auto scaled =
      beliefs(recording(), source("odometry") + "faults: {pose: {reported_scale: 4}}");
  EXPECT_EQ(scaled[3].covariance, 4.0 * plain[3].covariance);
}

TEST_F(PoseSourcesTest, ReadATrajectory) {
  const auto odometry = recording().read_odometry();
  BelievedTrajectory given = believed_trajectory(recording(), task(source("odometry")));
  write_file(folder() / "given.txt", believed_text(given));
  const auto read = beliefs(
      recording(),
      source("trajectory", fmt::format(", trajectory: {}", (folder() / "given.txt").string())));
  const auto straight = beliefs(recording(), source("odometry"));
  for (int frame = 0; frame < 4; ++frame) {
    EXPECT_TRUE(mean_of(read[frame]).isApprox(mean_of(straight[frame]), 1e-12));
    EXPECT_EQ(read[frame].covariance, straight[frame].covariance);
  }
}

TEST_F(PoseSourcesTest, UseAGivenGrid) {
  const OccupancyGrid grid = grid_of(recording(), task(source("particle_filter")).config);
  save_grid(grid, folder() / "grid.yaml");
  const auto given = beliefs(
      recording(),
      source("particle_filter", fmt::format(", grid: {}", (folder() / "grid.yaml").string())));
  const auto cut = beliefs(recording(), source("particle_filter"));
  for (int frame = 0; frame < 4; ++frame)
    EXPECT_EQ(mean_of(given[frame]).matrix(), mean_of(cut[frame]).matrix());
}

TEST_F(PoseSourcesTest, SayWhatIsMissing) {
  const Recording plain = without_logs();
  expect_error("odometry.txt, which", [&] { (void)beliefs(plain, source("odometry")); });
  expect_error("scan/scans.bin", [&] { (void)beliefs(plain, source("particle_filter")); });
  expect_error("localization.trajectory: is missing", [] { (void)task(source("trajectory")); });
  expect_error("nowhere.txt",
               [] { (void)task(source("trajectory", ", trajectory: /nowhere.txt")); });
  expect_error("most_particles: 10 is below least_particles", [] {
    (void)task(source("particle_filter", ", filter: {least_particles: 20, most_particles: 10}"));
  });
  expect_error("dropout_rate 2", [] {
    (void)task(source("particle_filter") + "faults: {lidar: {dropout_rate: 0.5, scale: 4}}");
  });
}

/// Equal poses have equal keys, different ones different keys.
TEST_F(PoseSourcesTest, DecideTheKeyOfATrial) {
  const auto key = [](const std::string& lines) { return task(lines).key; };
  EXPECT_EQ(key(source("truth")), key(kMap));
  EXPECT_EQ(key(source("truth") + "faults: {pose: {sigma_xy_m: 0.1}}"), key(kMap));
  EXPECT_EQ(key(source("truth", ", filter: {beams: 5}")), key(kMap));
  EXPECT_NE(key(source("odometry")), key(kMap));
  EXPECT_NE(key(source("odometry")), key(source("particle_filter")));
  EXPECT_EQ(key(source("odometry")),
            key(source("odometry") + "faults: {lidar: {preset: rplidar_a2}}"));
  EXPECT_NE(key(source("particle_filter")),
            key(source("particle_filter") + "faults: {lidar: {preset: rplidar_a2}}"));
  EXPECT_NE(key(source("particle_filter")),
            key(source("particle_filter", ", filter: {temper: 0.5}")));
  EXPECT_EQ(key(source("particle_filter")),
            key(source("particle_filter", ", grid_resolution_m: 0.02")));

  const std::string given =
      source("trajectory", fmt::format(", trajectory: {}", (folder() / "given.txt").string()));
  write_file(folder() / "given.txt", "0 0 0 0 0 0 0 1\n");
  const std::string before = key(given);
  write_file(folder() / "given.txt", "0 0.1 0 0 0 0 0 1\n");
  EXPECT_NE(key(given), before);
}

TEST_F(PoseSourcesTest, KeepTheLastSeedsAlone) {
  const auto seeds = static_cast<int>(PoseSources::kHeld) + 7;
  const Plan plan =
      plan_of(study_of(source("odometry") + fmt::format("seeds: {}\n", seeds)), "recording");
  PoseSources sources(recording());
  const auto end = [&](std::size_t trial) {
    const Task task = plan.tasks[plan.trials[trial].task];
    return sources.beliefs(task, {0, 1, 2, 3}).back().T_odom_base.matrix();
  };
  const Eigen::Matrix4d first = end(0);
  for (std::size_t trial = 1; trial < plan.trials.size(); ++trial) (void)end(trial);
  EXPECT_EQ(sources.held(), PoseSources::kHeld);
  EXPECT_EQ(end(0), first);
}

/// The registration ceiling has no fault, so its pose is the true one.
TEST_F(PoseSourcesTest, AreTrueInCeilings) {
  const Plan plan = plan_of(study_of(source("particle_filter")), "recording");
  const PlannedTrial trial = plan.trials[0];
  EXPECT_EQ(plan.tasks[trial.registration_ceiling].key, task(kMap).key);
  EXPECT_EQ(plan.tasks[trial.lattice_ceiling].config.localization, LocalizationSettings{});
}

}  // namespace
}  // namespace mapscore::eval
