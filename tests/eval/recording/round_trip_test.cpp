// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/random_stream.hpp"
#include "eval/recording/info_yaml.hpp"
#include "eval/recording/pose_text.hpp"
#include "eval/recording/recording.hpp"
#include "eval/recording/recording_writer.hpp"
#include "files/file_bytes.hpp"
#include "files/text_rows.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using mapscore::testing::TemporaryFolder;
using mapscore::testing::tiny_frames;
using mapscore::testing::tiny_info;
using mapscore::testing::tiny_shapes;
using mapscore::testing::write_frame;
using mapscore::testing::write_tiny_recording;

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(PoseText, IdentityAndQuarterTurnsComeBackExactly) {
  EXPECT_EQ(numbers_of(Pose::Identity()), (PoseNumbers{0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(pose_of({0, 0, 0, 0, 0, 0, 1})->matrix(), Pose::Identity().matrix());
  const Pose optical = tiny_info().calibration.T_base_depth;
  EXPECT_EQ(pose_of(numbers_of(optical))->matrix(), optical.matrix());
}

TEST(PoseText, AnyPoseComesBackWithin1e15) {
  RandomStream random(5, "poses");
  for (int i = 0; i < 1000; ++i) {
    Vector6 xi;
    for (int axis = 0; axis < 6; ++axis) xi[axis] = 3.0 * random.normal();
    const Pose pose = exp_pose(xi);
    const Pose back = *pose_of(numbers_of(pose));
    EXPECT_LT((back.linear() - pose.linear()).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_EQ(back.translation(), pose.translation());
    EXPECT_GE(numbers_of(pose)[6], 0.0);
  }
}

TEST(PoseText, RoundedQuaternionsAreNormalisedWrongOnesRefused) {
  EXPECT_LT((pose_of({0, 0, 0, 0, 0, 0, 1.0009})->linear() - Eigen::Matrix3d::Identity()).norm(),
            1e-15);
  EXPECT_FALSE(pose_of({0, 0, 0, 0, 0, 0, 1.002}));
  EXPECT_FALSE(pose_of({0, 0, 0, 0, 0, 0, 0}));
}

TEST(PoseText, NumbersAreParsedWhole) {
  EXPECT_EQ(parse_number(join_numbers(std::array{0.1 + 0.2}, " ")), 0.1 + 0.2);
  EXPECT_EQ(parse_number("-1e-3"), -1e-3);
  for (const char* text : {"", "x", "1x", "nan", "inf", "1 2", "1e999"})
    EXPECT_FALSE(parse_number(text)) << text;
}

TEST(InfoYaml, EveryFieldComesBack) {
  RecordingInfo info = tiny_info();
  info.calibration.T_color_depth.linear() = exp_rotation({0.1, 0.2, -0.3});
  info.calibration.color.fx_px = 1.0 / 3.0;
  info.calibration.depth.width_px = 123;
  info.calibration.range_max_m = 7.1;
  info.color_rate_hz = 29.97;
  info.table.classes[1].name = "a \"quoted\" \\ name: #1";
  info.table.instances[2].name = "null: \\ \"it's\"";
  info.seed = ~std::uint64_t{0};
  info.mujoco_version = "4.0.1";
  info.scene_hash = "0123";
  info.has_truth = false;
  const TemporaryFolder folder;
  write_file(folder.path() / "a.yaml", info_text(info));
  const RecordingInfo back = read_info(folder.path() / "a.yaml");
  EXPECT_EQ(info_text(back), info_text(info));
  EXPECT_EQ(back.calibration.color, info.calibration.color);
  EXPECT_EQ(back.calibration.depth, info.calibration.depth);
  EXPECT_TRUE(back.calibration.T_color_depth.isApprox(info.calibration.T_color_depth, 1e-15));
  EXPECT_EQ(back.calibration.T_base_depth.matrix(), info.calibration.T_base_depth.matrix());
  EXPECT_EQ(back.calibration.range_min_m, info.calibration.range_min_m);
  EXPECT_EQ(back.calibration.range_max_m, info.calibration.range_max_m);
  EXPECT_EQ(back.color_rate_hz, info.color_rate_hz);
  EXPECT_EQ(back.depth_rate_hz, info.depth_rate_hz);
  EXPECT_EQ(back.table.classes[1].name, info.table.classes[1].name);
  EXPECT_EQ(back.table.classes[1].colour, info.table.classes[1].colour);
  EXPECT_TRUE(back.table.detected(1));
  EXPECT_FALSE(back.table.detected(2));
  EXPECT_EQ(back.table.instances[2].name, "null: \\ \"it's\"");
  EXPECT_EQ(back.table.class_of(2), 2);
  EXPECT_EQ(back.seed, info.seed);
  EXPECT_EQ(back.scene, info.scene);
  EXPECT_EQ(back.scene_hash, "0123");
  EXPECT_EQ(back.mujoco_version, "4.0.1");
  EXPECT_EQ(back.frame_count, 4);
  EXPECT_FALSE(back.has_truth);
}

TEST(Recording, EveryFrameAndShapeComesBack) {
  const TemporaryFolder folder;
  write_tiny_recording(folder.path() / "tiny");
  const Recording recording = Recording::open(folder.path() / "tiny");
  const std::vector<Frame> written = tiny_frames();
  ASSERT_EQ(recording.frame_count(), 4);
  for (int i = 0; i < 4; ++i) {
    const Frame frame = recording.read(i, {true, true, true, true});
    const Frame& expected = written[static_cast<std::size_t>(i)];
    EXPECT_EQ(frame.index, i);
    EXPECT_EQ(frame.stamp_s, expected.stamp_s);
    EXPECT_LT((frame.T_world_base.matrix() - expected.T_world_base.matrix()).cwiseAbs().maxCoeff(),
              1e-15);
    EXPECT_TRUE(same(frame.color, expected.color));
    EXPECT_TRUE(same(frame.label, expected.label));
    EXPECT_TRUE(same(frame.depth, expected.depth));
    EXPECT_TRUE(same(frame.depth_label, expected.depth_label));
  }
  const std::vector<Shape> shapes = recording.read_shapes();
  ASSERT_EQ(shapes.size(), tiny_shapes().size());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    EXPECT_EQ(shapes[i].name, tiny_shapes()[i].name);
    EXPECT_EQ(shapes[i].size, tiny_shapes()[i].size);
  }
}

TEST(Recording, ReadsOnlyTheChannelsAskedFor) {
  const TemporaryFolder folder;
  write_tiny_recording(folder.path() / "tiny");
  const Frame frame = Recording::open(folder.path() / "tiny").read(1);
  EXPECT_TRUE(frame.color.empty());
  EXPECT_TRUE(frame.depth_label.empty());
  EXPECT_FALSE(frame.label.empty());
  EXPECT_FALSE(frame.depth.empty());
}

TEST(Recording, FileNamesAreThoseOfTum) {
  const TemporaryFolder folder;
  write_tiny_recording(folder.path() / "tiny");
  const std::string colors = read_file(folder.path() / "tiny/color.txt");
  EXPECT_EQ(colors, read_file(folder.path() / "tiny/rgb.txt"));
  EXPECT_THAT(colors, ::testing::HasSubstr("\n0 color/000000.png\n0.5 color/000001.png\n"));
  EXPECT_THAT(read_file(folder.path() / "tiny/groundtruth.txt"),
              ::testing::HasSubstr("\n0 0 -0.15 0 0 0 0.0199986"));
}

TEST(Recording, ContentHashFollowsContentNotPlace) {
  const TemporaryFolder folder;
  const auto a = folder.path() / "a", b = folder.path() / "b";
  write_tiny_recording(a);
  std::filesystem::copy(a, b, std::filesystem::copy_options::recursive);
  const std::string hash = Recording::open(a).content_hash();
  EXPECT_EQ(hash.size(), 32u);
  EXPECT_EQ(Recording::open(b).content_hash(), hash);
  std::filesystem::remove(b / "hashes.txt");
  EXPECT_EQ(Recording::open(b).content_hash(), hash);
  std::filesystem::copy_file(b / "label/000001.png", b / "label/000002.png",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_NE(Recording::open(b).content_hash(), hash);
  write_file(a / "truth/shapes.csv",
             read_file(a / "truth/shapes.csv") + "sphere,0,,0,0,0,0,0,0,1,0.5,0,0\n");
  EXPECT_NE(Recording::open(a).content_hash(), hash);
}

TEST(Recording, PairsEachColourImageWithTheDepthImageNearestInTime) {
  const TemporaryFolder folder;
  const auto tiny = folder.path() / "tiny";
  write_tiny_recording(tiny);
  // Colour at 0, 0.5, 1, 1.5; depth at 0.25 (tie of the first two), 0.75 (tie), 1.4, 9.
  write_file(
      tiny / "depth.txt",
      "0.25 depth/000000.png\n0.75 depth/000001.png\n1.4 depth/000002.png\n9 depth/000003.png\n");
  write_file(tiny / "groundtruth.txt",
             "0.25 1 0 0 0 0 0 1\n0.75 2 0 0 0 0 0 1\n1.4 3 0 0 0 0 0 1\n9 4 0 0 0 0 0 1\n");
  const Recording recording = Recording::open(tiny);
  const std::vector<double> stamps{0.25, 0.25, 0.75, 1.4}, positions{1, 1, 2, 3};
  for (int i = 0; i < 4; ++i) {
    const Frame frame = recording.read(i);
    EXPECT_EQ(frame.stamp_s, stamps[static_cast<std::size_t>(i)]);
    EXPECT_EQ(frame.T_world_base.translation().x(), positions[static_cast<std::size_t>(i)]);
    EXPECT_TRUE(same(frame.depth, tiny_frames()[std::lround(positions[i]) - 1].depth));
    EXPECT_TRUE(same(frame.label, tiny_frames()[static_cast<std::size_t>(i)].label));
  }
}

TEST(Recording, HoldsColourAndDepthAtRatesOfTheirOwn) {
  const TemporaryFolder folder;
  const std::vector<Frame> frames = tiny_frames();
  {
    RecordingInfo info = tiny_info();
    info.frame_count = 2;
    RecordingWriter writer(folder.path() / "rates", info);
    for (const int i : {1, 0}) {  // colour at 0 and 1.5 s
      Frame color = frames[static_cast<std::size_t>(3 * i)];
      color.index = i;
      writer.write_color(color);
    }
    for (const int i : {2, 0, 1}) {  // depth at 0, 0.5 and 1 s
      Frame depth = frames[static_cast<std::size_t>(i)];
      depth.depth_index = i;
      writer.write_depth(depth);
    }
    writer.write_shapes(tiny_shapes());
    writer.finish();
  }
  const Recording recording = Recording::open(folder.path() / "rates");
  EXPECT_EQ(recording.frame_count(), 2);
  EXPECT_EQ(recording.depth_count(), 3);
  EXPECT_EQ(recording.depth_of(1), 2);
  EXPECT_EQ(recording.depth_of(1, -0.8), 1);
  EXPECT_EQ(recording.depth_of(1, -99.0), 0);
  EXPECT_EQ(recording.T_world_base_of_color(1).matrix(), frames[3].T_world_base.matrix());
  const Frame frame = recording.read(1, 1);
  EXPECT_EQ(frame.index, 1);
  EXPECT_EQ(frame.depth_index, 1);
  EXPECT_EQ(frame.stamp_s, 0.5);
  EXPECT_TRUE(same(frame.label, frames[3].label));
  EXPECT_TRUE(same(frame.depth, frames[1].depth));
  testing::expect_error("no depth image 3; the recording has 0 to 2",
                        [&] { (void)recording.read(0, 3); });
}

TEST(Trajectory, IsInterpolatedBetweenItsLinesAndExactOnThem) {
  std::vector<TrajectoryPose> lines{{1.0, planar_pose(1, 2, 0)}, {3.0, planar_pose(3, 0, 1.2)}};
  EXPECT_EQ(interpolated(lines, 3.0)->matrix(), lines[1].T_world_base.matrix());
  EXPECT_TRUE(interpolated(lines, 1.5)->isApprox(planar_pose(1.5, 1.5, 0.3), 1e-12));
  EXPECT_FALSE(interpolated(lines, 0.999));
  EXPECT_FALSE(interpolated(lines, 3.001));
}

TEST(Recording, WithoutTruthItIsReadButGivesNone) {
  const TemporaryFolder folder;
  RecordingInfo info = tiny_info();
  info.has_truth = false;
  RecordingWriter writer(folder.path() / "real", info);
  for (Frame frame : tiny_frames()) {
    frame.depth_label.release();
    write_frame(writer, frame);
  }
  writer.finish();
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "real/truth"));
  const Recording recording = Recording::open(folder.path() / "real");
  EXPECT_TRUE(same(recording.read(2).depth, tiny_frames()[2].depth));
  testing::expect_error("without truth", [&] { (void)recording.read_shapes(); });
  testing::expect_error("without truth", [&] { (void)recording.read(0, {.depth_label = true}); });
}

}  // namespace
}  // namespace mapscore::eval
