// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/localization/believed_trajectory.hpp"

#include "core/error.hpp"
#include "eval/localization/localization_run.hpp"
#include "files/file_bytes.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/mutations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

namespace mapscore::eval {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<OdometryPose> straight() {
  return {{1.0, Pose::Identity()}, {1.5, planar_pose(1.0, 0, 0)}, {2.0, planar_pose(2.0, 0, 0.4)}};
}

TEST(BelievedTrajectory, MovesWithTheOdometryFromTheLatestEntry) {
  BelievedTrajectory believed{{}, straight()};
  const Covariance6 small = 0.01 * Covariance6::Identity(), large = 4.0 * small;
  believed.entries = {{1.0, {planar_pose(5, 0, 0), Pose::Identity(), small}},
                      {1.7, {planar_pose(7, 1, 0), Pose::Identity(), large}}};
  const PoseBelief before = believed.at(1.6999), after = believed.at(1.7);
  EXPECT_NEAR(before.T_odom_base.translation().x(), 1.3998, 1e-12);
  EXPECT_NEAR(planar(after.T_odom_base).yaw_rad, 0.16, 1e-12);
  EXPECT_EQ(before.T_map_odom.translation().x(), 5.0);
  EXPECT_EQ(after.T_map_odom.translation().x(), 7.0);
  EXPECT_EQ(before.covariance, small);
  EXPECT_EQ(after.covariance, large);
  EXPECT_EQ(believed.at(1.5).T_odom_base.matrix(), believed.odometry[1].T_odom_base.matrix());
}

TEST(BelievedTrajectory, ReachesOneSpacingBeyondItsEnds) {
  const BelievedTrajectory believed{{{1.0, {}}}, straight()};
  EXPECT_EQ(believed.at(0.5).T_odom_base.translation().x(), 0.0);
  EXPECT_EQ(believed.at(2.5).T_odom_base.translation().x(), 2.0);
  EXPECT_THROW((void)believed.at(0.4999), Error);
  EXPECT_THROW((void)believed.at(2.5001), Error);
  EXPECT_THROW((void)believed.at(NAN), Error);
  EXPECT_THROW((void)odometry_at({}, 0.0), Error);
  mapscore::testing::expect_error("odometry.txt: reaches from 1 to 2 s",
                                  [&] { (void)believed.at(0.4); });
}

TEST(OdometryRun, KeepsItsStartAndGrowsUncertain) {
  std::vector<OdometryPose> odometry;
  for (int n = 0; n <= 160; ++n) odometry.push_back({0.05 * n, planar_pose(0.03 * n, 0, 0)});
  OdometryNoise noise;
  noise.alpha1 = noise.alpha4 = 0.0;
  noise.alpha2 = 0.01;
  noise.alpha3 = 0.04;
  const PlanarPose start{2.0, 3.0, M_PI / 2};
  const BelievedTrajectory believed = odometry_only(odometry, start, noise);
  const PoseEstimate end = planar_estimate(believed.at(8.0));
  EXPECT_NEAR(end.mean.x_m, 2.0, 1e-12);
  EXPECT_NEAR(end.mean.y_m, 7.8, 1e-12);
  // 80 independent steps of 6 cm, the first length of 5 cm or more: variances add; those of rot1
  // and rot2 to the heading.
  EXPECT_NEAR(end.covariance(0, 0), 80 * 0.04 * 0.06 * 0.06, 1e-9);
  EXPECT_NEAR(end.covariance(2, 2), 80 * 2 * 0.01 * 0.06 * 0.06, 1e-9);
  // Each turn swings the rest of the way: sum over steps of (rest of the way)^2.
  double swing = 0.0;
  for (int k = 1; k <= 80; ++k)
    swing += 0.01 * 0.06 * 0.06 * 0.06 * 0.06 * ((k - 1) * (k - 1) + k * k);
  EXPECT_NEAR(end.covariance(1, 1), swing, 1e-9);
  EXPECT_EQ(planar_estimate(believed.at(0.0)).covariance, Eigen::Matrix3d::Zero());
}

class BelievedFile : public ::testing::Test {
 protected:
  ~BelievedFile() override { std::filesystem::remove(file_); }

  BelievedTrajectory read(const std::string& text) {
    write_file(file_, text);
    return read_believed(file_);
  }
  std::string refusal(const std::string& text) {
    try {
      (void)read(text);
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(file_.string()), Not(HasSubstr("\n"))));
      return error.what();
    }
    return "read";
  }

  std::filesystem::path file_ = std::filesystem::temp_directory_path() /
                                ("mapscore_believed_file_" + std::to_string(::getpid()));
};

BelievedTrajectory three_entries() {
  BelievedTrajectory believed;
  for (int n = 0; n < 3; ++n) {
    Covariance6 root = Covariance6::Zero();
    root(0, 0) = 0.1 / 3.0;
    root(1, 0) = -0.007 * n;
    root(1, 1) = 0.02;
    root(5, 1) = 1e-3 / 7.0;
    root(5, 5) = 0.01;
    const double stamp_s = 0.1 * n;
    believed.odometry.push_back({stamp_s, planar_pose(0.3 * n, 0.1, 0.2 * n)});
    believed.entries.push_back({stamp_s,
                                {planar_pose(1.0, 2.0, 0.7), believed.odometry.back().T_odom_base,
                                 root * root.transpose()}});
  }
  return believed;
}

TEST_F(BelievedFile, ComesBack) {
  const BelievedTrajectory believed = three_entries();
  const BelievedTrajectory back = read(believed_text(believed));
  ASSERT_EQ(back.entries.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n) {
    const PoseBelief &was = believed.entries[n].belief, is = back.at(believed.entries[n].stamp_s);
    EXPECT_EQ(back.entries[n].stamp_s, believed.entries[n].stamp_s);
    EXPECT_EQ(is.covariance, was.covariance);
    EXPECT_EQ(is.T_map_odom.matrix(), Pose::Identity().matrix());
    EXPECT_TRUE(is.T_odom_base.isApprox(was.T_map_odom * was.T_odom_base, 1e-14));
  }
  EXPECT_EQ(read(believed_text(back)).entries[2].belief.covariance,
            back.entries[2].belief.covariance);
}

TEST_F(BelievedFile, MoreThanHalfAMillionPosesAreRefused) {
  std::string text;
  for (int n = 0; n <= 500'000; ++n) text += std::to_string(n) + " 0 0 0 0 0 0 1\n";
  EXPECT_THAT(refusal(text), HasSubstr(":500001: more than 500000 poses; leave some out"));
}

TEST_F(BelievedFile, TrajectoryOfEightColumnsIsBelievedExactly) {
  const BelievedTrajectory back = read("# x\n0 1 2 0 0 0 0 1\n\n1 3 2 0 0 0 0 1\n");
  const PoseBelief middle = back.at(0.25);
  EXPECT_NEAR((middle.T_map_odom * middle.T_odom_base).translation().x(), 1.5, 1e-15);
  EXPECT_EQ(middle.covariance, Covariance6::Zero());
}

TEST_F(BelievedFile, RefusesWithLineAndMend) {
  const std::string first = "0 1 2 0 0 0 0 1\n";
  EXPECT_THAT(refusal(first + "0 1 2 0 0 0 0 1\n"), HasSubstr(":2: stamp 0 does not come after 0"));
  EXPECT_THAT(refusal(first + "1 1 2 0 0 0 0 1.1\n"), HasSubstr(":2: quaternion"));
  EXPECT_THAT(refusal(first + "1 1 2 0 0 0 nan 1\n"), HasSubstr(":2: 'nan' is not a finite"));
  EXPECT_THAT(refusal("0 1 2 0 0 0 0\n"), HasSubstr(":1: expected 'stamp_s"));
  EXPECT_THAT(refusal("# nothing\n"), HasSubstr("no lines; give one pose or more"));
  const std::string text = believed_text(three_entries());
  EXPECT_THAT(refusal(text + "9 1 2 0 0 0 0 1\n"), HasSubstr(":5: 8 columns after lines of 44"));
  std::string numbers = " 1 0.5";  // not symmetric
  for (int n = 2; n < 36; ++n) numbers += n % 7 == 0 ? " 1" : " 0";
  EXPECT_THAT(refusal("0 1 2 0 0 0 0 1" + numbers), HasSubstr(":1: covariance: must be finite"));
  numbers = " -1";
  for (int n = 1; n < 36; ++n) numbers += n % 7 == 0 ? " 1" : " 0";
  EXPECT_THAT(refusal("0 1 2 0 0 0 0 1" + numbers), HasSubstr("positive semi-definite"));
}

TEST_F(BelievedFile, DamageIsReadOrRefused) {
  const auto tally = testing::read_mutations(believed_text(three_entries()), 600,
                                             [&](const std::string& bytes) { (void)read(bytes); });
  EXPECT_GT(tally.refused, 300);
}

}  // namespace
}  // namespace mapscore::eval
