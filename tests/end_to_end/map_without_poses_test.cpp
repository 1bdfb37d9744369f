// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/stamp_list.hpp"
#include "files/png.hpp"
#include "tests/core/odometry/flat_depth.hpp"
#include "tests/end_to_end/program.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

// A folder of a camera in a hand, without poses, mapped by the built program.

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kImages = 30;

/// The camera's own pose in the room: along an arc, rising and swaying as no robot does.
Pose hand(int n) {
  const double s = n;
  Pose robot = Pose::Identity();
  robot.translation() = Eigen::Vector3d(1.0 + 0.02 * s, 1.6 + 0.015 * s, 0.1 * std::sin(0.2 * s));
  robot.linear() = (Eigen::AngleAxisd(0.3 + 0.012 * s, Eigen::Vector3d::UnitZ()) *
                    Eigen::AngleAxisd(0.08 * std::sin(0.25 * s), Eigen::Vector3d::UnitX()) *
                    Eigen::AngleAxisd(0.05 * std::sin(0.3 * s), Eigen::Vector3d::UnitY()))
                       .toRotationMatrix();
  return robot * odometry_camera().T_base_depth;
}

class MapWithoutPoses : public ::testing::Test {
 protected:
  MapWithoutPoses() {
    camera_ = odometry_camera();
    camera_.T_base_depth = Pose::Identity();
    fs::create_directories(folder() / "hand/depth");
    fs::create_directories(folder() / "hand/label");
    const CameraModel& depth = camera_.depth;
    write_text(folder() / "cameras.yaml", camera_text(depth));
    write_text(folder() / "classes.yaml", "classes:\n  - {name: thing}\n");
    for (int n = 0; n < kImages; ++n) put(n, flat_depth(furnished_room(), hand(n), camera_));
    list([](int n) { return 0.1 * n; });
  }

  [[nodiscard]] static std::string camera_text(const CameraModel& camera) {
    std::ostringstream text;
    text.precision(17);
    text << "color: {fx_px: " << camera.fx_px << ", fy_px: " << camera.fy_px
         << ", cx_px: " << camera.cx_px << ", cy_px: " << camera.cy_px << "}\nrange_min_m: 0.3\n";
    return text.str();
  }
  [[nodiscard]] static std::string name(int n) { return std::to_string(100 + n) + ".png"; }
  void put(int n, const cv::Mat1w& depth) const {
    write_text(folder() / "hand/depth" / name(n), encode_png(depth));
    cv::Mat1w label(depth.size(), std::uint16_t{0});
    label.setTo(1, depth > 0);
    write_text(folder() / "hand/label" / name(n), encode_png(label));
  }
  /// Lists the first `count` images at these stamps.
  template <class StampOf>
  void list(const StampOf& stamp_of, int count = kImages) const {
    std::string depth, label;
    for (int n = 0; n < count; ++n) {
      const std::string stamp = std::to_string(stamp_of(n));
      depth += stamp + " depth/" + name(n) + '\n';
      label += stamp + " label/" + name(n) + '\n';
    }
    write_text(folder() / "hand/depth.txt", depth);
    write_text(folder() / "hand/label.txt", label);
  }

  [[nodiscard]] Outcome map(const std::string& output, const std::vector<std::string>& more) const {
    std::vector<std::string> words{
        "map",          path("hand"),         "-o",        path(output),        "-q",
        "--intrinsics", path("cameras.yaml"), "--classes", path("classes.yaml")};
    words.insert(words.end(), more.begin(), more.end());
    return mapscore(words);
  }
  [[nodiscard]] Outcome found(const std::string& output = "map.ot") const {
    return map(output, {"--poses", "visual_odometry"});
  }
  /// Of the poses that were found, against the truth from the first image on, metres.
  [[nodiscard]] double largest_error_m(const std::string& file) const {
    double largest = 0.0;
    const auto poses = eval::read_trajectory(folder() / file);
    for (std::size_t n = 0; n < poses.size(); ++n) {
      const Pose truth = hand(0).inverse() * hand(static_cast<int>(n));
      largest =
          std::max(largest, (poses[n].T_world_base.translation() - truth.translation()).norm());
    }
    return largest;
  }

  [[nodiscard]] const fs::path& folder() const { return temporary_.path(); }
  [[nodiscard]] std::string path(const std::string& file) const { return folder() / file; }

 private:
  TemporaryFolder temporary_;
  Calibration camera_;
};

TEST_F(MapWithoutPoses, FindsThemAndWritesThemBesideTheMap) {
  const Outcome outcome = found();
  expect_done(outcome);
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("visual_odometry: 1 started, "),
                    HasSubstr(" of 30 depth images; 0 loops closed"),
                    HasSubstr("30 of 30 label images mapped"), HasSubstr("map_poses.txt")));
  EXPECT_THAT(outcome.err, Not(HasSubstr("warning")));
  EXPECT_EQ(eval::read_trajectory(folder() / "map_poses.txt").size(), 30u);
  EXPECT_LT(largest_error_m("map_poses.txt"), 0.02) << "of half a metre";
}

TEST_F(MapWithoutPoses, TheMapIsThatOfThePosesThatWereFound) {
  for (const char* source : {"visual_odometry", "visual_slam"}) {
    expect_done(map("map.ot", {"--poses", source}));
    fs::copy_file(folder() / "map_poses.txt", folder() / "hand/groundtruth.txt");
    expect_done(map("again.ot", {}));
    EXPECT_TRUE(bytes_of(folder() / "map.ot") == bytes_of(folder() / "again.ot")) << source;
    EXPECT_GT(bytes_of(folder() / "map.ot").size(), 2000u);
    fs::remove(folder() / "hand/groundtruth.txt");
  }
}

TEST_F(MapWithoutPoses, PosesOfAFileAreSaidNotToBeUsed) {
  write_text(folder() / "hand/groundtruth.txt", "0 nan 0 0 0 0 0 1\n");
  const Outcome outcome = found();
  expect_done(outcome);
  EXPECT_EQ(outcome.err,
            "mapscore: note: --poses visual_odometry finds the poses in the depth images; those of "
            "groundtruth.txt are not used\n");
}

TEST_F(MapWithoutPoses, StampsThatAreNoSecondsAreSaid) {
  list([](int n) { return n < 15 ? 0.1 * n : 0.1 * n + 1e6; });
  EXPECT_THAT(found().err, HasSubstr("warning: depth.txt: 1000001.5 s comes 1e+06 s after"));
  list([](int n) { return 1e-6 * n; });  // written with six decimals
  EXPECT_THAT(found().err, AllOf(HasSubstr("warning: depth.txt: from 0 s on images come 1e-06 s"),
                                 HasSubstr("stamps are seconds")));
}

TEST_F(MapWithoutPoses, TheStudySaysHowTheyAreFound) {
  write_text(folder() / "study.yaml",
             "recording: hand\nmethods: {direct: {segmentation: {direct: {}}}}\n");
  const auto by = [&](const std::string& poses, const std::string& change) {
    return map("study.ot", {"--poses", poses, "--study", path("study.yaml"), "--set", change});
  };
  expect_done(found());
  expect_done(by("visual_odometry", "voxel_m=0.05"));
  EXPECT_EQ(bytes_of(folder() / "study_poses.txt"), bytes_of(folder() / "map_poses.txt"));
  expect_done(by("visual_odometry", "localization.visual.points_across=40"));
  EXPECT_NE(bytes_of(folder() / "study_poses.txt"), bytes_of(folder() / "map_poses.txt"));
  expect_done(by("visual_slam", "localization.visual.loop_way_m=2"));
  for (const char* change : {"localization.visual.wheels=false", "localization.filter.temper=0.2",
                             "localization.visual.loop_way_m=2", "localization.source=odometry",
                             "faults.depth.preset=astra"})
    expect_refused(by("visual_odometry", change), {change, "no effect", "localization.visual"});
  expect_refused(by("file", "localization.visual.points_across=40"), {"points_across", "--poses"});
}

TEST_F(MapWithoutPoses, WithoutTheFlagTheErrorSaysHow) {
  expect_refused(map("map.ot", {}), {"groundtruth.txt", "is missing", "--poses visual_odometry"});
  expect_refused(map("map.ot", {"--poses", "guessed"}), {"--poses"});
  EXPECT_FALSE(fs::exists(folder() / "map.ot"));
}

// Into another corner, lower, and looking up: not even the floor is where it was.
TEST_F(MapWithoutPoses, ATeleportIsSaid) {
  Calibration camera = odometry_camera();
  Pose elsewhere = Pose::Identity();
  elsewhere.linear() =
      (Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(-0.5, Eigen::Vector3d::UnitY()) * camera.T_base_depth.linear());
  elsewhere.translation() = Eigen::Vector3d(4.2, 2.4, 0.7);
  camera.T_base_depth = Pose::Identity();
  for (int n = 20; n < kImages; ++n) put(n, flat_depth(furnished_room(), elsewhere, camera));
  const Outcome outcome = found();
  expect_done(outcome);
  EXPECT_THAT(outcome.out, HasSubstr(" lost"));
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("mapscore: warning: of "), HasSubstr("is a guess"),
                                 HasSubstr("the first at 2 s")));
}

TEST_F(MapWithoutPoses, DarkImagesAreSaidAndOnlyDarkOnesRefused) {
  const cv::Mat1w dark = cv::Mat1w::zeros(120, 160);
  for (int n = 10; n < 13; ++n) put(n, dark);
  const Outcome outcome = found();
  expect_done(outcome);
  EXPECT_THAT(outcome.out, HasSubstr("3 blind"));
  EXPECT_THAT(outcome.err, HasSubstr("of 3 depth images the pose is a guess, the first at 1 s"));
  for (int n = 0; n < kImages; ++n) put(n, dark);
  expect_refused(found("dark.ot"), {"depth.txt", "no depth image has enough depth"});
  EXPECT_FALSE(fs::exists(folder() / "dark.ot"));
  EXPECT_FALSE(fs::exists(folder() / "dark_poses.txt"));
}

TEST_F(MapWithoutPoses, OneImageIsItsOwnMap) {
  list([](int) { return 0.0; }, 1);
  const Outcome outcome = found();
  expect_done(outcome);
  EXPECT_THAT(outcome.out, HasSubstr("visual_odometry: 1 started of 1 depth images"));
}

TEST_F(MapWithoutPoses, StampsThatJumpBackAreRefusedAndAGapIsNoSilentLoss) {
  list([](int n) { return n < 15 ? 0.1 * n : 0.1 * n - 1.0; });
  write_text(folder() / "hand/label.txt", "0 label/" + name(0) + "\n");
  expect_refused(found(), {"depth.txt:16", "does not come after"});
  list([](int n) { return n < 15 ? 0.1 * n : 0.1 * n + 60.0; });
  const Outcome outcome = found();
  expect_done(outcome);
  EXPECT_TRUE(outcome.err.find("warning") != std::string::npos ||
              largest_error_m("map_poses.txt") < 0.05)
      << outcome.out;
}

}  // namespace
}  // namespace mapscore::testing
