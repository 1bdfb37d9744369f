// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/figures.hpp"
#include "eval/report/figures/pose_errors_figure.hpp"
#include "eval/report/tables/table.hpp"
#include "tests/eval/report/figures/figure_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

using testing::block;
using ::testing::Contains;
using ::testing::ElementsAre;
using testing::FiguresTest;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::synthetic_study;
using testing::synthetic_summary;

const SweepAxis kSource{"localization.source", {"odometry", "particle_filter"}};

/// At cell c and seed s an ATE of (1 + c) (1 + s) cm, the same of both methods.
StudySummary with_poses(int seeds = 2) {
  StudySummary summary =
      synthetic_summary(synthetic_study({"direct", "erosion"}, {kSource}, seeds));
  summary.study.score.asked.poses = true;
  for (auto* lines : {&summary.trials, &summary.registration_ceilings, &summary.lattice_ceilings})
    for (ResultLine& line : *lines) {
      line.pooled.clear();
      for (std::size_t seed = 0; seed < line.results.size(); ++seed) {
        Counts& counts = line.results[seed].counts;
        for (ClassCounts& c : counts) c.poses.emplace();
        const double ate_m = 0.01 * (1 + line.cell.index) * static_cast<double>(1 + seed);
        TrajectoryErrors errors;
        errors.position = {10, 10 * ate_m * ate_m};
        errors.planar = {10, 9, 0, 25.0};
        counts[kBackground].poses = PoseCounts::of(errors);
        pool_into(line.pooled, counts);
      }
    }
  return summary;
}

TEST_F(FiguresTest, PosesAreDrawnOnceForAllMethods) {
  const auto sheet = pose_figure(with_poses());
  ASSERT_TRUE(sheet);
  EXPECT_EQ(sheet->name, "poses_by_source");
  EXPECT_EQ(sheet->panels.size(), 6u);
  EXPECT_EQ(testing::blocks(sheet->data), 6);
  // sqrt((1 + 4) / 2) cm of both seeds together, from 1 to 2 cm; twice that with the filter.
  EXPECT_THAT(block(sheet->data, "# poses; pooled ate_m"),
              ElementsAre("0 0.0158113883 0.01 0.02 0.0158113883 0.0158113883",
                          "1 0.0316227766 0.02 0.04 0.0316227766 0.0316227766"));
  EXPECT_THAT(sheet->legend, IsEmpty());
  EXPECT_THAT(sheet->caption, HasSubstr("range of the 2 seeds"));
  EXPECT_EQ(draw(*sheet, folder_).size(), 3u);
}

TEST_F(FiguresTest, PosesThatWereNotScoredHaveNoFigure) {
  EXPECT_FALSE(pose_figure(testing::one_axis()));
}

TEST_F(FiguresTest, PosesStandInTheTableOfEveryGroup) {
  for (const char* group : {"pooled", "macro", "cup"}) {
    const Table table = score_table(with_poses(), group);
    const auto column = std::ranges::find(table.columns, "ATE (m)") - table.columns.begin();
    ASSERT_LT(column, std::ssize(table.columns)) << group;
    EXPECT_EQ(table.rows.back()[static_cast<std::size_t>(column)], "0.032") << group;
  }
  EXPECT_THAT(score_table(testing::one_axis(), "pooled").columns,
              ::testing::Not(Contains("ATE (m)")));
}

FrameError error_at(double stamp_s, double ahead_m, double turned_rad, double sigma) {
  FrameError error;
  error.stamp_s = stamp_s;
  error.converged = stamp_s > 0.0;
  error.error = {ahead_m, 0.0, turned_rad};
  error.sigma.setConstant(sigma);
  return error;
}

TEST_F(FiguresTest, ErrorsOverTimeStandInTheBandOfTwoSigma) {
  const double degree = std::numbers::pi / 180.0;
  const std::vector<PoseErrors> sources{
      {"wheels",
       {error_at(0, 9, 9, 9), error_at(1, 0.1, 3 * degree, degree),
        error_at(2, -0.03, degree, degree)}},
      {"lost", {error_at(0, 9, 9, 9)}}};
  const FigureSheet sheet = pose_errors_figure(sources, "A drive. ");
  EXPECT_EQ(sheet.name, "errors_over_time");
  EXPECT_EQ(sheet.columns, 2);
  EXPECT_EQ(sheet.panels.size(), 6u);
  EXPECT_THAT(block(sheet.data, "# wheels"),
              ElementsAre("1 10 -3.49066 3.49066 0 -3.49066 3.49066 3 -2 2",
                          "2 -3 -3.49066 3.49066 0 -3.49066 3.49066 1 -2 2"));
  EXPECT_THAT(sheet.caption, HasSubstr("wheels: 50, 100 and 50 % of frames within the band."));
  EXPECT_THAT(sheet.caption, HasSubstr("lost: never converged."));
  EXPECT_EQ(draw(sheet, folder_).size(), 3u);
}

}  // namespace
}  // namespace mapscore::eval
