// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/particle_filter.hpp"

#include "core/error.hpp"
#include "core/localization/nees.hpp"
#include "polygon_home.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace mapscore {
namespace {

using testing::DrivenFrame;
using testing::PolygonHome;

std::shared_ptr<const ScanModel> field_of(const OccupancyGrid& grid) {
  return std::make_shared<const ScanModel>(LikelihoodField(grid, {}, 12.0));
}

std::shared_ptr<const ScanModel> beams_in(const OccupancyGrid& grid) {
  return std::make_shared<const ScanModel>(BeamModel(grid, {}, 12.0));
}

std::vector<DrivenFrame> drive_of(const PolygonHome& home, std::uint64_t seed) {
  return drive(home, ParticleFilterParams{}.noise, 0.06, 0.1, seed);
}

/// The first frames of that drive alone: the scans of a whole drive take as long as many filters.
std::vector<DrivenFrame> begin_of_drive(PolygonHome home, std::uint64_t seed, std::size_t count) {
  home.waypoints.resize(4);
  std::vector<DrivenFrame> frames = drive_of(home, seed);
  EXPECT_GE(frames.size(), count);
  frames.resize(count);
  return frames;
}

/// Off by 5 cm and 3 degrees, and knows that it may be.
PoseEstimate rough_start(const PlanarPose& T_map_base) {
  PoseEstimate start;
  start.mean = T_map_base * PlanarPose{0.05, -0.05, 0.05};
  start.covariance = Eigen::Vector3d(0.0025, 0.0025, 0.0025).asDiagonal();
  return start;
}

/// How far off a filter is over a drive, from a frame on.
struct Quality {
  double position_m = 0.0, heading_rad = 0.0;
  double in_band = 0.0, too_sure = 0.0;  ///< shares of the frames, by their NEES
};

Quality quality_of(ParticleFilter& filter, const std::vector<DrivenFrame>& frames,
                   std::size_t first) {
  Quality quality;
  const double share = 1.0 / static_cast<double>(frames.size() - first);
  for (std::size_t n = 0; n < frames.size(); ++n) {
    filter.step(frames[n].T_odom_base, frames[n].scan);
    if (n < first) continue;
    const PlanarPose error = inverse(frames[n].T_map_base) * filter.estimate().mean;
    const double squared = nees(filter.estimate(), frames[n].T_map_base);
    quality.position_m += share * std::hypot(error.x_m, error.y_m);
    quality.heading_rad += share * std::abs(error.yaw_rad);
    if (squared >= kNeesBand.low && squared <= kNeesBand.high) quality.in_band += share;
    if (squared > kNeesBand.high) quality.too_sure += share;
  }
  return quality;
}

void expect_found(const Quality& quality, const std::string& what) {
  EXPECT_LT(quality.position_m, 0.05) << what;
  EXPECT_LT(quality.heading_rad, 2.0 * std::numbers::pi / 180.0) << what;
}

void expect_good(const Quality& quality, const std::string& what) {
  expect_found(quality, what);
  EXPECT_GE(quality.in_band, 0.85) << what;
}

// Where walls cross the lattice their offsets within the cells average out: a filter that allows
// for walls along it (map_covariance) is then too modest, but not too sure.
void expect_modest(const Quality& quality, const std::string& what) {
  expect_found(quality, what);
  EXPECT_GE(quality.in_band, 0.6) << what;
  EXPECT_LT(quality.too_sure, 0.025) << what;
}

TEST(ParticleFilter, TracksThroughBothHomesHonestly) {
  for (const bool slanted : {false, true})
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const PolygonHome home = slanted ? testing::slanted_home() : testing::straight_home();
      const std::vector<DrivenFrame> frames = drive_of(home, seed);
      ParticleFilter filter(field_of(grid_of(home)), {}, seed);
      filter.start_at(rough_start(frames.front().T_map_base));
      (slanted ? expect_modest : expect_good)(quality_of(filter, frames, 10),
                                              "seed " + std::to_string(seed));
    }
}

TEST(ParticleFilter, TracksWithTheBeamModelToo) {
  for (const PolygonHome& home : {testing::straight_home(), testing::slanted_home()}) {
    const std::vector<DrivenFrame> frames = begin_of_drive(home, 3, 100);
    ParticleFilter filter(beams_in(grid_of(home)), {}, 3);
    filter.start_at(rough_start(frames.front().T_map_base));
    expect_good(quality_of(filter, frames, 10), "beam model");
  }
}

TEST(ParticleFilter, FindsItselfFromAnywhere) {
  for (const bool slanted : {false, true})
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
      const PolygonHome home = slanted ? testing::slanted_home() : testing::straight_home();
      const std::vector<DrivenFrame> frames = drive_of(home, seed);
      const OccupancyGrid grid = grid_of(home);
      ParticleFilter filter(field_of(grid), {}, seed);
      filter.start_anywhere(grid);
      EXPECT_EQ(filter.particles().size(), KldParams{}.max_particles);
      (slanted ? expect_modest : expect_good)(quality_of(filter, frames, 50),
                                              "seed " + std::to_string(seed));
      EXPECT_LE(filter.particles().size(), 2 * KldParams{}.min_particles);
    }
}

TEST(ParticleFilter, NoScanMakesItSurerThanTheCellsAre) {
  const PolygonHome home = testing::straight_home();
  const std::vector<DrivenFrame> frames = begin_of_drive(home, 0, 1);
  ParticleFilter filter(field_of(grid_of(home)), {}, 0);
  filter.start_at({frames.front().T_map_base, Eigen::Matrix3d::Zero()});
  filter.step(frames.front().T_odom_base, frames.front().scan);
  const double cell_m = home.frame.resolution_m;
  EXPECT_NEAR(filter.estimate().covariance(0, 0), cell_m * cell_m / 48.0, 1e-9);
  EXPECT_NEAR(filter.estimate().covariance(1, 1), cell_m * cell_m / 48.0, 1e-9);
  EXPECT_LT(filter.estimate().covariance(2, 2), 1e-12);
}

TEST(ParticleFilter, OdometryAloneWouldDrift) {
  const std::vector<DrivenFrame> frames = drive_of(testing::straight_home(), 2);
  const PlanarPose believed =
      frames.front().T_map_base * inverse(frames.front().T_odom_base) * frames.back().T_odom_base;
  const PlanarPose error = inverse(frames.back().T_map_base) * believed;
  EXPECT_GT(std::hypot(error.x_m, error.y_m), 0.5);
}

TEST(ParticleFilter, SameBytesForAnyNumberOfThreads) {
  const PolygonHome home = testing::slanted_home();
  const std::vector<DrivenFrame> frames = begin_of_drive(home, 1, 12);
  const OccupancyGrid grid = grid_of(home);
  ParticleFilterParams params;
  ParticleFilter alone(field_of(grid), params, 9);
  params.jobs = 3;
  ParticleFilter threads(field_of(grid), params, 9), other(field_of(grid), params, 10);
  for (ParticleFilter* filter : {&alone, &threads, &other}) filter->start_anywhere(grid);
  for (const DrivenFrame& frame : frames)
    for (ParticleFilter* filter : {&alone, &threads, &other})
      filter->step(frame.T_odom_base, frame.scan);
  EXPECT_EQ(alone.estimate().mean, threads.estimate().mean);
  EXPECT_EQ(alone.estimate().covariance, threads.estimate().covariance);
  ASSERT_EQ(alone.particles().size(), threads.particles().size());
  for (std::size_t n = 0; n < alone.particles().size(); ++n)
    ASSERT_EQ(alone.particles()[n], threads.particles()[n]);
  EXPECT_NE(alone.estimate().mean, other.estimate().mean);
}

TEST(ParticleFilter, StandingRobotLearnsNothingNew) {
  const PolygonHome home = testing::straight_home();
  const DrivenFrame frame = begin_of_drive(home, 1, 1).front();
  ParticleFilter filter(field_of(grid_of(home)), {}, 1);
  filter.start_at(rough_start(frame.T_map_base));
  EXPECT_TRUE(filter.step(frame.T_odom_base, frame.scan));
  const PoseEstimate first = filter.estimate();
  for (int n = 0; n < 20; ++n) EXPECT_FALSE(filter.step(frame.T_odom_base, frame.scan));
  EXPECT_EQ(filter.estimate().mean, first.mean * PlanarPose{});
  EXPECT_TRUE(filter.estimate().covariance.isApprox(first.covariance, 1e-12));
}

TEST(ParticleFilter, BetweenUpdatesTheEstimateMovesAndItsErrorGrows) {
  const PolygonHome home = testing::straight_home();
  const DrivenFrame frame = begin_of_drive(home, 1, 1).front();
  ParticleFilter filter(field_of(grid_of(home)), {}, 1);
  filter.start_at(rough_start(frame.T_map_base));
  filter.step(frame.T_odom_base, frame.scan);
  const PoseEstimate before = filter.estimate();
  const PlanarPose motion{0.03, 0.0, 0.02};
  EXPECT_FALSE(filter.step(frame.T_odom_base * motion, frame.scan));
  const PlanarPose moved = before.mean * motion;
  EXPECT_NEAR(filter.estimate().mean.x_m, moved.x_m, 1e-12);
  EXPECT_NEAR(filter.estimate().mean.y_m, moved.y_m, 1e-12);
  EXPECT_GT(filter.estimate().covariance.determinant(), before.covariance.determinant());
}

TEST(ParticleFilter, BeliefIsTheEstimateByWayOfOdometry) {
  const PolygonHome home = testing::slanted_home();
  const std::vector<DrivenFrame> frames = begin_of_drive(home, 1, 9);
  ParticleFilter filter(field_of(grid_of(home)), {}, 1);
  filter.start_at(rough_start(frames[0].T_map_base));
  for (int n = 0; n < 9; ++n) filter.step(frames[n].T_odom_base, frames[n].scan);
  const PoseBelief belief = filter.belief();
  EXPECT_TRUE((belief.T_map_odom * belief.T_odom_base).isApprox(spatial(filter.estimate().mean)));
  EXPECT_TRUE(belief.T_odom_base.isApprox(spatial(frames[8].T_odom_base)));
  EXPECT_EQ(belief.covariance(0, 5), filter.estimate().covariance(0, 2));
  EXPECT_EQ(belief.covariance(5, 5), filter.estimate().covariance(2, 2));
  EXPECT_TRUE((belief.covariance.block<3, 6>(2, 0).isZero(0.0)));
  EXPECT_NO_THROW(static_cast<void>(covariance_root(belief.covariance)));
}

TEST(PoseEstimate, MeanIsCircularAndCovarianceInTheRobotsAxes) {
  const double left = 0.5 * std::numbers::pi;
  const std::vector<PlanarPose> ahead = {{1, 1.9, left}, {1, 2.1, left}};  // along its x axis
  const std::vector<double> half = {0.5, 0.5};
  const PoseEstimate along = estimate_of(ahead, half);
  EXPECT_NEAR(along.covariance(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(along.covariance(1, 1), 0.0, 1e-12);
  const double back = std::numbers::pi;
  const std::vector<PlanarPose> turned = {{0, 0, back - 0.1}, {0, 0, 0.1 - back}};
  const PoseEstimate around = estimate_of(turned, half);
  EXPECT_NEAR(std::abs(around.mean.yaw_rad), back, 1e-12);
  EXPECT_NEAR(around.covariance(2, 2), 0.01, 1e-12);
}

TEST(PoseEstimate, NeesOfHonestEstimatesLiesInTheBand) {
  RandomStream stream(8, "nees");
  PoseEstimate estimate;
  estimate.mean = {3, -2, 2.5};
  estimate.covariance = Eigen::Vector3d(0.04, 0.01, 0.0025).asDiagonal();
  int low = 0, high = 0;
  constexpr int kDraws = 40000;
  for (int n = 0; n < kDraws; ++n) {
    Vector6 xi = Vector6::Zero();
    xi[0] = 0.2 * stream.normal();
    xi[1] = 0.1 * stream.normal();
    xi[5] = 0.05 * stream.normal();
    const double squared = nees(estimate, estimate.mean * planar(exp_pose(xi)));
    low += squared < kNeesBand.low;
    high += squared > kNeesBand.high;
  }
  EXPECT_NEAR(low, 0.025 * kDraws, 100);
  EXPECT_NEAR(high, 0.025 * kDraws, 100);
}

TEST(ParticleFilter, RefusesWhatItCannotUse) {
  const PolygonHome home = testing::straight_home();
  const OccupancyGrid grid = grid_of(home);
  ParticleFilterParams params;
  params.kld.max_particles = 10;
  EXPECT_THROW(ParticleFilter(field_of(grid), params, 1), Error);
  params = {};
  params.noise.alpha3 = -1.0;
  EXPECT_THROW(ParticleFilter(field_of(grid), params, 1), Error);
  ParticleFilter filter(field_of(grid), {}, 1);
  EXPECT_THROW(filter.step({}, {}), Error);  // not started
  EXPECT_THROW(filter.start_anywhere(OccupancyGrid({0.1, {}, 3, 3})), Error);
  filter.start_at({});
  EXPECT_THROW(filter.step({NAN, 0, 0}, {}), Error);
  LaserScan scan;
  scan.range_max_m = -1.0;
  EXPECT_THROW(filter.step({}, scan), Error);
}

}  // namespace
}  // namespace mapscore
