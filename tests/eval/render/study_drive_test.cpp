// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#ifdef MAPSCORE_SIMULATOR

#include "eval/render/study_drive.hpp"

#include "core/error.hpp"
#include "eval/render/study_recording.hpp"
#include "files/file_bytes.hpp"
#include "sim/recorder/recorded_drive.hpp"
#include "sim/robot/drive_simulation.hpp"
#include "sim/sensors/lidar.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// A room of 5 m x 4 m with a crate that slides along a wall.
const char* const kRoom =
    "<mujoco><worldbody>"
    "<body name='floor_1'><geom type='box' pos='0 0 -.05' size='2.6 2.1 .05'/></body>"
    "<body name='wall_1'><geom type='box' pos='2.55 0 1' size='.05 2 1'/></body>"
    "<body name='wall_2'><geom type='box' pos='-2.55 0 1' size='.05 2 1'/></body>"
    "<body name='wall_3'><geom type='box' pos='0 2.05 1' size='2.6 .05 1'/></body>"
    "<body name='wall_4'><geom type='box' pos='0 -2.05 1' size='2.6 .05 1'/></body>"
    "<body name='crate_1' pos='2.2 -1.5 .3'><joint name='slide' type='slide' axis='0 1 0'/>"
    "<geom type='box' size='.2 .3 .3'/></body>"
    "</worldbody></mujoco>";

class WheelDrive : public ::testing::Test {
 protected:
  WheelDrive() {
    fs::copy_file(fs::path(MAPSCORE_SOURCE_DIR) / "scenes/robot.xml", folder() / "robot.xml");
    write_file(folder() / "room.xml", kRoom);
    write_file(folder() / "slide.csv", "stamp_s,slide\n0,0\n6,2.6\n8,2.6\n");
  }

  [[nodiscard]] const fs::path& folder() const { return temporary_.path(); }
  [[nodiscard]] Study study(const std::string& more = "",
                            const std::vector<std::string>& flags = {}) const {
    return parse_study(
        "scene: room.xml\n"
        "trajectory: {waypoints_m_deg: [[-1.5, -1, 0], [0.5, -0.8, 90], [0.3, 0.9, 180]], "
        "frames_per_s: 3, depth_frames_per_s: 5, drive: {wheels: {}}}\n"
        "cameras: {width_px: 64, height_px: 48}\n"
        "methods: {direct: {segmentation: {direct: {}}}}\n" +
            more,
        folder() / "study.yaml", flags);
  }
  [[nodiscard]] Recording recorded(const std::string& name, const Study& of, int jobs = 2) const {
    record_study(of, folder() / name, jobs, {});
    return Recording::open(folder() / name);
  }
  /// The drive by itself, as the study should ask for it.
  [[nodiscard]] sim::DriveLog simulated(const Study& of, double until_s = 0.0) const {
    sim::Drive drive;
    for (const auto& [x, y, yaw_deg] : of.trajectory.waypoints_m_deg)
      drive.waypoints.push_back({x, y, yaw_deg * M_PI / 180});
    drive.turn_rate_radps = of.trajectory.turn_rate_dps * M_PI / 180;
    drive.until_s = until_s;
    sim::DriveSettings settings;
    settings.controller.turn_acceleration_radps2 = 85 * M_PI / 180;
    return sim::simulate_drive(world_of(of), folder() / "robot.xml", drive, settings);
  }

 private:
  mapscore::testing::TemporaryFolder temporary_;
};

TEST_F(WheelDrive, ImagesLookFromTheSimulatedPosesAndOdometryDrifts) {
  const Study of = study();
  const sim::DriveLog log = simulated(of);
  const Recording recording = recorded("drive", of);
  EXPECT_EQ(recording.frame_count(), static_cast<int>(log.end_s * 3) + 1);
  for (int i = 0; i < recording.frame_count(); ++i)
    EXPECT_TRUE(recording.T_world_base_of_color(i).isApprox(sim::pose_at(log, i / 3.0), 1e-12));
  ASSERT_GT(recording.depth_count(), recording.frame_count());
  for (int i = 0; i < recording.depth_count(); ++i) {
    EXPECT_EQ(recording.depth_stamp_s(i), i / 5.0);
    EXPECT_TRUE(recording.T_world_base_of_depth(i).isApprox(sim::pose_at(log, i / 5.0), 1e-12));
  }
  const std::vector<OdometryPose> odometry = recording.read_odometry();
  EXPECT_EQ(odometry.front().stamp_s, 0.0);
  EXPECT_EQ(odometry.front().T_odom_base.matrix(), Pose::Identity().matrix());
  ASSERT_GE(odometry.back().stamp_s, log.end_s);
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    EXPECT_EQ(odometry[i].stamp_s, static_cast<double>(i) / 50.0);
    EXPECT_TRUE(odometry[i].T_odom_base.isApprox(log.samples[i].T_odom_base, 1e-12));
    EXPECT_TRUE(recording.T_world_base_at(odometry[i].stamp_s)
                    ->isApprox(log.samples[i].T_world_base, 1e-12));
  }
  const Pose T_world_odom = *recording.T_world_base_at(0.0);
  const Pose drift = (T_world_odom * odometry.back().T_odom_base).inverse() *
                     *recording.T_world_base_at(odometry.back().stamp_s);
  EXPECT_GT(drift.translation().norm(), 0.001);
  EXPECT_LT(drift.translation().norm(), 0.2);
  // the base's pose is the true one, with its tilt
  EXPECT_GT(std::abs(T_world_odom.linear()(2, 0)) + std::abs(T_world_odom.linear()(2, 1)), 1e-7);
}

TEST_F(WheelDrive, ScansAreThoseOfTheLidarAtThosePoses) {
  const Study of = study("lidar: {scans_per_s: 4, beams: 90, range_min_m: 0.3, range_max_m: 3}\n");
  const sim::DriveLog log = simulated(of);
  const ScanLog scans = recorded("drive", of).read_scans();
  sim::LidarSettings settings;
  settings.beams = 90;
  settings.range_min_m = 0.3;
  settings.range_max_m = 3;
  const sim::Lidar lidar(world_of(of), settings);
  EXPECT_EQ(scans.geometry.range_max_m, 3);
  EXPECT_EQ(scans.geometry.angle_step_rad, lidar.angle_step_rad());
  EXPECT_TRUE(scans.geometry.T_base_lidar.isApprox(lidar.T_base_lidar(), 1e-12));
  ASSERT_EQ(scans.scans.size(), static_cast<std::size_t>(log.end_s * 4) + 1);
  int beyond = 0;
  for (std::size_t i = 0; i < scans.scans.size(); ++i) {
    const double stamp_s = static_cast<double>(i) / 4.0;
    EXPECT_EQ(scans.scans[i].stamp_s, stamp_s);
    EXPECT_EQ(scans.scans[i].ranges_m, lidar.scans({{stamp_s, sim::pose_at(log, stamp_s)}}, 1)[0]);
    for (const float range_m : scans.scans[i].ranges_m) beyond += std::isinf(range_m);
  }
  EXPECT_GT(beyond, 0);
}

TEST_F(WheelDrive, HasTheSameBytesForAnyNumberOfJobsAndEachTime) {
  const Recording one = recorded("one", study(), 1);
  const Recording two = recorded("two", study(), 2);
  const Recording again = recorded("again", study(), 2);
  EXPECT_EQ(one.content_hash(), two.content_hash());
  EXPECT_EQ(one.content_hash(), again.content_hash());
  for (const char* file : {"odometry.txt", "scan/scans.bin", "groundtruth.txt"})
    EXPECT_EQ(read_file(one.folder() / file), read_file(two.folder() / file)) << file;
}

TEST_F(WheelDrive, ScansFollowTheSceneThatMovesAndLastUntilItStands) {
  const Study still = study("lidar: {scans_per_s: 2}\n");
  Study moving = still;
  moving.motion = "slide.csv";
  const sim::World world = world_of(moving);
  const sim::DriveLog log = simulated(moving, 100.0);
  const StudyDrive drive = drive_of(moving, world);
  const ScanLog scans = scans_of(moving, world, drive.scans, 2);
  const ScanLog standing = scans_of(still, world_of(still), drive.scans, 2);
  EXPECT_EQ(scans.scans.front().ranges_m, standing.scans.front().ranges_m);
  int different = 0;
  for (std::size_t i = 0; i < scans.scans.size(); ++i) {
    const double stamp_s = scans.scans[i].stamp_s;
    // rays against the world as a renderer would load it at that instant: move the crate by hand
    const std::string y = std::to_string(-1.5 + 2.6 * std::min(1.0, stamp_s / 6.0));
    std::string posed = kRoom;
    posed.replace(posed.find("2.2 -1.5 .3"), 11, "2.2 " + y + " .3");
    write_file(folder() / "posed.xml", posed);
    Study by_hand = still;
    by_hand.scene = "posed.xml";
    const sim::LidarRanges expected =
        sim::Lidar(world_of(by_hand)).scans({{stamp_s, sim::pose_at(log, stamp_s)}}, 1)[0];
    for (std::size_t beam = 0; beam < expected.size(); ++beam)
      ASSERT_NEAR(scans.scans[i].ranges_m[beam], expected[beam], 2e-5) << i << ' ' << beam;
    different += scans.scans[i].ranges_m != standing.scans[i].ranges_m;
  }
  EXPECT_GT(different, 5);
  Study longer = moving;
  write_file(folder() / "long.csv", "stamp_s,slide\n0,0\n60,2\n");
  longer.motion = "long.csv";
  const StudyDrive until = drive_of(longer, world_of(longer));
  EXPECT_EQ(until.scans.back().stamp_s, 60.0);
  EXPECT_EQ(until.streams.color.back().stamp_s, 60.0);
  EXPECT_GE(until.odometry.back().stamp_s, 60.0);
  const Pose rest = until.odometry[2000].T_odom_base.inverse() * until.odometry.back().T_odom_base;
  EXPECT_LT(rest.translation().norm(), 1e-3);  // it stands
}

TEST_F(WheelDrive, EndsWithItsLastFrame) {
  const StudyDrive drive = drive_of(study("", {"trajectory.max_frames=7"}), world_of(study()));
  EXPECT_EQ(drive.streams.color.size(), 7u);
  EXPECT_EQ(drive.streams.depth.back().stamp_s, 2.0);
  EXPECT_EQ(drive.scans.back().stamp_s, 2.0);
  EXPECT_EQ(drive.odometry.back().stamp_s, 2.0);
}

TEST_F(WheelDrive, TellsTheWaypointsThatItReached) {
  std::vector<std::pair<int, int>> told;
  (void)drive_of(study(), world_of(study()),
                 [&](int reached, int waypoints) { told.emplace_back(reached, waypoints); });
  EXPECT_EQ(told, (std::vector<std::pair<int, int>>{{1, 3}, {2, 3}, {3, 3}}));
}

TEST_F(WheelDrive, BelievedWheelsScaleTheOdometryAlone) {
  const StudyDrive right = drive_of(study(), world_of(study()));
  const Study wrong_study = study("", {"trajectory.drive.wheels.wheel_radius_error_percent=2",
                                       "trajectory.drive.wheels.track_error_percent=2"});
  const StudyDrive wrong = drive_of(wrong_study, world_of(wrong_study));
  // a wheel and a track too great by the same share: the same turns, longer ways
  const Eigen::Vector3d a = right.odometry.back().T_odom_base.translation();
  const Eigen::Vector3d b = wrong.odometry.back().T_odom_base.translation();
  EXPECT_TRUE(b.isApprox(1.02 * a, 1e-9));
  EXPECT_EQ(right.streams.color.back().T_world_base.matrix(),
            wrong.streams.color.back().T_world_base.matrix());
}

TEST_F(WheelDrive, AlongPosesThereIsNeitherOdometryNorScans) {
  const Recording recording = recorded("poses", study("", {"trajectory.drive=poses"}));
  EXPECT_FALSE(recording.has_odometry());
  EXPECT_FALSE(recording.has_scans());
  EXPECT_FALSE(fs::exists(recording.folder() / "scan"));
  EXPECT_THAT(read_file(recording.folder() / "recording.yaml"),
              ::testing::Not(::testing::HasSubstr("_count: 0")));
}

TEST_F(WheelDrive, TheLidarNamesARecordingOfWheelsAlone) {
  const std::vector<std::string> coarse{"trajectory.max_frames=2", "lidar.beams=90"};
  const std::vector<std::string> fine{"trajectory.max_frames=2"};
  const auto name = [&](const char* drive, std::vector<std::string> flags) {
    flags.insert(flags.begin(), std::string("trajectory.drive=") + drive);
    return recording_of(study("", flags), folder() / "results", 1, {}).folder();
  };
  EXPECT_EQ(name("poses", coarse), name("poses", fine));
  EXPECT_NE(name("wheels", coarse), name("wheels", fine));
  EXPECT_EQ(name("wheels", fine), name("wheels", fine));
  EXPECT_NE(name("wheels", fine), name("poses", fine));
}

TEST_F(WheelDrive, KeysOfStudiesAlongPosesStay) {
  const Study poses = study("", {"trajectory.drive=poses"});
  EXPECT_THAT(to_key_yaml(poses), ::testing::Not(::testing::HasSubstr("drive")));
  EXPECT_THAT(to_key_yaml(poses), ::testing::Not(::testing::HasSubstr("lidar")));
  EXPECT_THAT(to_key_yaml(study()), ::testing::HasSubstr("drive:\n    wheels:\n      accel"));
  EXPECT_THAT(to_key_yaml(study("lidar: {beams: 90}\n")), ::testing::HasSubstr("beams: 90"));
  EXPECT_EQ(parse_study(to_yaml(study()), folder() / "study.yaml"), study());
  EXPECT_EQ(study("", {"trajectory.drive=wheels"}), study());
  EXPECT_TRUE(decides_recording("trajectory.drive.wheels.clearance_m"));
  EXPECT_TRUE(decides_recording("lidar.beams"));
}

}  // namespace
}  // namespace mapscore::eval

#endif
