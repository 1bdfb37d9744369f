// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/sampling.hpp"

#include "eval/results/plan.hpp"
#include "eval/study/grid.hpp"
#include "tests/support/expect_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kShift = "faults.misregistration.magnitude_m";
constexpr const char* kRadius = "methods.erosion.segmentation.erosion.radius_px";

Study sampled_study(const std::string& lines) {
  return parse_study(
      "recording: somewhere\n"
      "methods: {erosion: {segmentation: {erosion: {radius_px: 5}}}}\n" +
          lines,
      "demo.yaml");
}

Study three_paths(const std::string& sampling) {
  return sampled_study("sweep:\n  " + std::string(kShift) + ": [0.01, 0.05]\n  " + kRadius +
                       ": [2, 5]\n  localization.source: [truth, gaussian]\nsampling: " + sampling +
                       "\n");
}

std::vector<double> values_of(const Study& study, std::size_t path) {
  std::vector<double> values;
  for (const Cell& cell : cells(study)) values.push_back(std::stod(cell.doses.at(path).second));
  return values;
}

/// In which of `parts` equal parts of [0, 1) the points lie, how often.
std::map<int, int> parts_met(const std::vector<std::vector<double>>& points, std::size_t axis,
                             int parts) {
  std::map<int, int> met;
  for (const auto& point : points) ++met[static_cast<int>(point[axis] * parts)];
  return met;
}

std::map<int, int> each_once(int parts) {
  std::map<int, int> met;
  for (int part = 0; part < parts; ++part) met[part] = 1;
  return met;
}

TEST(LatinHypercubePoints, EachPartOfEachAxisHoldsOne) {
  for (const int points : {1, 2, 37, 1000}) {
    const auto drawn = unit_points(LatinHypercube{points}, 5, 3);
    ASSERT_EQ(drawn.size(), static_cast<std::size_t>(points));
    for (std::size_t axis = 0; axis < 5; ++axis)
      EXPECT_EQ(parts_met(drawn, axis, points), each_once(points));
  }
}

TEST(LatinHypercubePoints, AreOfTheSeedAndTheirAxesDiffer) {
  const auto points = unit_points(LatinHypercube{20}, 2, 3);
  EXPECT_EQ(points, unit_points(LatinHypercube{20}, 2, 3));
  EXPECT_NE(points, unit_points(LatinHypercube{20}, 2, 4));
  EXPECT_TRUE(std::ranges::any_of(points, [](const auto& p) {
    return static_cast<int>(p[0] * 20) != static_cast<int>(p[1] * 20);
  }));
}

// The first points of Joe and Kuo's program sobol.cc with new-joe-kuo-6.21201, in three dimensions.
TEST(SobolPoints, ArePublishedOnes) {
  EXPECT_THAT(
      unit_points(Sobol{10}, 3, 1),
      ElementsAre(ElementsAre(0, 0, 0), ElementsAre(0.5, 0.5, 0.5), ElementsAre(0.75, 0.25, 0.25),
                  ElementsAre(0.25, 0.75, 0.75), ElementsAre(0.375, 0.375, 0.625),
                  ElementsAre(0.875, 0.875, 0.125), ElementsAre(0.625, 0.125, 0.875),
                  ElementsAre(0.125, 0.625, 0.375), ElementsAre(0.1875, 0.3125, 0.9375),
                  ElementsAre(0.6875, 0.8125, 0.4375)));
}

TEST(SobolPoints, APowerOfTwoFillsAllPartsOnceAndMorePointsKeepTheEarlier) {
  const auto points = unit_points(Sobol{128}, 20, 1);
  for (std::size_t axis = 0; axis < 20; ++axis)
    EXPECT_EQ(parts_met(points, axis, 128), each_once(128));
  const auto fewer = unit_points(Sobol{50}, 20, 9);
  EXPECT_TRUE(std::equal(fewer.begin(), fewer.end(), points.begin()));
  mapscore::testing::expect_error("1001 swept paths", [] { (void)unit_points(Sobol{2}, 1001, 1); });
}

// 0.01 + 0.04 u; 2 to 5 by quarters of u; truth below 0.5.
TEST(Sampling, MapsNumbersWholeNumbersAndNames) {
  std::vector<std::string> texts;
  for (const Cell& cell : cells(three_paths("{sobol: {points: 5}}"))) {
    EXPECT_EQ(cell.index, static_cast<int>(texts.size()));
    EXPECT_EQ(cell.doses[0].first, kShift);
    texts.push_back(cell.doses[0].second + ' ' + cell.doses[1].second + ' ' + cell.doses[2].second);
  }
  EXPECT_THAT(texts, ElementsAre("0.01 2 truth", "0.03 4 gaussian", "0.04 3 truth",
                                 "0.02 5 gaussian", "0.025 3 gaussian"));
}

TEST(Sampling, RangesKeepTheirPartsAndEnds) {
  const Study study = three_paths("{latin_hypercube: {points: 400}}");
  std::vector<double> shifts = values_of(study, 0);
  ASSERT_EQ(shifts.size(), 400u);
  std::ranges::sort(shifts);
  for (std::size_t n = 0; n < shifts.size(); ++n)  // but for the rounding to 1e-7
    EXPECT_NEAR(shifts[n], 0.01 + 0.0001 * (static_cast<double>(n) + 0.5), 0.00005 + 1e-7);
  std::map<double, int> radii;
  for (const double radius : values_of(study, 1)) ++radii[radius];
  EXPECT_EQ(radii, (std::map<double, int>{{2, 100}, {3, 100}, {4, 100}, {5, 100}}));
}

TEST(Sampling, PointsThatFallTogetherStandOnce) {
  const auto grid = cells(sampled_study(std::string("sweep: {") + kRadius +
                                        ": [2, 4]}\nsampling: {sobol: {points: 64}}\n"));
  std::set<std::string> radii;
  for (const Cell& cell : grid) radii.insert(cell.doses[0].second);
  EXPECT_EQ(grid.size(), 3u);
  EXPECT_EQ(radii, (std::set<std::string>{"2", "3", "4"}));
}

TEST(Sampling, IsKeptInTheFileAndDrawnByTheSeed) {
  const Study study = three_paths("latin_hypercube");
  EXPECT_EQ(points_of(study.sampling), 64);
  EXPECT_EQ(parse_study(to_yaml(study), "demo.yaml"), study);
  EXPECT_EQ(cells(parse_study(to_yaml(study), "demo.yaml")), cells(study));
  Study other = study;
  other.seed = 2;
  EXPECT_NE(cells(other), cells(study));
}

// A trial is its values, wherever they came from.
TEST(Sampling, APointHasTheKeyOfTheSameCellOfAGrid) {
  const Study study = three_paths("{sobol: {points: 2}}");
  const Study grid = sampled_study("sweep:\n  " + std::string(kShift) + ": [0.03]\n  " + kRadius +
                                   ": [4]\n  localization.source: [gaussian]\n");
  const Plan points = plan_of(study, "recording"), cell = plan_of(grid, "recording");
  EXPECT_EQ(points.tasks.key(points.trials[1].task), cell.tasks.key(cell.trials[0].task));
  EXPECT_EQ(points.tasks.key(points.trials[0].lattice_ceiling),
            cell.tasks.key(cell.trials[0].lattice_ceiling));
}

struct BadSampling {
  const char* lines;
  const char* message;
};

TEST(Sampling, RefusesWhatHasNoRange) {
  for (const auto& [lines, message] : std::vector<BadSampling>{
           {"sampling: sobol\n", "demo.yaml:3: sampling: stands without a sweep"},
           {"sweep: {voxel_m: [0.1, 0.05]}\nsampling: sobol\n",
            "demo.yaml:3: sweep.voxel_m: 0.1 is not below 0.05; write a range, [LOW, HIGH]"},
           {"sweep: {voxel_m: [0.05, 0.1, 0.2]}\nsampling: sobol\n",
            "demo.yaml:3: sweep.voxel_m: has 3 values; beside sampling write a range"},
           {"sweep: {voxel_m: [0.05]}\nsampling: sobol\n", "sweep.voxel_m: has 1 value; "},
           {"sweep: {voxel_m: [small, large]}\nsampling: sobol\n",
            "demo.yaml:3: sweep.voxel_m[0]: is small; write a number"},
           {"sweep: {voxel_m: [0.05, 11]}\nsampling: sobol\n", "11 is out of range"},
           {"sweep: {voxel_m: [1, 2]}\nsampling: {sobol: {points: 0}}\n",
            "demo.yaml:4: sampling.sobol.points: 0 is out of range; write a number from 1"},
           {"sweep: {voxel_m: [1, 2]}\nsampling: {sobol: {points: 1000001}}\n",
            "sampling.sobol.points: 1000001 is out of range"},
           {"sweep: {voxel_m: [1, 2]}\nsampling: {halton: {}}\n",
            "unknown kind 'halton'; write one of grid, latin_hypercube, sobol"},
           {"sweep: {sampling: [sobol]}\n", "sampling"}})
    mapscore::testing::expect_error(message,
                                    [&, text = std::string(lines)] { (void)sampled_study(text); });
}

}  // namespace
}  // namespace mapscore::eval
