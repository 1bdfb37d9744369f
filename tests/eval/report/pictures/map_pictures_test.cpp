// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/map_pictures.hpp"

#include "core/error.hpp"
#include "eval/lab/recorded_surfaces.hpp"
#include "eval/report/pictures/view.hpp"
#include "eval/study/picture_view.hpp"
#include "tests/support/plate_recording.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// One voxel of each verdict in a row along x, the map turned and moved in the world.
JudgedMap row_of_verdicts() {
  JudgedMap map;
  map.name = map.title = "row";
  map.edge_m = 0.1;
  map.T_world_map = planar_pose(2.0, -1.0, 0.7);
  for (std::size_t i = 0; i < kVerdicts.size(); ++i)
    map.voxels.push_back({{3 * static_cast<int>(i), 0, 4}, 1, kVerdicts[i], false});
  map.seen_map = {Eigen::Vector3d(0, -0.5, 0), Eigen::Vector3d(1.4, 0.5, 0.9)};
  return map;
}

/// Pixel of a point in the picture of a view that does not look straight up or down.
cv::Point pixel_of(const Eigen::Vector3d& p, const sim::View& view) {
  const Eigen::Vector3d forward = (view.target_m - view.eye_m).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d down = forward.cross(right), ray = p - view.eye_m;
  const double focal_px = 0.5 * view.height_px / std::tan(view.vfov_deg * M_PI / 360.0);
  return {static_cast<int>(
              std::floor(0.5 * view.width_px + focal_px * right.dot(ray) / forward.dot(ray))),
          static_cast<int>(
              std::floor(0.5 * view.height_px + focal_px * down.dot(ray) / forward.dot(ray)))};
}

TEST(ErrorViews, AreTheChosenOneOrAnOverviewAndACloseOne) {
  const sim::View chosen = view_of_numbers(std::vector<double>{0, 0, 5, 1, 1, 0});
  ASSERT_EQ(error_views({row_of_verdicts()}, chosen, {}).size(), 1u);
  EXPECT_EQ(error_views({row_of_verdicts()}, chosen, {}).front().eye_m, chosen.eye_m);
  EXPECT_EQ(error_views({row_of_verdicts()}, std::nullopt, {}).size(), 2u);
}

TEST(ErrorViews, HoldEveryCornerOfWhatWasSeen) {
  const JudgedMap map = row_of_verdicts();
  const sim::View view = overview({map});
  for (int corner = 0; corner < 8; ++corner) {
    const cv::Point pixel = pixel_of(
        map.T_world_map * map.seen_map.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)),
        view);
    EXPECT_TRUE(cv::Rect(0, 0, view.width_px, view.height_px).contains(pixel)) << pixel;
  }
}

TEST(ErrorViews, AreFiniteWithoutVoxelsCamerasOrAnythingSeen) {
  JudgedMap nothing_seen = row_of_verdicts();
  nothing_seen.seen_map.setEmpty();
  for (const JudgedMap& map : {JudgedMap{}, nothing_seen, row_of_verdicts()})
    for (const sim::View& view : error_views({map}, std::nullopt, {})) {
      EXPECT_TRUE(view.eye_m.allFinite() && view.target_m.allFinite());
      EXPECT_GT((view.eye_m - view.target_m).norm(), 0.1);
      EXPECT_LT((view.eye_m - view.target_m).norm(), 20.0);
    }
}

TEST(ErrorViews, LookFromWhereACameraWas) {
  Pose T_world_depth = Pose::Identity();  // looks along z of the world
  T_world_depth.translation() = Eigen::Vector3d(2.5, -0.7, -1.5);
  const sim::View view = error_view({row_of_verdicts()}, {T_world_depth});
  EXPECT_EQ(view.eye_m.head<2>(), T_world_depth.translation().head<2>());
}

TEST(Legends, CountTruthAndMapByClass) {
  JudgedMap map = row_of_verdicts();
  map.truth = {{{0, 0, 4}, 1}, {{1, 0, 4}, 1}, {{2, 0, 4}, 2}};
  ClassTable table;
  table.classes.push_back({1, "cup", {255, 0, 0}, true});
  table.classes.push_back({2, "chair", {0, 0, 255}, true});
  table.classes.push_back({3, "tv", {0, 255, 255}, true});
  const auto truth = truth_legend(map, table), predicted = class_legend(map, table);
  ASSERT_EQ(truth.size(), 2u);
  EXPECT_EQ(truth[0].text, "cup 2");
  EXPECT_EQ(truth[1].text, "chair 1");
  ASSERT_EQ(predicted.size(), 1u);
  EXPECT_EQ(predicted[0].text, "cup 4") << "all verdicts but missed";
}

TEST(ErrorLegend, CountsEveryVerdictAndWhatIsCovered) {
  JudgedMap map = row_of_verdicts();
  map.voxels.push_back({{0, 0, 4}, 2, Verdict::missed, true});
  const std::vector<LegendEntry> legend = error_legend(map);
  ASSERT_EQ(legend.size(), kVerdicts.size());
  EXPECT_EQ(legend.front().text, "true 1");
  EXPECT_EQ(legend.back().text, "missed 2 (1 under another class)");
  EXPECT_EQ(legend.back().colour, colour_of(Verdict::missed));
}

#ifdef MAPSCORE_SIMULATOR

/// Pixel of a point in the picture of a view straight down.
cv::Point pixel_seen_from_above(const Eigen::Vector3d& p, const sim::View& view) {
  const double focal_px = 0.5 * view.height_px / std::tan(view.vfov_deg * M_PI / 360.0);
  const Eigen::Vector3d ray = p - view.eye_m;
  return {static_cast<int>(std::floor(0.5 * view.width_px - focal_px * ray.x() / ray.z())),
          static_cast<int>(std::floor(0.5 * view.height_px + focal_px * ray.y() / ray.z()))};
}

ClassTable two_classes() {
  ClassTable table;
  table.classes.push_back({1, "floor", {255, 0, 0}, true});
  table.instances.push_back({1, "floor_1", 1});
  return table;
}

Shape floor_of(InstanceId instance) {
  Shape floor;
  floor.kind = ShapeKind::plane;
  floor.instance = instance;
  floor.size = {10, 10, 0};
  return floor;
}

TEST(ErrorPicture, DrawsEveryVerdictInItsPlaceAndColour) {
  const JudgedMap map = row_of_verdicts();
  ScenePainter painter({floor_of(0)}, two_classes());
  for (const std::vector<double>& numbers : std::vector<std::vector<double>>{
           {2.5, -3, 3, 2.5, -0.7, 0.4}, {0, 0, 4, 2.4, -0.6, 0.4, 60}, {5, 1, 2, 2, -0.6, 0.4}}) {
    const sim::View view = view_of_numbers(numbers);
    const cv::Mat3b picture = error_picture(map, painter, view);
    for (const JudgedVoxel& voxel : map.voxels) {
      const cv::Vec3b got =
          picture(pixel_of(map.T_world_map * centre_of(voxel.key, map.edge_m), view));
      const cv::Scalar want = bgr(colour_of(voxel.verdict));
      for (int c = 0; c < 3; ++c) {
        EXPECT_LE(got[c], want[c] + 1) << name_of(voxel.verdict);
        EXPECT_GE(got[c], 0.8 * want[c] - 2) << name_of(voxel.verdict);
      }
    }
  }
}

TEST(ErrorPicture, LeavesCoveredVoxelsToWhatCoversThem) {
  JudgedMap map = row_of_verdicts();
  map.voxels = {{{0, 0, 4}, 1, Verdict::leak, false}, {{0, 0, 4}, 1, Verdict::missed, true}};
  ScenePainter painter({floor_of(0)}, two_classes());
  const sim::View view = view_of_numbers(std::vector<double>{2.5, -3, 3, 2, -1, 0.4});
  const cv::Vec3b got = error_picture(
      map, painter, view)(pixel_of(map.T_world_map * centre_of({0, 0, 4}, map.edge_m), view));
  EXPECT_GT(got[2], 150) << "vermillion, not black";
}

TEST(ClassPicture, ShowsWhatIsPredictedAlone) {
  const JudgedMap map = row_of_verdicts();
  ScenePainter painter({floor_of(0)}, two_classes());
  const sim::View view = view_of_numbers(std::vector<double>{2.5, -3, 3, 2.5, -0.7, 0.4});
  const cv::Mat3b picture = class_picture(map, two_classes(), painter, view);
  for (const JudgedVoxel& voxel : map.voxels) {
    const cv::Vec3b got =
        picture(pixel_of(map.T_world_map * centre_of(voxel.key, map.edge_m), view));
    EXPECT_EQ(got[0] < 20 && got[2] > 200, voxel.verdict != Verdict::missed);
  }
}

/// A cube below a board, and one on it.
std::vector<sim::Cube> cubes_below_and_on_a_board() {
  const Eigen::Matrix3d upright = Eigen::Matrix3d::Identity();
  return {{{-0.5, 0, 0.1}, 0.2, upright, {0, 0, 255}}, {{0.5, 0, 1.1}, 0.2, upright, {0, 0, 255}}};
}

TEST(PaintThrough, ShowsCubesBelowThings) {
  Shape board = floor_of(0);
  board.T_world_shape.translation().z() = 0.9;
  board.size = {1, 1, 0};
  ScenePainter painter({floor_of(0), board}, two_classes());
  sim::View view = view_of_numbers(std::vector<double>{0, 0, 20, 0, 0, 0.9, 10});
  const auto cubes = cubes_below_and_on_a_board();
  const cv::Mat3b covered = painter.paint(view, cubes),
                  through = painter.paint_through(view, cubes);
  const cv::Point below = pixel_seen_from_above(cubes[0].centre_world, view);
  const cv::Point on = pixel_seen_from_above(cubes[1].centre_world, view);
  EXPECT_GT(covered(below)[2], 140) << "the board";
  EXPECT_LT(through(below)[2], 20) << "blue";
  EXPECT_GT(through(below)[0], 140);
  EXPECT_EQ(through(on), covered(on));
  EXPECT_EQ(through(5, 5), covered(5, 5)) << "the floor";
}

TEST(MapBesideTruth, ShowsTruthMapAndErrorsInPlaceWithAScale) {
  JudgedMap map = row_of_verdicts();
  map.T_world_map = Pose::Identity();
  map.truth = {{map.voxels.back().key, 1}};  // the one that is missed
  ScenePainter painter({floor_of(0)}, two_classes());
  sim::View view = plan_view({map}, 640);
  const cv::Mat3b sheet = map_beside_truth(map, two_classes(), painter, view);
  ASSERT_EQ(sheet.cols, 3 * 640);
  // The panels stand below the titles: find their first row, where the floor begins.
  int top = 0;
  while (sheet(top, 1) == cv::Vec3b::all(255)) ++top;
  const auto at = [&](int panel, const VoxelKey& key) {
    const cv::Point pixel = pixel_seen_from_above(centre_of(key, map.edge_m), view);
    return sheet(top + pixel.y, 640 * panel + pixel.x);
  };
  const auto is_red = [](const cv::Vec3b& bgr) { return bgr[0] < 20 && bgr[2] > 200; };
  for (const JudgedVoxel& voxel : map.voxels) {
    const bool missed = voxel.verdict == Verdict::missed;
    EXPECT_EQ(is_red(at(0, voxel.key)), missed) << name_of(voxel.verdict);
    EXPECT_EQ(is_red(at(1, voxel.key)), !missed) << name_of(voxel.verdict);
    const cv::Scalar want = bgr(colour_of(voxel.verdict));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(2, voxel.key)[c], want[c], 30);
  }
  // Below the first panel a bar of 0.2 m: the longest of 1, 2, 5 within 0.3 of 1.456 m.
  const cv::Mat3b line = sheet.row(top + view.height_px + 22);
  const auto dark = [](const cv::Vec3b& bgr) { return bgr[0] < 100; };
  const auto begin = std::find_if(line.begin(), line.end(), dark);
  const auto end = std::find_if_not(begin, line.end(), dark);
  EXPECT_NEAR(static_cast<double>(end - begin), 0.2 * *pixels_per_metre(view), 6);
}

class DrawErrorPicture : public ::testing::Test {
 protected:
  DrawErrorPicture() { mapscore::testing::write_plate_recording(folder / "plate"); }
  mapscore::testing::TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
};

TEST_F(DrawErrorPicture, StacksTwoViewsOrDrawsTheChosenOne) {
  const Recording recording = Recording::open(folder / "plate");
  ScenePainter painter(shapes_of(recording).at(std::nullopt), recording.info().table);
  draw_error_picture(folder / "auto.png", row_of_verdicts(), painter, std::nullopt,
                     depth_camera_poses(recording));
  draw_error_picture(folder / "chosen.png", row_of_verdicts(), painter,
                     view_of_numbers(std::vector<double>{2.5, -3, 3, 2.5, -0.7, 0.4}));
  const cv::Mat automatic = cv::imread((folder / "auto.png").string());
  const cv::Mat chosen = cv::imread((folder / "chosen.png").string());
  EXPECT_EQ(automatic.cols, 1280);
  EXPECT_GT(automatic.rows, 880 + 960);
  EXPECT_EQ(chosen.cols, 1280);
  EXPECT_LT(chosen.rows, 960 + 120);
}

TEST_F(DrawErrorPicture, RefusesOtherEndingsAndFoldersThatAreNotThere) {
  ScenePainter painter({floor_of(0)}, two_classes());
  const sim::View view = view_of_numbers(std::vector<double>{2.5, -3, 3, 2.5, -0.7, 0.4});
  for (const char* name : {"errors.jpg", "errors", "missing/errors.png"})
    EXPECT_THROW(draw_error_picture(folder / name, row_of_verdicts(), painter, view), Error)
        << name;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << "the recording alone";
}

// The recording's scene file is not there, so its surfaces are drawn.
TEST_F(DrawErrorPicture, TakesTheSurfacesOfARecordingWhereTheSceneIsGone) {
  const Recording recording = Recording::open(folder / "plate");
  Study study;
  study.scene = "gone.xml";
  study.base_folder = folder;
  const sim::View view = view_of_numbers(std::vector<double>{0, 0, 0.15, 1, 0, 0.15});
  const cv::Mat3b by_study = ScenePainter(study, recording).paint(view, {});
  ScenePainter surfaces(shapes_of(recording).at(std::nullopt), recording.info().table);
  const cv::Mat3b by_recording = surfaces.paint(view, {});
  EXPECT_EQ(cv::norm(by_study, by_recording, cv::NORM_INF), 0.0);
  const cv::Vec3b plate = by_study(480, 640), wall = by_study(480, 300);
  EXPECT_GT(plate[2], plate[0] + 5) << "reddish, as its class";
  EXPECT_GT(wall[0], wall[2] + 5) << "bluish";
}

#else

TEST(ScenePainter, SaysThatThereIsNoSimulator) {
  EXPECT_THROW(ScenePainter(std::vector<Shape>{}, ClassTable{}), Error);
  EXPECT_THROW(ScenePainter(fs::path("scene.xml")), Error);
}

#endif

}  // namespace
}  // namespace mapscore::eval
