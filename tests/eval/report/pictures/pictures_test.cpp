// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/pictures.hpp"

#include "core/error.hpp"
#include "eval/report/pictures/caption.hpp"
#include "eval/report/pictures/judgement.hpp"
#include "eval/score/voxel_score.hpp"
#include "tests/eval/report/synthetic_summary.hpp"
#include "tests/eval/score/score_cases.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

namespace mapscore::eval {
namespace {

using testing::kEdge_m;
using testing::random_case;
using testing::surface_of;
using testing::synthetic_study;
using testing::synthetic_table;
using testing::visible_of;

constexpr ClassId kCup = 1, kChair = 2, kWall = 3;

Verdict verdict_at(const std::vector<JudgedVoxel>& judged, const VoxelKey& key) {
  const auto found = std::find_if(judged.begin(), judged.end(),
                                  [&](const JudgedVoxel& voxel) { return voxel.key == key; });
  EXPECT_NE(found, judged.end());
  return found->verdict;
}

TEST(Judgement, GivesEveryCause) {
  const SurfaceTruth surface =
      surface_of({{{0, 0, 0}, kCup}, {{5, 0, 0}, kWall}, {{9, 0, 0}, kChair}});
  const VisibleTruth visible =
      visible_of({{{0, 0, 0}, kCup}, {{9, 0, 0}, kChair}, {{5, 0, 0}, kWall}});
  const MapSnapshot map = testing::map_of(
      {{{0, 0, 0}, kCup}, {{1, 1, 1}, kCup}, {{5, 0, 0}, kCup}, {{20, 0, 0}, kCup}});
  const auto judged = judge(map, 0.5, surface, visible, synthetic_table());
  EXPECT_EQ(verdict_at(judged, {0, 0, 0}), Verdict::right);
  EXPECT_EQ(verdict_at(judged, {1, 1, 1}), Verdict::near);
  EXPECT_EQ(verdict_at(judged, {5, 0, 0}), Verdict::leak);
  EXPECT_EQ(verdict_at(judged, {20, 0, 0}), Verdict::floating);
  EXPECT_EQ(verdict_at(judged, {9, 0, 0}), Verdict::missed);
  EXPECT_EQ(judged.size(), 5u) << "the wall is not detected, so it is not missed";
}

TEST(Judgement, AMissedVoxelUnderAnotherClassIsCovered) {
  const SurfaceTruth surface = surface_of({{{0, 0, 0}, kCup}});
  const VisibleTruth visible = visible_of({{{0, 0, 0}, kCup}});
  const auto judged =
      judge(testing::map_of({{{0, 0, 0}, kChair}}), 0.5, surface, visible, synthetic_table());
  ASSERT_EQ(judged.size(), 2u);
  EXPECT_EQ(judged[0].verdict, Verdict::leak);
  EXPECT_EQ(judged[1].verdict, Verdict::missed);
  EXPECT_TRUE(judged[1].covered);
}

TEST(Judgement, HasAsManyVoxelsOfEachKindAsTheScoreCounts) {
  ClassTable table = synthetic_table();
  table.classes[kWall].detect = true;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const testing::RandomCase made = random_case(seed);
    const SurfaceTruth surface = surface_of(made.surface);
    const VisibleTruth visible = visible_of(made.owners);
    const MapSnapshot map(made.map);
    const ClassCounts counts =
        pool_detected(score_voxels(map, 0.3, surface, visible, table.classes.size()), table);
    const auto judged = judge(map, 0.3, surface, visible, table);
    const auto count = [&](Verdict verdict) {
      return std::ranges::count(judged, verdict, &JudgedVoxel::verdict);
    };
    EXPECT_EQ(count(Verdict::right), counts.true_predicted);
    EXPECT_EQ(count(Verdict::near), counts.false_near);
    EXPECT_EQ(count(Verdict::leak), counts.false_leak);
    EXPECT_EQ(count(Verdict::floating), counts.false_floating);
    EXPECT_EQ(count(Verdict::missed), counts.visible - counts.found);
    EXPECT_EQ(std::count_if(judged.begin(), judged.end(), [](const auto& v) { return v.covered; }),
              counts.missed_mislabelled);
  }
}

TEST(Judgement, ColoursDiffer) {
  for (const Verdict a : kVerdicts)
    for (const Verdict b : kVerdicts) EXPECT_EQ(colour_of(a) == colour_of(b), a == b);
}

TEST(PictureChoice, TakesTheMiddleDoseUnlessToldOtherwise) {
  const Study study = synthetic_study(
      {"direct"}, {{"voxel_m", {"0.02", "0.05", "0.1"}}, {"fusion.blend.N", {"1", "10"}}}, 1);
  EXPECT_EQ(text_of(chosen_cell(study, {})), "voxel_m = 0.05, fusion.blend.N = 10");
  PictureChoice choice;
  choice.doses = {{"fusion.blend.N", "1"}};
  EXPECT_EQ(text_of(chosen_cell(study, choice)), "voxel_m = 0.05, fusion.blend.N = 1");
}

TEST(PictureChoice, RefusesWhatIsNotSwept) {
  const Study study = synthetic_study({"direct"}, {{"voxel_m", {"0.02", "0.05"}}}, 1);
  for (const auto& [path, value] :
       std::map<std::string, std::string>{{"place", "voxels"}, {"voxel_m", "0.03"}}) {
    PictureChoice choice;
    choice.doses = {{path, value}};
    EXPECT_THROW(static_cast<void>(chosen_cell(study, choice)), Error) << path;
  }
}

TEST(JudgedMap, LiesWhereItsFrameSays) {
  const Pose T_map_world = map_from_world({1.0, 2.0, 0.5}, 0.3);
  const JudgedMap map = judged_map(
      "mine", "my map", testing::map_of({{{0, 0, 0}, kCup}, {{7, 7, 7}, kCup}}), 0.5,
      surface_of({{{0, 0, 0}, kCup}}), visible_of({{{0, 0, 0}, kCup}, {{4, 0, 0}, kWall}}),
      synthetic_table(), T_map_world);
  EXPECT_EQ(map.name, "mine");
  EXPECT_EQ(map.voxels.size(), 2u);
  EXPECT_TRUE(map.T_world_map.isApprox(T_map_world.inverse()));
  EXPECT_TRUE(map.seen_map.isApprox(
      Eigen::AlignedBox3d(centre_of({0, 0, 0}, kEdge_m), centre_of({4, 0, 0}, kEdge_m))));
  ASSERT_EQ(map.truth.size(), 1u) << "the wall is seen, but not detected";
  EXPECT_EQ(map.truth[0].key, (VoxelKey{0, 0, 0}));
  EXPECT_EQ(map.truth[0].class_id, kCup);
}

TEST(Captioned, KeepsThePictureAndShowsEveryColour) {
  const cv::Mat3b picture(100, 300, cv::Vec3b(10, 20, 30));
  const cv::Mat3b sheet = captioned(
      picture, "title", {{{255, 0, 0}, "one"}, {{0, 255, 0}, "two"}, {{0, 0, 255}, "three"}});
  EXPECT_EQ(sheet.cols, 300);
  for (const cv::Vec3b& colour : {cv::Vec3b(0, 0, 255), cv::Vec3b(0, 255, 0), cv::Vec3b(255, 0, 0)})
    EXPECT_TRUE(std::find(sheet.begin(), sheet.end(), colour) != sheet.end());
  EXPECT_EQ(std::count(sheet.begin(), sheet.end(), cv::Vec3b(10, 20, 30)), 100 * 300);
}

TEST(Captioned, BreaksTitlesBetweenPhrases) {
  const cv::Mat3b picture(20, 300, cv::Vec3b(10, 20, 30));
  const int none = captioned(picture, "", {}).rows;
  const int one = captioned(picture, "region growing, 20 mm", {}).rows;
  const int two = captioned(picture, "region growing, misregistration = 20 mm", {}).rows;
  EXPECT_EQ(none, 20);
  EXPECT_GT(one, none);
  EXPECT_GT(two, one);
}

/// Rows of a sheet from the first to the last that is not white, in columns first..end-1.
int inked_rows(const cv::Mat3b& sheet, int first, int end) {
  int top = sheet.rows, bottom = -1;
  for (int v = 0; v < sheet.rows; ++v)
    for (int u = first; u < end; ++u)
      if (sheet(v, u)[0] < 128) {
        top = std::min(top, v);
        bottom = v;
      }
  return bottom - top + 1;
}

TEST(InColumns, DoesNotScaleTheTextWithThePictures) {
  const cv::Mat3b picture(960, 1280, cv::Vec3b::all(255));
  const CaptionedColumn column{"H", {picture}, {}};
  const cv::Mat3b sheet = in_columns({column, column, column}, 640);
  EXPECT_EQ(sheet.cols, 3 * 640);
  EXPECT_GE(inked_rows(sheet, 0, 640), sheet.cols / 110) << "1.5 mm on 17 cm";
}

TEST(InColumns, AlignsPicturesUnderTitlesOfAnyLength) {
  const cv::Mat3b picture(96, 128, cv::Vec3b(10, 20, 30));
  const cv::Mat3b sheet =
      in_columns({{"short", {picture, picture}, {{{255, 0, 0}, "one"}}},
                  {"a longer title, of several phrases, that need lines", {picture, picture}, {}}},
                 128);
  EXPECT_EQ(std::count(sheet.begin(), sheet.end(), cv::Vec3b(10, 20, 30)), 4 * 96 * 128);
  for (int v = 0; v < sheet.rows; ++v)
    EXPECT_EQ(sheet(v, 0) == cv::Vec3b(10, 20, 30), sheet(v, 255) == cv::Vec3b(10, 20, 30)) << v;
}

TEST(WritePicture, WritesWhatItWasGiven) {
  const auto file = std::filesystem::temp_directory_path() / "mapscore_pictures_test.png";
  cv::Mat3b picture(4, 5, cv::Vec3b(1, 2, 3));
  picture(2, 3) = {200, 100, 50};
  EXPECT_EQ(write_picture(file, picture), file);
  EXPECT_EQ(cv::norm(cv::imread(file.string()), picture, cv::NORM_INF), 0.0);
  std::filesystem::remove(file);
}

TEST(WritePicture, LeavesNothingBehindWhereItCannot) {
  const auto folder = std::filesystem::temp_directory_path() / "mapscore_pictures_folder_test";
  std::filesystem::create_directories(folder / "taken.png" / "by_a_folder");
  const cv::Mat3b picture(4, 5, cv::Vec3b(1, 2, 3));
  EXPECT_THROW(write_picture(folder / "taken.png", picture), Error);
  EXPECT_THROW(write_picture(folder / "missing" / "picture.png", picture), Error);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace mapscore::eval
