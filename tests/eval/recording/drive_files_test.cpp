// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/recording/scan_file.hpp"
#include "eval/recording/stamp_list.hpp"
#include "files/file_bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <limits>

namespace mapscore::eval {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class DriveFiles : public ::testing::Test {
 protected:
  ~DriveFiles() override { std::filesystem::remove(file_); }

  std::string refusal(const std::string& bytes) {
    write_file(file_, bytes);
    try {
      (void)read_scan_log(file_);
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(file_.string()), Not(HasSubstr("\n"))));
      return error.what();
    }
    return "read";
  }

  std::filesystem::path file_ = std::filesystem::temp_directory_path() /
                                ("mapscore_drive_file_" + std::to_string(::getpid()));
};

ScanLog two_turns() {
  ScanLog log;
  log.geometry = {-M_PI, 2 * M_PI / 3, 0.15, 12.0, planar_pose(0.095, 0.0, 0.1)};
  log.scans = {{0.0, {1.5f, 0.0f, std::numeric_limits<float>::infinity()}},
               {0.1, {1.25f, 0.3f, 11.9f}}};
  return log;
}

TEST_F(DriveFiles, RangesComeBackBitForBit) {
  const ScanLog log = two_turns();
  write_file(file_, scan_log_bytes(log));
  const ScanLog back = read_scan_log(file_);
  ASSERT_EQ(back.scans.size(), 2u);
  EXPECT_EQ(back.scans[1].ranges_m, log.scans[1].ranges_m);
  EXPECT_EQ(back.scans[0].ranges_m, log.scans[0].ranges_m);
  EXPECT_EQ(back.scans[1].stamp_s, 0.1);
  EXPECT_EQ(back.geometry.angle_step_rad, log.geometry.angle_step_rad);
  EXPECT_TRUE(back.geometry.T_base_lidar.isApprox(log.geometry.T_base_lidar, 1e-15));
}

TEST_F(DriveFiles, EveryTruncationIsRefused) {
  const std::string bytes = scan_log_bytes(two_turns());
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_NE(refusal(bytes.substr(0, length)), "read") << length;
  EXPECT_THAT(refusal(bytes + "x"), HasSubstr("not as its header says (2 turns of 3 beams)"));
}

TEST_F(DriveFiles, ScansThatCannotBeAreRefused) {
  std::string bytes = scan_log_bytes(two_turns());
  bytes[6] = '2';
  EXPECT_THAT(refusal(bytes), HasSubstr("no scan file of format 1"));
  ScanLog log = two_turns();
  log.scans[1].stamp_s = 0.0;
  EXPECT_THAT(refusal(scan_log_bytes(log)), HasSubstr("stamp 0 of turn 1"));
  log = two_turns();
  log.scans[1].ranges_m[2] = NAN;
  EXPECT_THAT(refusal(scan_log_bytes(log)), HasSubstr("turn 1 holds the range nan"));
  log = two_turns();
  log.scans[0].ranges_m[1] = -1.0f;
  EXPECT_THAT(refusal(scan_log_bytes(log)), HasSubstr("turn 0 holds the range -1"));
  log = two_turns();
  log.geometry.range_max_m = 0.1;
  EXPECT_THAT(refusal(scan_log_bytes(log)), HasSubstr("range 0.15 to 0.1 m is none"));
  log = two_turns();
  log.scans[1].ranges_m.pop_back();
  EXPECT_THROW((void)scan_log_bytes(log), Error);
  log.scans.clear();
  EXPECT_THAT(refusal(scan_log_bytes(log)), HasSubstr("holds no scans"));
}

TEST_F(DriveFiles, OdometryComesBack) {
  const std::vector<OdometryPose> poses = {{0.0, Pose::Identity()},
                                           {0.02, planar_pose(0.1, -0.2, 0.7)}};
  write_file(file_, odometry_text(poses));
  EXPECT_THAT(odometry_text(poses), HasSubstr("# T_odom_base_footprint"));
  const std::vector<OdometryPose> back = read_odometry(file_);
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[0].T_odom_base.matrix(), Pose::Identity().matrix());
  EXPECT_TRUE(back[1].T_odom_base.isApprox(poses[1].T_odom_base, 1e-15));
  EXPECT_EQ(back[1].stamp_s, 0.02);
}

}  // namespace
}  // namespace mapscore::eval
