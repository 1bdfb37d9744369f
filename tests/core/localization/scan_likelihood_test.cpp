// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/scan_likelihood.hpp"

#include "core/error.hpp"
#include "polygon_home.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace mapscore {
namespace {

using testing::PolygonHome;

constexpr float kNothing = std::numeric_limits<float>::infinity();

/// The likelihood field by its definition: no table, nearest occupied cell by search.
double plain_field(const OccupancyGrid& grid, const LikelihoodFieldParams& params,
                   const LaserScan& scan, const PlanarPose& T_map_base) {
  double sum = 0.0;
  for (const Beam& beam : beams_of(scan, params.beams)) {
    if (!beam.hit) continue;
    const Eigen::Vector2d p_map = T_map_base * scan.T_base_lidar *
                                  Eigen::Vector2d(beam.range_m * std::cos(beam.angle_rad),
                                                  beam.range_m * std::sin(beam.angle_rad));
    const GridCell end = grid.cell_of(p_map);
    double least = std::numeric_limits<double>::infinity();
    for (GridCell cell; cell.row < grid.frame().height; ++cell.row)
      for (cell.column = 0; cell.column < grid.frame().width; ++cell.column)
        if (grid.at(cell) == kOccupiedCell)
          least = std::min(least, std::hypot(cell.column - end.column, cell.row - end.row));
    double p = params.z_rand / scan.range_max_m;
    const double sigmas = least * grid.frame().resolution_m / params.sigma_hit_m;
    if (grid.contains(end))
      p += params.z_hit * std::exp(-0.5 * sigmas * sigmas) /
           (params.sigma_hit_m * std::sqrt(2.0 * std::numbers::pi));
    sum += std::log(p);
  }
  return params.temper * sum;
}

TEST(LaserScan, SpreadsBeamsAndSortsOutRanges) {
  LaserScan scan;
  scan.angle_step_rad = 0.1;
  scan.range_min_m = 0.2;
  scan.range_max_m = 5.0;
  scan.ranges_m = {1.0f, 0.1f, NAN, kNothing, 5.0f, 2.0f, 0.2f, -1.0f};
  const std::vector<Beam> all = beams_of(scan, 100);
  ASSERT_EQ(all.size(), 5u);
  EXPECT_TRUE(all[0].hit);
  EXPECT_FALSE(all[1].hit);
  EXPECT_EQ(all[1].range_m, 5.0);
  EXPECT_FALSE(all[2].hit);
  EXPECT_DOUBLE_EQ(all[3].angle_rad, 0.5);
  EXPECT_DOUBLE_EQ(all[4].range_m, 0.2f);
  const std::vector<Beam> half = beams_of(scan, 4);  // beams 0 2 4 6, of which 2 is no number
  ASSERT_EQ(half.size(), 3u);
  EXPECT_DOUBLE_EQ(half[1].angle_rad, 0.4);
}

TEST(LaserScan, RefusesUselessNumbers) {
  LaserScan scan;
  scan.range_max_m = 0.0;
  EXPECT_THROW(static_cast<void>(beams_of(scan, 1)), Error);
  scan = {};
  scan.angle_step_rad = NAN;
  EXPECT_THROW(static_cast<void>(beams_of(scan, 1)), Error);
}

TEST(LikelihoodField, EqualsItsDefinition) {
  PolygonHome home = testing::slanted_home();
  home.frame = {0.25, {-2.0, -7.0, 0.6}, 40, 40};  // coarse, and the home reaches beyond it
  const OccupancyGrid grid = grid_of(home);
  LikelihoodFieldParams params;
  params.beams = 90;
  params.sigma_hit_m = 0.3;
  params.temper = 0.5;
  const LikelihoodField field(grid, params, 12.0);
  RandomStream stream(5, "field");
  const LaserScan scan = scan_in(home, {-2.0, -2.0, 0.4}, stream);
  std::vector<PlanarPose> poses;
  for (int n = 0; n < 20; ++n)
    poses.push_back({6 * stream.uniform() - 3, 6 * stream.uniform() - 3, stream.normal()});
  poses.push_back({1e6, -1e6, 1.0});
  std::vector<double> results(poses.size());
  field.log_likelihoods(scan, poses, results);
  for (std::size_t n = 0; n < poses.size(); ++n)
    EXPECT_NEAR(results[n], plain_field(grid, params, scan, poses[n]), 1e-3 * std::abs(results[n]));
}

TEST(LikelihoodField, SilentBeamsSayNothing) {
  const OccupancyGrid grid = grid_of(testing::straight_home());
  const LikelihoodField field(grid, {}, 12.0);
  LaserScan scan;
  scan.ranges_m.assign(360, kNothing);
  const std::array<PlanarPose, 2> poses = {PlanarPose{2, 1, 0}, PlanarPose{8, 6, 1}};
  std::array<double, 2> results{};
  field.log_likelihoods(scan, poses, results);
  EXPECT_EQ(results[0], 0.0);
  EXPECT_EQ(results[1], 0.0);
}

/// Both models prefer the true pose to those around it.
template <class Model, class Params>
void expect_peak_at_truth(const PolygonHome& home) {
  const OccupancyGrid grid = grid_of(home);
  const Model model(grid, Params{}, 12.0);
  const PlanarPose truth{home.waypoints[0].x(), home.waypoints[0].y(), 0.7};
  RandomStream stream(6, "peak");
  const LaserScan scan = scan_in(home, truth, stream);
  std::vector<PlanarPose> poses = {truth};
  for (int n = 0; n < 8; ++n) {
    const double angle = n * 0.25 * std::numbers::pi;
    poses.push_back(truth * PlanarPose{0.15 * std::cos(angle), 0.15 * std::sin(angle), 0.0});
  }
  poses.push_back(truth * PlanarPose{0, 0, 0.1});
  poses.push_back(truth * PlanarPose{0, 0, -0.1});
  std::vector<double> results(poses.size());
  model.log_likelihoods(scan, poses, results);
  for (std::size_t n = 1; n < poses.size(); ++n) EXPECT_LT(results[n], results[0]) << "pose " << n;
}

TEST(LikelihoodField, PeaksAtTheTruth) {
  expect_peak_at_truth<LikelihoodField, LikelihoodFieldParams>(testing::straight_home());
  expect_peak_at_truth<LikelihoodField, LikelihoodFieldParams>(testing::slanted_home());
}

TEST(BeamModel, PeaksAtTheTruth) {
  expect_peak_at_truth<BeamModel, BeamModelParams>(testing::straight_home());
  expect_peak_at_truth<BeamModel, BeamModelParams>(testing::slanted_home());
}

TEST(BeamModel, IsADensity) {
  const OccupancyGrid grid({0.1, {}, 1, 1}, kFreeCell);
  const BeamModel model(grid, {}, 8.0);
  for (const double expected : {0.1, 1.0, 4.0, 7.95}) {
    double mass = model.probability(8.0, false, expected);
    constexpr int kSteps = 80000;
    for (int n = 0; n < kSteps; ++n)
      mass += model.probability((n + 0.5) * 8.0 / kSteps, true, expected) * 8.0 / kSteps;
    EXPECT_NEAR(mass, 1.0, 1e-3) << "expected range " << expected;
  }
  EXPECT_GT(model.probability(8.0, false, 8.0), 0.8);  // silence where silence is expected
}

TEST(ScanModels, RefuseUselessParameters) {
  const OccupancyGrid grid({0.1, {}, 1, 1}, kFreeCell);
  const auto field = [&](LikelihoodFieldParams params) { LikelihoodField(grid, params, 12.0); };
  EXPECT_NO_THROW(field({}));
  EXPECT_THROW(field({0, 0.05, 0.9, 0.1, 0.02}), Error);
  EXPECT_THROW(field({360, 0.0, 0.9, 0.1, 0.02}), Error);
  EXPECT_THROW(field({360, 0.05, 0.9, 0.2, 0.02}), Error);
  EXPECT_THROW(field({360, 0.05, 1.0, 0.0, 0.02}), Error);
  EXPECT_THROW(field({360, 0.05, 0.9, 0.1, NAN}), Error);
  EXPECT_THROW(BeamModel(grid, {60, 0.05, -1.0}, 12.0), Error);
  EXPECT_THROW(BeamModel(grid, {60, 0.05, 1.0, 0.85, 0.05, 0.0, 0.1}, 12.0), Error);
}

}  // namespace
}  // namespace mapscore
