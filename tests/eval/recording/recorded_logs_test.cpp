// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/recording.hpp"
#include "eval/recording/recording_writer.hpp"
#include "files/file_bytes.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/mutations.hpp"
#include "tests/support/tiny_recording.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

namespace mapscore::eval {
namespace {

using testing::expect_error;

constexpr std::uint64_t kMutations = 600;

std::vector<OdometryPose> odometry() {
  std::vector<OdometryPose> poses;
  for (int i = 0; i <= 75; ++i)
    poses.push_back({i / 50.0, planar_pose(0.008 * i, 0.001 * i, 0.01 * i)});
  return poses;
}

ScanLog scans() {
  ScanLog log{{-3.0, 0.5, 0.15, 12.0, planar_pose(0.1, 0.0, 0.0)}, {}};
  for (int i = 0; i <= 15; ++i)
    log.scans.push_back(
        {i / 10.0,
         {1.0f + 0.1f * static_cast<float>(i), 0.0f, std::numeric_limits<float>::infinity()}});
  return log;
}

/// Tiny recordings, with or without the logs of a drive.
class RecordedLogs : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path write(const std::string& name, bool with_odometry,
                                            bool with_scans) const {
    const std::filesystem::path folder = own_.path() / name;
    RecordingWriter writer(folder, testing::tiny_info());
    for (const Frame& frame : testing::tiny_frames()) testing::write_frame(writer, frame);
    writer.write_shapes(testing::tiny_shapes());
    if (with_odometry) writer.write_odometry(odometry());
    if (with_scans) writer.write_scans(scans());
    writer.finish();
    return folder;
  }

  static void expect_read_or_refused(const std::filesystem::path& folder, const char* name) {
    const std::string whole = read_file(folder / name);
    const auto tally = testing::read_mutations(whole, kMutations, [&](const std::string& bytes) {
      write_file(folder / name, bytes);
      const Recording recording = Recording::open(folder);
      (void)recording.read_odometry();
      (void)recording.read_scans();
    });
    EXPECT_GT(tally.refused, static_cast<int>(kMutations) / 4);
  }

  /// Replaces a line of odometry.txt, counted from 0, the comment, and reads it.
  static void expect_refused_line(const std::filesystem::path& folder, const std::string& from,
                                  const std::string& to, const std::string& part) {
    const std::string whole = read_file(folder / "odometry.txt");
    const std::size_t at = whole.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    std::string text = whole;
    write_file(folder / "odometry.txt", text.replace(at, from.size(), to));
    expect_error(part, [&] { (void)Recording::open(folder).read_odometry(); });
    write_file(folder / "odometry.txt", whole);
  }

  testing::TemporaryFolder own_;
};

TEST_F(RecordedLogs, ComeBackBitForBit) {
  const Recording recording = Recording::open(write("both", true, true));
  ASSERT_TRUE(recording.has_odometry());
  ASSERT_TRUE(recording.has_scans());
  const auto poses = recording.read_odometry();
  ASSERT_EQ(poses.size(), odometry().size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(poses[i].stamp_s, odometry()[i].stamp_s);
    EXPECT_TRUE(poses[i].T_odom_base.isApprox(odometry()[i].T_odom_base, 1e-14));
  }
  const ScanLog log = recording.read_scans();
  ASSERT_EQ(log.scans.size(), 16u);
  EXPECT_EQ(log.scans[7].ranges_m, scans().scans[7].ranges_m);
}

TEST_F(RecordedLogs, ArePartOfTheHashAndNothingElseIs) {
  const auto hash_of_folder = [](const std::filesystem::path& folder) {
    return Recording::open(folder).content_hash();
  };
  const auto none = write("none", false, false), both = write("both", true, true);
  const std::string bare = hash_of_folder(none);
  EXPECT_NE(bare, hash_of_folder(write("odometry", true, false)));
  EXPECT_NE(bare, hash_of_folder(write("scans", false, true)));
  // what nobody announced is no part of a recording
  write_file(none / "odometry.txt", "0 1 2 3 0 0 0 1\n");
  write_file(none / "localization.txt", "anything");
  EXPECT_EQ(bare, hash_of_folder(none));
  EXPECT_FALSE(Recording::open(none).has_odometry());
  const std::string with_logs = hash_of_folder(both);
  write_file(both / "localization.txt", "anything");
  EXPECT_EQ(with_logs, hash_of_folder(both));
  std::string bytes = read_file(both / "scan/scans.bin");
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  write_file(both / "scan/scans.bin", bytes);
  EXPECT_NE(with_logs, hash_of_folder(both));
}

TEST_F(RecordedLogs, ThatAreNotThereAreRefusedInOneLine) {
  const Recording none = Recording::open(write("none", false, false));
  expect_error("the recording has no odometry; record a drive with trajectory.drive: wheels",
               [&] { (void)none.read_odometry(); });
  expect_error("the recording has no scans", [&] { (void)none.read_scans(); });
  const auto both = write("both", true, true);
  for (const char* file : {"odometry.txt", "scan/scans.bin"}) {
    const std::string bytes = read_file(both / file);
    std::filesystem::remove(both / file);
    expect_error(std::string(file) + ": file is missing, which recording.yaml announces",
                 [&] { (void)Recording::open(both); });
    write_file(both / file, bytes);
  }
}

TEST_F(RecordedLogs, EveryMutationIsReadOrRefused) {
  const auto folder = write("damaged", true, true);
  expect_read_or_refused(folder, "odometry.txt");
  write_file(folder / "odometry.txt", odometry_text(odometry()));
  expect_read_or_refused(folder, "scan/scans.bin");
}

TEST_F(RecordedLogs, TruncatedDisorderedOrTwistedAreRefused) {
  const auto folder = write("damaged", true, true);
  const std::string whole = read_file(folder / "odometry.txt");
  const std::size_t last_number = whole.rfind(' ');  // fewer digits of it are a number, too
  for (std::size_t length = 0; length <= last_number; length += 7) {
    write_file(folder / "odometry.txt", whole.substr(0, length));
    EXPECT_THROW((void)Recording::open(folder).read_odometry(), Error) << length;
  }
  write_file(folder / "odometry.txt", whole);
  expect_refused_line(folder, "\n0.02 ", "\n0.2 ",
                      "odometry.txt:4: stamp 0.04 does not come after");
  expect_refused_line(folder, "\n0 0 0 0 0 0 0 1\n", "\n0 0 0 0 0 0 0 2\n",
                      "odometry.txt:2: quaternion qx qy qz qw is not of length 1");
  expect_refused_line(folder, "\n0 0 0 0 0 0 0 1\n", "\n0 1e300 0 0 0 0 0 1\n",
                      "odometry.txt:2: a position of more than 1e9 m");
  expect_refused_line(folder, "\n0 0 0 0 0 0 0 1\n", "\n",
                      "75 lines, recording.yaml says odometry_count 76");
  ScanLog fewer = scans();
  fewer.scans.pop_back();
  write_file(folder / "scan/scans.bin", scan_log_bytes(fewer));
  expect_error("15 lines, recording.yaml says scan_count 16",
               [&] { (void)Recording::open(folder).read_scans(); });
}

TEST_F(RecordedLogs, TruthBetweenTheImagesIsKept) {
  const std::filesystem::path folder = own_.path() / "between";
  RecordingWriter writer(folder, testing::tiny_info());
  const std::vector<Frame> frames = testing::tiny_frames();
  for (const Frame& frame : frames) testing::write_frame(writer, frame);
  writer.write_shapes(testing::tiny_shapes());
  const Pose aside = planar_pose(3.0, -1.0, 0.4);
  writer.add_poses({{frames[0].stamp_s, aside}, {frames[0].stamp_s + 0.1, aside}});
  writer.finish();
  const Recording recording = Recording::open(folder);
  EXPECT_TRUE(recording.T_world_base(0).isApprox(frames[0].T_world_base, 1e-12));  // the image's
  ASSERT_TRUE(recording.T_world_base_at(frames[0].stamp_s + 0.1));
  EXPECT_TRUE(recording.T_world_base_at(frames[0].stamp_s + 0.1)->isApprox(aside, 1e-12));
  EXPECT_FALSE(recording.T_world_base_at(frames.back().stamp_s + 0.1));
}

}  // namespace
}  // namespace mapscore::eval
