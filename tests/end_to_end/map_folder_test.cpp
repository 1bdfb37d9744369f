// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/recording.hpp"
#include "files/png.hpp"
#include "tests/end_to_end/program.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <sstream>

// A folder in TUM's layout, without what only our recordings have, mapped by the built program.

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kClasses =
    "classes:\n  - {name: crate, colour: \"FF0000\"}\n  - {name: wall, detect: false}\n";

std::string numbers(const Pose& pose) {
  const Eigen::Quaterniond q(pose.linear());
  std::ostringstream text;
  text.precision(17);
  const Eigen::Vector3d t = pose.translation();
  text << '[' << t.x() << ", " << t.y() << ", " << t.z() << ", " << q.x() << ", " << q.y() << ", "
       << q.z() << ", " << q.w() << "]\n";
  return text.str();
}

/// The cameras of the tiny recording as --intrinsics reads them.
std::string tiny_cameras() {
  const Calibration& calibration = tiny_info().calibration;
  std::ostringstream text;
  text.precision(17);
  const auto camera = [&](const char* name, const CameraModel& model) {
    text << name << ": {fx_px: " << model.fx_px << ", fy_px: " << model.fy_px
         << ", cx_px: " << model.cx_px << ", cy_px: " << model.cy_px << "}\n";
  };
  camera("color", calibration.color);
  camera("depth", calibration.depth);
  text << "T_color_depth: " << numbers(calibration.T_color_depth)
       << "T_base_depth: " << numbers(calibration.T_base_depth)
       << "range_min_m: " << calibration.range_min_m << "\nrange_max_m: " << calibration.range_max_m
       << '\n';
  return text.str();
}

class MapFolder : public ::testing::Test {
 protected:
  MapFolder() { write_tiny_recording(folder_.path() / "ours"); }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_.path() / name).string();
  }

  /// The tiny recording as others would have written it: named rgb.txt, without recording.yaml,
  /// truth, hashes.
  void strip() const {
    fs::copy(path("ours"), path("theirs"), fs::copy_options::recursive);
    for (const char* ours : {"recording.yaml", "color.txt", "hashes.txt", "truth", "depth_label"})
      fs::remove_all(fs::path(path("theirs")) / ours);
    write_text(path("classes.yaml"), kClasses + std::string("instances:\n"
                                                            "  - {id: 1, class: crate}\n"
                                                            "  - {id: 2, class: wall}\n"));
    write_text(path("cameras.yaml"), tiny_cameras());
  }

  /// Rewrites every image of a folder of `theirs`.
  void rewrite(const std::string& images, const std::function<cv::Mat1w(cv::Mat1w)>& change) const {
    const CameraModel& camera = tiny_info().calibration.color;
    for (const auto& entry : fs::directory_iterator(fs::path(path("theirs")) / images)) {
      const cv::Mat1w image = decode_grey16_png(
          bytes_of(entry.path()), {camera.width_px, camera.height_px}, entry.path().string());
      write_text(entry.path(), encode_png(change(image)));
    }
  }

  [[nodiscard]] Outcome map(const std::string& name, const std::string& output,
                            const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"map", path(name), "-o", path(output), "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return mapscore(arguments);
  }
  [[nodiscard]] std::vector<std::string> described() const {
    return {"--intrinsics", path("cameras.yaml"), "--classes", path("classes.yaml")};
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(MapFolder, StrippedFolderGivesTheMapOfTheOriginal) {
  strip();
  expect_done(map("ours", "ours.ot"));
  expect_done(map("theirs", "theirs.ot", described()));
  EXPECT_GT(bytes_of(path("ours.ot")).size(), 300u);
  EXPECT_EQ(bytes_of(path("ours.ot")), bytes_of(path("theirs.ot")));
}

TEST_F(MapFolder, RecordingWithoutTruthIsMapped) {
  expect_done(map("ours", "whole.ot"));
  for (const char* truth : {"truth", "depth_label", "hashes.txt"})
    fs::remove_all(fs::path(path("ours")) / truth);
  expect_done(map("ours", "without.ot"));
  EXPECT_EQ(bytes_of(path("whole.ot")), bytes_of(path("without.ot")));
}

TEST_F(MapFolder, DirectMapOfAllFramesMissesNothing) {
  expect_done(map("ours", "map.ot", {"--segmentation", "direct"}));
  const Outcome score = mapscore({"score", path("map.ot"), "--truth", path("ours"), "--tidy"});
  expect_done(score);
  EXPECT_NE(score.out.find("crate,recall,1\n"), std::string::npos) << score.out;
}

TEST_F(MapFolder, ClassLabelsOfAnotherNumberingAndMillimetres) {
  strip();
  expect_done(map("theirs", "instances.ot", described()));
  // The crate is one component, so class labels say the same; 5 of our units are a millimetre.
  rewrite("label", [](cv::Mat1w label) {
    label.setTo(200, label == 1);
    return label;
  });
  write_text(path("classes.yaml"), "classes: [{name: crate, label: 200}]\n");
  expect_done(map("theirs", "classes.ot", described()));
  EXPECT_EQ(bytes_of(path("instances.ot")), bytes_of(path("classes.ot")));
  rewrite("depth", [](cv::Mat1w depth) { return cv::Mat1w(depth / 5); });
  std::vector<std::string> flags = described();
  flags.insert(flags.end(), {"--depth_scale", "1000", "--color", path("colour.ot")});
  const Outcome outcome = map("theirs", "millimetres.ot", flags);
  expect_done(outcome);
  EXPECT_THAT(outcome.out, ::testing::HasSubstr("4 of 4 label images mapped"));
  EXPECT_GT(bytes_of(path("colour.ot")).size(), 100u);
}

/// A wall before which depth shows no object.
TEST_F(MapFolder, FramesWhoseCalibrationIsMendedUnsurelyAreCounted) {
  strip();
  std::vector<std::string> flags = described();
  flags.insert(flags.end(), {"--segmentation", "edge_aligned"});
  EXPECT_THAT(map("theirs", "sure.ot", flags).out,
              ::testing::Not(::testing::HasSubstr("confidence")));
  rewrite("depth", [](cv::Mat1w depth) {
    depth.setTo(10000);  // 2 m
    return depth;
  });
  const Outcome outcome = map("theirs", "unsure.ot", flags);
  expect_done(outcome);
  EXPECT_THAT(outcome.out,
              ::testing::HasSubstr("4 of 4 frames: mended with a confidence below 0.5; see"));
  flags.back() = "direct";
  EXPECT_THAT(map("theirs", "direct.ot", flags).out,
              ::testing::Not(::testing::HasSubstr("confidence")));
}

TEST_F(MapFolder, PlyScoresAsTheMapDoes) {
  expect_done(map("ours", "map.ot", {"--ply", path("map.ply")}));
  const auto score = [&](const std::string& file) {
    const Outcome outcome = mapscore({"score", path(file), "--truth", path("ours"), "--tidy"});
    expect_done(outcome);
    return outcome.out;
  };
  EXPECT_EQ(score("map.ply"), score("map.ot"));
  expect_refused(map("ours", "other.ot", {"--ply", path("map.pcd")}), {"map.pcd", ".ply"});
  EXPECT_FALSE(fs::exists(path("other.ot")));
}

TEST_F(MapFolder, KeysOfTheStudyCanBeChanged) {
  write_text(path("study.yaml"),
             "recording: ours\nmethods: {direct: {segmentation: {direct: {}}}}\n");
  const std::vector<std::string> study{"--study", path("study.yaml"), "--set", "voxel_m=0.1"};
  expect_done(map("ours", "study.ot", study));
  expect_done(map("ours", "flags.ot", {"--segmentation", "direct", "--voxel_m", "0.1"}));
  EXPECT_EQ(bytes_of(path("study.ot")), bytes_of(path("flags.ot")));
  expect_refused(map("ours", "no.ot", {"--set", "voxel_m=0.1"}), {"--set", "--study"});
}

// The frames lie 0.104 m apart.
TEST_F(MapFolder, KeyFramesAreChosenByFlags) {
  const Outcome mapped = map(
      "ours", "keys.ot", {"--mapped", "key_frames", "--key_way_m", "0.15", "--key_overlap", "0"});
  expect_done(mapped);
  EXPECT_THAT(mapped.out, ::testing::HasSubstr("2 of 4 label images mapped; 2 left out"));
  expect_done(map("ours", "named.ot", {"--frames", "0,2"}));
  EXPECT_TRUE(bytes_of(path("keys.ot")) == bytes_of(path("named.ot")));
  expect_refused(map("ours", "map.ot", {"--key_way_m", "0.15"}), {"--key_way_m", "--mapped"});
  expect_refused(map("ours", "map.ot", {"--mapped", "key_frames", "--key_way_m", "0"}),
                 {"--key_way_m", "above 0"});
}

TEST_F(MapFolder, TakesAllOfTheStudyThatItCanAndRefusesTheRest) {
  write_text(path("study.yaml"),
             "recording: ours\nmethods: {direct: {segmentation: {direct: {}}}}\n");
  const auto by = [&](const std::vector<std::string>& changes) {
    std::vector<std::string> flags{"--study", path("study.yaml")};
    for (const std::string& change : changes) flags.insert(flags.end(), {"--set", change});
    return map("ours", "study.ot", flags);
  };
  expect_done(by({}));
  const std::string plain = bytes_of(path("study.ot"));
  const std::string no_colours = "methods.direct.refinement={crf: {appearance_weight: 0}}";
  for (const std::vector<std::string>& changes : {std::vector<std::string>{"occupancy.carve=true"},
                                                  {"fusion={blend: {decay: view}}"},
                                                  {"detect=[wall]"},
                                                  {"detect=all", no_colours},
                                                  {"place=voxels"},
                                                  {"voxel_m=0.1"}}) {
    expect_done(by(changes));
    EXPECT_NE(bytes_of(path("study.ot")), plain) << changes.front();
  }
  expect_refused(by({"methods.direct.refinement={crf: {}}"}), {"appearance_weight", "colours"});
  expect_refused(by({"perception={simulated: {}}"}), {"perception", "labels"});
  expect_refused(map("ours", "study.ot",
                     {"--study", path("study.yaml"), "--set", "fusion={vote: {}}", "--K", "0.3"}),
                 {"--K", "blend"});
}

TEST_F(MapFolder, VoxelsThatRaysFreedAreNotCounted) {
  write_text(path("study.yaml"),
             "recording: ours\nmethods: {direct: {segmentation: {direct: {}}}}\n"
             "occupancy: {carve: true, hit: 0.51, miss: 0.01}\n");
  const Outcome outcome =
      map("ours", "map.ot",
          {"--study", path("study.yaml"), "--ply", path("map.ply"), "--yaw_deg", "20"});
  expect_done(outcome);
  const std::string ply = bytes_of(path("map.ply"));
  const std::size_t at = ply.find("element vertex ") + 15;
  const int occupied = std::stoi(ply.substr(at));
  std::istringstream row(outcome.out.substr(outcome.out.find("crate") + 5));
  int printed = 0;
  row >> printed;
  EXPECT_GT(occupied, 0);
  EXPECT_EQ(printed, occupied);
}

TEST_F(MapFolder, OutputsAreCheckedBeforeTheWork) {
  fs::create_directory(path("folder.ply"));
  expect_refused(map("ours", "map.png"), {"-o", "map.png", ".ot"});
  expect_refused(map("ours", "map.ot", {"--color", path("map.ot")}), {"--color", "each its own"});
  expect_refused(map("ours", "map.ot", {"--color", path("no/colour.ot")}), {"--color", "folder"});
  write_text(path("cameras.ot"), "color: {fx_px: 280, fy_px: 280, cx_px: 160, cy_px: 120}\n");
  expect_refused(map("ours", "cameras.ot", {"--calibration", path("cameras.ot")}),
                 {"-o", "--calibration reads this file"});
  fs::create_directory_symlink(path("."), path("here"));
  expect_refused(map("ours", "map.ot", {"--color", path("here/map.ot")}),
                 {"--color", "each its own"});
  write_text(path("map_poses.txt"), "classes: {}\n");
  expect_refused(
      map("ours", "map.ot", {"--classes", path("map_poses.txt"), "--poses", "visual_odometry"}),
      {"--poses", "--classes reads this file"});
  expect_refused(map("ours", "map.ot", {"--ply", path("folder.ply")}), {"--ply", "is a folder"});
  expect_refused(map("ours", "ours/recording.yaml"), {"recording.yaml", ".ot"});
  EXPECT_FALSE(fs::exists(path("map.ot")));
}

TEST_F(MapFolder, IntrinsicsOfAnotherSizeAndIdleMasksAreRefused) {
  strip();
  expect_refused(map("theirs", "map.ot",
                     {"--intrinsics", "500,500,320,240", "--classes", path("classes.yaml")}),
                 {"principal point", "(320, 240)", "64 x 48"});
  expect_refused(map("ours", "map.ot", {"--masks", "classes"}), {"--masks", "instance ids"});
  expect_refused(map("ours", "map.ot", {"--K", "1"}), {"--K"});
}

TEST_F(MapFolder, AMapOfNothingIsNoted) {
  strip();
  write_text(path("classes.yaml"), "classes: [{name: cup, label: 77}]\n");
  const Outcome outcome = mapscore({"map", path("theirs"), "-o", path("map.ot"), "--intrinsics",
                                    path("cameras.yaml"), "--classes", path("classes.yaml")});
  expect_done(outcome);
  EXPECT_THAT(outcome.err, ::testing::HasSubstr("the map has no voxel"));
}

TEST_F(MapFolder, WhatIsMissingIsSaid) {
  strip();
  expect_refused(map("theirs", "map.ot"), {"recording.yaml", "--intrinsics"});
  expect_refused(map("theirs", "map.ot", {"--intrinsics", "50,50,32,24"}), {"--classes"});
  expect_refused(map("theirs", "map.ot", {"--intrinsics", "50,50,32", "--classes", "c.yaml"}),
                 {"fx,fy,cx,cy"});
  expect_refused(map("nowhere", "map.ot"), {"no such folder"});
  fs::remove(fs::path(path("theirs")) / "label/000001.png");
  expect_refused(map("theirs", "map.ot", described()), {"label/000001.png", "missing"});
  EXPECT_FALSE(fs::exists(path("map.ot")));
}

TEST_F(MapFolder, FramesWithoutPartnersAreCounted) {
  strip();
  const fs::path list = fs::path(path("theirs")) / "depth.txt";
  std::string text = bytes_of(list);
  text.erase(text.rfind('\n', text.size() - 2) + 1);
  write_text(list, text);
  const Outcome outcome = map("theirs", "map.ot", described());
  expect_done(outcome);
  EXPECT_THAT(outcome.out, ::testing::HasSubstr("3 of 4 label images mapped; 1 without a depth"));
}

}  // namespace
}  // namespace mapscore::testing
