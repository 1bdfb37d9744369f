// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/recorder/recorder.hpp"

#include "core/error.hpp"
#include "sim/recorder/recorded_drive.hpp"
#include "tests/sim/world/scene_files.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <mutex>

namespace mapscore::sim {
namespace {

double yaw_of(const Pose& pose) {
  return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0));
}

Drive corner() {
  Drive drive;
  drive.waypoints = {{0, 0, 0}, {1, 0, 0}, {1, 0, M_PI / 2}, {1, 2, M_PI / 2}};
  drive.speed_mps = 0.5;
  drive.turn_rate_radps = M_PI / 4;
  drive.frames_per_s = 1;
  return drive;
}

TEST(PosesAlong, TakeTheTimeOfTheSlowerOfWayAndTurn) {
  const auto poses = poses_along(corner());  // 2 s, 2 s, 4 s
  ASSERT_EQ(poses.size(), 9u);
  EXPECT_EQ(poses[1].stamp_s, 1.0);
  EXPECT_NEAR(poses[1].T_world_base.translation().x(), 0.5, 1e-12);
  EXPECT_NEAR(yaw_of(poses[3].T_world_base), M_PI / 4, 1e-12);
  EXPECT_NEAR(poses[3].T_world_base.translation().x(), 1.0, 1e-12);
  EXPECT_NEAR(poses[6].T_world_base.translation().y(), 1.0, 1e-12);
  EXPECT_NEAR(poses[8].T_world_base.translation().y(), 2.0, 1e-12);
}

TEST(PosesAlong, TurnTheShortWay) {
  Drive drive;
  drive.waypoints = {{0, 0, 3.0}, {0, 0, -3.0}};
  drive.turn_rate_radps = 2 * M_PI - 6;
  drive.frames_per_s = 2;
  const auto poses = poses_along(drive);
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_NEAR(std::abs(yaw_of(poses[1].T_world_base)), M_PI, 1e-9);
}

TEST(PosesAlong, OneWaypointIsOnePose) {
  Drive drive;
  drive.waypoints = {{1, 2, 0.5}};
  const auto poses = poses_along(drive);
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_EQ(poses[0].T_world_base.translation(), Eigen::Vector3d(1, 2, 0));
}

TEST(PosesAlong, WaypointsThatStandTwiceTakeNoTime) {
  Drive drive = corner();
  drive.waypoints.insert(drive.waypoints.begin() + 1, drive.waypoints[1]);
  drive.waypoints.push_back(drive.waypoints.back());
  const auto poses = poses_along(drive), plain = poses_along(corner());
  ASSERT_EQ(poses.size(), plain.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_TRUE(poses[i].T_world_base.isApprox(plain[i].T_world_base));
  }
}

TEST(PosesAlong, StopAtTheLimit) {
  Drive drive = corner();
  drive.max_frames = 4;
  EXPECT_EQ(poses_along(drive).size(), 4u);
}

TEST(PosesAlong, RefuseWhatCannotBeDriven) {
  Drive drive;
  EXPECT_THROW((void)poses_along(drive), Error);
  drive = corner();
  drive.speed_mps = 0;
  EXPECT_THROW((void)poses_along(drive), Error);
  drive = corner();
  drive.frames_per_s = NAN;
  EXPECT_THROW((void)poses_along(drive), Error);
  drive = corner();
  drive.waypoints[1].x_m = INFINITY;
  EXPECT_THROW((void)poses_along(drive), Error);
}

class RecordTest : public ::testing::Test {
 protected:
  World world =
      World::load({testing::data_file("shapes_room.xml"), {}, testing::data_file("robot.xml")},
                  {160, 120, 0.6, 8.0});
  std::vector<StampedPose> poses = poses_along(corner());

  std::map<int, Frame> frames(int jobs, std::vector<int>* progress = nullptr) {
    std::map<int, Frame> result, depth;
    std::mutex mutex;
    const auto add_color = [&](const Frame& frame) {
      const std::scoped_lock lock(mutex);
      EXPECT_TRUE(result.emplace(frame.index, frame).second);
    };
    const auto add_depth = [&](const Frame& frame) {
      const std::scoped_lock lock(mutex);
      EXPECT_TRUE(depth.emplace(frame.depth_index, frame).second);
    };
    record(world, {poses, poses}, {jobs, false}, {add_color, add_depth}, [&](int done, int total) {
      EXPECT_EQ(total, 2 * static_cast<int>(poses.size()));
      if (progress) progress->push_back(done);
    });
    EXPECT_EQ(result.size(), depth.size());
    for (auto& [index, frame] : result) {
      const Frame& other = depth.at(index);
      EXPECT_EQ(frame.stamp_s, other.stamp_s);
      EXPECT_TRUE(frame.T_world_base.matrix() == other.T_world_base.matrix());
      frame.depth = other.depth;
      frame.depth_label = other.depth_label;
    }
    return result;
  }
};

TEST_F(RecordTest, GivesTheSameFramesForAnyNumberOfJobs) {
  std::vector<int> progress;
  const auto one = frames(1), three = frames(3, &progress);
  ASSERT_EQ(one.size(), poses.size());
  ASSERT_EQ(three.size(), poses.size());
  for (const auto& [index, frame] : one) {
    EXPECT_EQ(frame.stamp_s, poses[index].stamp_s);
    EXPECT_TRUE(frame.T_world_base.matrix() == poses[index].T_world_base.matrix());
    EXPECT_EQ(cv::norm(frame.color, three.at(index).color, cv::NORM_L1), 0);
    EXPECT_EQ(cv::norm(frame.label, three.at(index).label, cv::NORM_L1), 0);
    EXPECT_EQ(cv::norm(frame.depth, three.at(index).depth, cv::NORM_L1), 0);
    EXPECT_EQ(cv::norm(frame.depth_label, three.at(index).depth_label, cv::NORM_L1), 0);
  }
  for (std::size_t i = 0; i < progress.size(); ++i) EXPECT_EQ(progress[i], static_cast<int>(i) + 1);
  EXPECT_EQ(progress.size(), 2 * poses.size());
}

TEST_F(RecordTest, RethrowsTheFirstExceptionAndStops) {
  std::atomic<int> calls = 0;
  const auto sink = [&](const Frame&) {
    ++calls;
    throw Error("disk full");
  };
  EXPECT_THROW(record(world, {poses, poses}, {2, false}, {sink, sink}), Error);
  EXPECT_LE(calls, 2);
  EXPECT_THROW(record(world, {poses, poses}, {0, false}, {sink, sink}), Error);
}

TEST_F(RecordTest, TakesNoPoses) {
  poses.clear();
  EXPECT_TRUE(frames(2).empty());
}

}  // namespace
}  // namespace mapscore::sim
