// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/trajectory_picture.hpp"

#include "core/error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// 4 x 3 cells of 0.5 m, low corner at (1, 2): unknown, but for a row of free cells and an occupied
/// one at its end.
OccupancyGrid small_grid(double yaw_rad = 0.0) {
  OccupancyGrid grid(
      {.resolution_m = 0.5, .T_map_grid = {1.0, 2.0, yaw_rad}, .width = 4, .height = 3});
  for (const int column : {0, 1, 2}) grid.set({column, 1}, kFreeCell);
  grid.set({3, 1}, kOccupiedCell);
  return grid;
}

DrawnTrajectory along_the_row() {
  return {"truth", {{1.25, 2.75}, {2.25, 2.75}}, {}};
}

PoseEstimate belief(const Eigen::Vector3d& variances, double yaw_rad) {
  PoseEstimate estimate{{1.5, 2.75, yaw_rad}, Eigen::Matrix3d::Zero()};
  estimate.covariance.diagonal() = variances;
  return estimate;
}

/// Lines of a block of the data file without its comments.
std::vector<std::string> block(const FigureSheet& sheet, const std::string& name) {
  std::istringstream lines(sheet.data);
  std::vector<std::string> found;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) inside = false;
    if (inside && line[0] != '#') found.push_back(line);
    if (line == "# " + name) inside = true;
  }
  return found;
}

TEST(TwoSigmaEllipse, TurnsTheCovarianceOfTheBaseIntoTheMap) {
  const PlanarEllipse ahead = two_sigma_ellipse(belief({0.09, 0.01, 1.0}, 0.5));
  EXPECT_NEAR(ahead.first_axis_m, 1.2, 1e-12) << "twice two sigma of 0.3 m";
  EXPECT_NEAR(ahead.second_axis_m, 0.4, 1e-12);
  EXPECT_NEAR(std::remainder(ahead.angle_rad - 0.5, std::numbers::pi), 0.0, 1e-12);
  const PlanarEllipse aside = two_sigma_ellipse(belief({0.01, 0.09, 1.0}, 0.5));
  EXPECT_NEAR(aside.first_axis_m, 1.2, 1e-12);
  EXPECT_NEAR(std::remainder(aside.angle_rad - 0.5 - std::numbers::pi / 2, std::numbers::pi), 0.0,
              1e-12);
}

TEST(TwoSigmaEllipse, EveryPointOfItIsTwoSigmaAway) {
  PoseEstimate estimate = belief({0.04, 0.02, 0.1}, -1.1);
  estimate.covariance(0, 1) = estimate.covariance(1, 0) = 0.017;
  const Eigen::Rotation2Dd R(-1.1);
  const Eigen::Matrix2d S = R.toRotationMatrix() * estimate.covariance.topLeftCorner<2, 2>() *
                            R.inverse().toRotationMatrix();
  const PlanarEllipse e = two_sigma_ellipse(estimate);
  for (double t = 0.0; t < 6.28; t += 0.3) {
    const Eigen::Vector2d offset =
        Eigen::Rotation2Dd(e.angle_rad) *
        Eigen::Vector2d(0.5 * e.first_axis_m * std::cos(t), 0.5 * e.second_axis_m * std::sin(t));
    EXPECT_NEAR(offset.dot(S.inverse() * offset), 4.0, 1e-9) << t;
  }
}

TEST(TwoSigmaEllipse, OfNoDoubtIsAPointAndOfNoNumberIsRefused) {
  EXPECT_EQ(two_sigma_ellipse(belief({0, 0, 0}, 0.3)).first_axis_m, 0.0);
  EXPECT_THROW((void)two_sigma_ellipse(belief({std::nan(""), 0, 0}, 0.3)), Error);
}

TEST(TrajectoryFigure, ShowsWhatIsKnownOnTheGridsLattice) {
  const std::vector<DrawnTrajectory> one{along_the_row()};
  const FigureSheet sheet = trajectory_figure(small_grid(), one, {});
  // The row from the middle of its first cell to that of its last, and a quarter metre around:
  // from x = 1 to 3 and y = 2.5 to 3.
  EXPECT_THAT(block(sheet, "grid"), ElementsAre("3 3 3 0"));
  EXPECT_THAT(sheet.panels.front().elements.front(), HasSubstr("(1.25+0.5*$1):(2.75+0.5*$2):3"));
  EXPECT_THAT(block(sheet, "truth"), ElementsAre("1.2500 2.7500", "2.2500 2.7500"));
  EXPECT_THAT(block(sheet, "start"), ElementsAre("1.2500 2.7500"));
  EXPECT_THAT(block(sheet, "end"), ElementsAre("2.2500 2.7500"));
}

TEST(TrajectoryFigure, GrowsWithWhatIsDrawnAndIsUnknownBeyondTheGrid) {
  const std::vector<DrawnTrajectory> astray{{"odometry", {{1.25, 2.75}, {1.25, 4.0}}, {}}};
  const FigureSheet sheet = trajectory_figure(small_grid(), astray, {});
  EXPECT_THAT(block(sheet, "grid"), ElementsAre("3 3 3 0", "2 2 2 2", "2 2 2 2", "2 2 2 2"));
  EXPECT_NEAR(sheet.panel_height_in / sheet.panel_width_in, 1.0, 1e-12) << "one scale";
}

TEST(TrajectoryFigure, AWayThatIsLostFarFromHomeIsASmallSquarePicture) {
  const std::vector<DrawnTrajectory> astray{{"odometry", {{1.25, 2.75}, {1.25, 1e6}}, {}}};
  const FigureSheet sheet = trajectory_figure(small_grid(), astray, {});
  EXPECT_NEAR(sheet.panel_height_in / sheet.panel_width_in, 1.0, 0.01);
  EXPECT_LT(sheet.panel_width_in, 10.0);
  EXPECT_LT(sheet.data.size(), 10'000'000u);
}

TEST(TrajectoryFigure, ATurnedGridIsShownOnAFinerLatticeOfTheMap) {
  const OccupancyGrid grid = small_grid(std::numbers::pi / 2);
  const FigureSheet sheet = trajectory_figure(grid, {}, {});
  // The row now runs along y: columns at x = 0 to 0.5, the occupied cell at y = 3.5 to 4.
  const std::vector<std::string> rows = block(sheet, "grid");
  ASSERT_EQ(rows.size(), 8u);
  EXPECT_EQ(rows.front(), "3 3");
  EXPECT_EQ(rows.back(), "0 0");
}

TEST(TrajectoryFigure, WritesEllipsesInDegreesAndWaypoints) {
  DrawnTrajectory filter{"particle filter", {{1.5, 2.75}}, {belief({0.04, 0.01, 0.1}, 0.5)}};
  const std::vector<DrawnTrajectory> two{along_the_row(), filter};
  TrajectoryNotes notes;
  notes.waypoints_map = {{2.0, 2.75}};
  const FigureSheet sheet = trajectory_figure(small_grid(), two, notes);
  EXPECT_THAT(block(sheet, "particle filter, 2 sigma").front(),
              ::testing::StartsWith("1.5000 2.7500 0.8000 0.4000 "));
  EXPECT_THAT(block(sheet, "waypoints"), ElementsAre("2.0000 2.7500"));
  EXPECT_EQ(sheet.legend.size(), 6u);  // two lines, ellipses, waypoint, start, end
  EXPECT_THAT(sheet.caption, HasSubstr("Ellipses: 2 sigma"));
}

TEST(TrajectoryFigure, LinesThatRunAsOneAllShow) {
  std::vector<DrawnTrajectory> same(5, along_the_row());
  for (std::size_t n = 1; n < same.size(); ++n) same[n].name = "source " + std::to_string(n);
  const FigureSheet sheet = trajectory_figure(small_grid(), same, {});
  double below = 100.0;
  for (std::size_t n = 0; n < same.size(); ++n) {
    const std::string& line = sheet.legend[n].plotting;
    const double width = std::stod(line.substr(line.find("lw ") + 3));
    EXPECT_LT(width, below - 0.3) << line;
    EXPECT_EQ(line.find("dt (") != std::string::npos, n > 1) << line << ": gaps show what is below";
    below = width;
  }
  EXPECT_GT(below, 1.0);
}

TEST(TrajectoryFigure, RefusesWhatCannotBeDrawn) {
  const OccupancyGrid nothing({0.5, {}, 4, 3});
  EXPECT_THROW((void)trajectory_figure(nothing, {}, {}), Error);
  std::vector<DrawnTrajectory> wrong{along_the_row()};
  wrong[0].points_map.emplace_back(std::numeric_limits<double>::infinity(), 0.0);
  try {
    (void)trajectory_figure(small_grid(), wrong, {});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("trajectory 'truth': point (inf, 0)"));
  }
}

TEST(TrajectoryFigure, DrawsNorthUpInTheColoursOfTheGrid) {
  const mapscore::testing::TemporaryFolder folder;
  OccupancyGrid grid({0.5, {}, 8, 8}, kFreeCell);
  grid.set({1, 6}, kOccupiedCell);  // west and north
  grid.set({6, 6}, kUnknownCell);
  const std::vector<DrawnTrajectory> one{{"truth", {{0.75, 0.75}, {3.25, 0.75}}, {}}};
  const auto files =
      draw(trajectory_figure(grid, one, {"drive", "", "", {}}), folder.path() / "new");
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[0].filename(), "drive.png");
  const cv::Mat3b picture = cv::imread(files[0].string());
  cv::Mat1b dark;
  cv::inRange(picture, cv::Scalar(70, 70, 70), cv::Scalar(70, 70, 70), dark);
  ASSERT_GT(cv::countNonZero(dark), 1000);
  std::vector<cv::Point> cell;
  cv::findNonZero(dark, cell);
  const cv::Scalar middle = cv::mean(cell);
  EXPECT_LT(middle[0], 0.5 * picture.cols);
  EXPECT_LT(middle[1], 0.4 * picture.rows);
  cv::inRange(picture, cv::Scalar(153, 153, 153), cv::Scalar(153, 153, 153), dark);
  EXPECT_GT(cv::countNonZero(dark), 1000) << "the truth's line";
}

}  // namespace
}  // namespace mapscore::eval
