// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/exploration/coverage_curves.hpp"
#include "eval/report/exploration/exploration_strip.hpp"
#include "eval/report/exploration/exploration_table.hpp"
#include "eval/report/exploration/floor_moments.hpp"
#include "files/text_rows.hpp"
#include "tests/eval/report/figures/figure_files.hpp"

#include <gmock/gmock.h>

#include <map>

namespace mapscore::eval {
namespace {

using testing::FiguresTest;
using ::testing::HasSubstr;

using ExplorationFigures = FiguresTest;

/// Half of the surface after 2 m and 10 s, `last` of it at the end, after 4 m and 30 s.
ExplorationResult exploration(double last) {
  ExplorationResult result;
  result.curve = {{0.0, 0.0, 0, 0.1, 0.1, MapState{}},
                  {10.0, 2.0, 1, 0.5, 0.5, std::nullopt},
                  {30.0, 4.0, 2, last, last, MapState{}}};
  result.curve.back().map->f1 = 0.8;
  for (const CoveragePoint& point : result.curve)
    result.frames.push_back({point.stamp_s, Pose(Eigen::Translation3d(point.driven_m, 0.5, 0.0))});
  OccupancyGrid floor({0.05, {}, 8, 4});
  floor.set({2, 1}, kFreeCell);
  for (std::int32_t column = 0; column < 5; ++column) floor.set({column, 3}, kOccupiedCell);
  for (const CoveragePoint& point : result.curve)
    result.moments.push_back({point.stamp_s, point.driven_m, floor, {{point.stamp_s, 1.0}}});
  result.driven_m = 4.0;
  result.duration_s = 30.0;
  return result;
}

FinishedExploration finished(const std::filesystem::path& folder, int seed, double last) {
  std::filesystem::create_directories(folder);
  write_exploration(exploration(last), "key", folder);
  PlannedExploration planned{{seed, "direct", {}, seed}, "run", {}};
  planned.config.exploration.budget_m = 8;
  planned.config.map_origin_m = {0.0, 0.0, 0.0};
  return {std::move(planned), read_exploration(folder).value(), folder};
}

TEST_F(ExplorationFigures, CurvesAreMeansOverStartsWithTheirRange) {
  const std::vector<FinishedExploration> runs{finished(folder_ / "0", 0, 0.7),
                                              finished(folder_ / "1", 1, 0.9)};
  const FigureSheet sheet = exploration_curves({}, groups_of(runs));
  ASSERT_EQ(sheet.panels.size(), 3u);  // coverage over metres, F1, coverage over seconds
  const auto metres = testing::block(sheet.data, "# coverage over the way; ; direct");
  ASSERT_EQ(metres.size(), 121u);
  EXPECT_EQ(metres.front(), "0 0.1 0.1 0.1");
  EXPECT_EQ(metres[60], "2 0.5 0.5 0.5");
  EXPECT_EQ(metres.back(), "4 0.8 0.7 0.9");
  EXPECT_EQ(testing::block(sheet.data, "# F1 over the way; ; direct").back(), "4 0.8 0.8 0.8");
  EXPECT_EQ(testing::block(sheet.data, "# coverage over time; ; direct")[40], "10 0.5 0.5 0.5");
  EXPECT_THAT(sheet.caption, HasSubstr("Mean over 2 starts; band: least to greatest"));
}

TEST_F(ExplorationFigures, CurvesOfOneStartHaveNoBand) {
  const std::vector<FinishedExploration> runs{finished(folder_ / "0", 0, 0.7)};
  const std::string caption = exploration_curves({}, groups_of(runs)).caption;
  EXPECT_THAT(caption, HasSubstr("against all of it. One start. Those"));
}

TEST_F(ExplorationFigures, TablesForProgramsHoldNumbers) {
  const std::vector<FinishedExploration> runs{finished(folder_ / "0", 0, 0.7),
                                              finished(folder_ / "1", 1, 0.9)};
  Study study;
  study.methods.emplace_back().name = "direct";
  const auto cells = [&](Reader reader) {
    const Table table = exploration_table(study, groups_of(runs), reader);
    std::map<std::string, std::string> row;
    for (std::size_t n = 0; n < table.columns.size(); ++n)
      row[table.columns[n]] = table.rows.at(0).at(n);
    return row;
  };
  auto program = cells(Reader::program), terminal = cells(Reader::terminal);
  EXPECT_EQ(terminal["metres to 90 %"], "6.0 [4.0, 8.0]");  // the budget, and the end
  EXPECT_EQ(program["metres to 90 %"], "6");
  EXPECT_EQ(program["metres to 90 % low"], "4");
  EXPECT_EQ(program["metres to 90 % high"], "8");
  EXPECT_EQ(terminal["reached"], "1/2");
  EXPECT_EQ(program["reached"], "1");
  EXPECT_EQ(program["starts"], "2");
  EXPECT_EQ(terminal["ends"], "2 budget");
  EXPECT_EQ(program["budget"], "2");
  EXPECT_EQ(program["explored"], "0");
  for (const auto& [column, cell] : program) EXPECT_TRUE(parse_number(cell)) << column;
}

TEST_F(ExplorationFigures, MomentsShowTheWaySoFarAndTheirOwnFrontier) {
  const FinishedExploration run = finished(folder_, 0, 0.9);
  const std::vector<ShownMoment> moments = read_moments(run);
  ASSERT_EQ(moments.size(), 3u);  // at 0 m, at 2 m for two quarters of the way, and the end
  EXPECT_EQ(moments[0].coverage, 0.1);
  EXPECT_EQ(moments[0].way_map.size(), 1u);
  EXPECT_EQ(moments[1].driven_m, 2.0);
  EXPECT_EQ(moments[1].coverage, 0.5);
  EXPECT_EQ(moments[1].way_map.size(), 2u);
  ASSERT_EQ(moments[1].frontier_map.size(), 1u);
  EXPECT_EQ(moments[1].frontier_map[0], Eigen::Vector2d(10.0, 1.0));
  EXPECT_EQ(moments[1].floor.at({2, 1}), kFreeCell);
  EXPECT_EQ(moments[2].stamp_s, 30.0);
  EXPECT_EQ(moments[2].driven_m, 4.0);
  EXPECT_EQ(exploration_moments(run).panels.size(), 3u);
  EXPECT_FALSE(exploration_strip(run));  // no recording was kept
}

TEST_F(ExplorationFigures, FloorsShowEachCellOfTheGrid) {
  const FinishedExploration run = finished(folder_, 0, 0.9);
  const FigureSheet sheet = exploration_moments(run);
  const OccupancyGrid floor = read_moments(run).front().floor;
  std::map<char, std::size_t> shown, there;
  for (const std::string& row : testing::block(sheet.data, "# grid"))
    for (const char cell : row) ++shown[cell];
  for (const Occupancy value : floor.cells())
    ++there[value == kUnknownCell ? '1' : value == kFreeCell ? '2' : '0'];
  EXPECT_EQ(there['0'], 5u);
  EXPECT_EQ(shown['0'], sheet.panels.size() * there['0']);
  EXPECT_EQ(shown['2'], sheet.panels.size() * there['2']);
  // Pixels lie where the cells do: centres at odd multiples of 2.5 cm.
  EXPECT_THAT(sheet.panels[0].elements[0], HasSubstr("(-0.1750+0.0500*$1):(-0.1250+0.0500*$2)"));
}

}  // namespace
}  // namespace mapscore::eval
