// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/visual_odometry.hpp"

#include "core/error.hpp"
#include "tests/core/odometry/flat_depth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace mapscore {
namespace {

using testing::BoxFlat;
using testing::furnished_room;

VisualOdometryParams with_loops() {
  VisualOdometryParams params;
  params.loops = LoopClosure{};
  return params;
}

/// A circle of 1 m in the room's middle, looking outwards ahead; `share` of it.
PlanarPose on_circle(double share) {
  const double angle = 2.0 * std::numbers::pi * share;
  return {3.0 + std::cos(angle), 2.5 + std::sin(angle),
          wrapped_angle(angle + std::numbers::pi / 2)};
}

struct Drive {
  int frames = 120;
  double turns = 1.1;
  double noise = 0.0;
  /// What the wheels measure of the true motion.
  std::function<PlanarPose(const PlanarPose&)> wheels = [](const PlanarPose& T) { return T; };
  bool use_wheels = true;
  std::function<cv::Mat1w(int, cv::Mat1w)> camera = [](int, cv::Mat1w depth) { return depth; };
  std::function<double(double)> share = [](double at) { return at; };
};

struct Driven {
  std::vector<OdometryStep> steps;
  std::vector<PlanarPose> truth, wheels;
  std::size_t loops = 0;
  std::vector<CorrectedPose> corrected;

  [[nodiscard]] double error_m(std::size_t n) const {
    const PlanarPose off = inverse(truth[n]) * planar(steps[n].T_map_base);
    return std::hypot(off.x_m, off.y_m);
  }
  [[nodiscard]] double sigma_m(std::size_t n) const {
    return std::sqrt(steps[n].covariance.topLeftCorner<2, 2>().trace());
  }
  [[nodiscard]] long count(Tracking tracking) const {
    return std::ranges::count(steps, tracking, &OdometryStep::tracking);
  }
};

Driven driven(const BoxFlat& flat, const Drive& drive, const VisualOdometryParams& params = {}) {
  const Calibration camera = testing::odometry_camera();
  Driven result;
  const auto at = [&](int n) {
    return on_circle(drive.share(drive.turns * n / (drive.frames - 1)));
  };
  VisualOdometry visual(params, camera, spatial(at(0)));
  PlanarPose T_odom_base;
  for (int n = 0; n < drive.frames; ++n) {
    result.truth.push_back(at(n));
    if (n > 0) T_odom_base = T_odom_base * drive.wheels(inverse(at(n - 1)) * at(n));
    result.wheels.push_back(at(0) * T_odom_base);
    OdometryFrame frame{
        0.1 * n,
        drive.camera(n, testing::flat_depth(flat, spatial(at(n)), camera, drive.noise,
                                            static_cast<std::uint64_t>(n))),
        {}};
    if (drive.use_wheels) frame.T_odom_base = spatial(T_odom_base);
    result.steps.push_back(visual.add(frame));
  }
  result.loops = visual.loops();
  result.corrected = visual.corrected();
  return result;
}

PlanarPose scrubbing(const PlanarPose& T) {
  return {0.98 * T.x_m, T.y_m, 1.05 * T.yaw_rad};
}

TEST(VisualOdometry, HoldsTheWayWhereTheWheelsLoseIt) {
  const Driven run = driven(furnished_room(), {.noise = 0.5, .wheels = scrubbing});
  const std::size_t last = run.steps.size() - 1;
  const PlanarPose wheels_off = inverse(run.truth[last]) * run.wheels[last];
  EXPECT_GT(std::hypot(wheels_off.x_m, wheels_off.y_m), 0.2);
  for (std::size_t n = 0; n < run.steps.size(); ++n) EXPECT_LT(run.error_m(n), 0.04) << n;
  EXPECT_EQ(run.count(Tracking::lost), 0);
}

TEST(VisualOdometry, SameInputSameBytes) {
  const Drive drive{.frames = 40, .turns = 0.3, .noise = 0.5, .wheels = scrubbing};
  const VisualOdometryParams slam = with_loops();
  const Driven a = driven(furnished_room(), drive, slam), b = driven(furnished_room(), drive, slam);
  for (std::size_t n = 0; n < a.steps.size(); ++n) {
    EXPECT_EQ(a.steps[n].T_map_base.matrix(), b.steps[n].T_map_base.matrix());
    EXPECT_EQ(a.steps[n].covariance, b.steps[n].covariance);
  }
}

TEST(VisualOdometry, InTheDarkTheWheelsCarryAndUncertaintyGrows) {
  const auto dark = [](int n, cv::Mat1w depth) {
    return n >= 20 && n < 35 ? cv::Mat1w::zeros(depth.size()) : depth;
  };
  const auto wheels = [](const PlanarPose& T) {
    return PlanarPose{0.99 * T.x_m, T.y_m, 1.02 * T.yaw_rad};
  };
  const Driven run =
      driven(furnished_room(), {.frames = 60, .turns = 0.5, .wheels = wheels, .camera = dark});
  EXPECT_EQ(run.count(Tracking::blind), 15);
  for (std::size_t n = 20; n < 34; ++n) EXPECT_GT(run.sigma_m(n + 1), run.sigma_m(n)) << n;
  EXPECT_LT(run.error_m(59), 3.0 * run.sigma_m(59));
}

TEST(VisualOdometry, BlindFromTheStartTheWheelsCarryAndUncertaintyGrows) {
  const auto dark = [](int n, cv::Mat1w depth) {
    return n < 15 ? cv::Mat1w::zeros(depth.size()) : depth;
  };
  const auto wheels = [](const PlanarPose& T) {
    return PlanarPose{0.99 * T.x_m, T.y_m, 1.02 * T.yaw_rad};
  };
  const Driven run =
      driven(furnished_room(), {.frames = 60, .turns = 0.5, .wheels = wheels, .camera = dark});
  EXPECT_EQ(run.count(Tracking::blind), 15);
  for (std::size_t n = 0; n < 14; ++n) EXPECT_GT(run.sigma_m(n + 1), run.sigma_m(n)) << n;
  for (std::size_t n = 0; n < 60; ++n) EXPECT_LT(run.error_m(n), 3.0 * run.sigma_m(n) + 0.01) << n;
  EXPECT_GT(run.sigma_m(59), 0.5 * run.sigma_m(14));  // nothing told it since where it began
  for (std::size_t n = 0; n < 60; ++n)
    EXPECT_TRUE(run.corrected[n].T_map_base.isApprox(run.steps[n].T_map_base, 1e-9)) << n;
}

TEST(VisualOdometry, WheelsThatJumpByMetresAreNotBelieved) {
  const Calibration camera = testing::odometry_camera();
  const Pose pose = planar_pose(2.0, 1.5, 0.2);
  VisualOdometry visual({}, camera, pose);
  OdometryStep step;
  for (int n = 0; n < 20; ++n) {
    step = visual.add({0.1 * n, testing::flat_depth(furnished_room(), pose, camera),
                       planar_pose(n < 10 ? 0.0 : 5.0, 0.0, 0.0)});
    EXPECT_EQ(step.tracking == Tracking::slipped, n == 10) << n;
  }
  EXPECT_LT((step.T_map_base.translation() - pose.translation()).norm(), 0.02);
}

TEST(VisualOdometry, ATwistThatTheWheelsDoNotFeelIsSeen) {
  // As on a rug's edge: in one frame the base turns further than planes can be matched from.
  const Calibration camera = testing::odometry_camera();
  const auto at = [](int n) {
    return planar_pose(2.0, 1.5, n < 10 ? 0.2 : 0.2 + 6.0 * std::numbers::pi / 180.0);
  };
  VisualOdometry visual({}, camera, at(0));
  std::vector<OdometryStep> steps;
  for (int n = 0; n < 14; ++n)
    steps.push_back(visual.add(
        {0.1 * n, testing::flat_depth(furnished_room(), at(n), camera), Pose::Identity()}));
  EXPECT_EQ(steps[10].tracking, Tracking::slipped);
  const Pose off = steps.back().T_map_base.inverse() * at(13);
  EXPECT_LT(off.translation().norm(), 0.02);
  EXPECT_LT(Eigen::AngleAxisd(off.linear()).angle(), 0.5 * std::numbers::pi / 180.0);
}

TEST(VisualOdometry, AKidnappedRobotSaysSo) {
  // Carried across the room in one frame; the wheels did not turn.
  const Drive drive{
      .frames = 50,
      .turns = 0.4,
      .wheels =
          [](const PlanarPose& T) { return std::hypot(T.x_m, T.y_m) > 0.5 ? PlanarPose{} : T; },
      .share = [](double at) { return at < 0.2 ? at : at + 0.35; }};
  const Driven run = driven(furnished_room(), drive);
  EXPECT_GT(run.count(Tracking::lost) + run.count(Tracking::beside), 0);
  const std::size_t carried = 25;
  ASSERT_GT(run.error_m(carried), 0.3);
  double most_sigma_m = 0.0;
  for (std::size_t n = carried; n < run.steps.size(); ++n)
    most_sigma_m = std::max(most_sigma_m, run.sigma_m(n));
  EXPECT_GT(most_sigma_m, 0.4);
}

TEST(VisualOdometry, AlongABareWallItBelievesTheWheelsAndSaysHowLittle) {
  const BoxFlat hall(3.0, 200.0);
  const Calibration camera = testing::odometry_camera();
  VisualOdometry visual({}, camera, planar_pose(1.5, 100.0, 0.0));
  std::vector<OdometryStep> steps;
  for (int n = 0; n < 30; ++n) {
    // Sideways, as no wheels drive; the odometry says 2 % too much.
    const Pose pose = planar_pose(1.5, 100.0 + 0.06 * n, 0.0);
    steps.push_back(visual.add({0.1 * n, testing::flat_depth(hall, pose, camera),
                                planar_pose(0.0, 1.02 * 0.06 * n, 0.0)}));
  }
  const double off_m = steps.back().T_map_base.translation().y() - 100.0 - 0.06 * 29;
  EXPECT_NEAR(off_m, 0.02 * 0.06 * 29, 0.01);  // what the wheels are off by
  EXPECT_GT(std::sqrt(steps.back().covariance(1, 1)), 3.0 * std::sqrt(steps[3].covariance(1, 1)));
  EXPECT_LT(std::sqrt(steps.back().covariance(0, 0)), 0.01);
}

TEST(VisualOdometry, WithoutWheelsItGoesOnAsItWent) {
  const Driven run = driven(furnished_room(), {.frames = 120, .turns = 0.5, .use_wheels = false});
  for (std::size_t n = 0; n < run.steps.size(); ++n) EXPECT_LT(run.error_m(n), 0.08) << n;
}

TEST(VisualOdometry, ALoopBringsTheDriftBack) {
  const Drive drive{.frames = 160, .turns = 1.3, .noise = 0.5, .wheels = scrubbing};
  const Driven run = driven(furnished_room(), drive, with_loops());
  EXPECT_GT(run.loops, 0U);
  ASSERT_EQ(run.corrected.size(), run.steps.size());
  EXPECT_LT(run.error_m(run.steps.size() - 1), 0.04);
}

TEST(VisualOdometry, OneFrameIsThePoseThatWasGiven) {
  const Calibration camera = testing::odometry_camera();
  const Pose start = planar_pose(1.0, 2.0, 0.3);
  VisualOdometry visual({}, camera, start);
  const OdometryStep step =
      visual.add({0.0, testing::flat_depth(furnished_room(), start, camera), {}});
  EXPECT_EQ(step.T_map_base.matrix(), start.matrix());
  EXPECT_EQ(step.tracking, Tracking::started);
}

TEST(VisualOdometry, RefusesStampsOutOfOrderAndImagesOfAnotherSize) {
  const Calibration camera = testing::odometry_camera();
  VisualOdometry visual({}, camera, Pose::Identity());
  const cv::Mat1w depth(camera.depth.height_px, camera.depth.width_px, std::uint16_t{10000});
  static_cast<void>(visual.add({1.0, depth, {}}));
  EXPECT_THROW(static_cast<void>(visual.add({1.0, depth, {}})), Error);
  EXPECT_THROW(static_cast<void>(visual.add({2.0, cv::Mat1w(3, 3), {}})), Error);
}

}  // namespace
}  // namespace mapscore
