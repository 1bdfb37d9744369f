// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/recording_writer.hpp"

#include "core/error.hpp"
#include "eval/recording/recording.hpp"
#include "files/file_bytes.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <limits>
#include <optional>
#include <thread>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;
using mapscore::testing::expect_error;
using mapscore::testing::TemporaryFolder;
using mapscore::testing::tiny_frames;
using mapscore::testing::tiny_info;
using mapscore::testing::tiny_shapes;
using mapscore::testing::write_frame;
using mapscore::testing::write_tiny_recording;

class Writer : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  const fs::path out_ = folder_.path() / "out", partial_ = folder_.path() / "out.partial";
};

TEST_F(Writer, FullDiskIsNoticed) {
  ASSERT_TRUE(fs::exists("/dev/full")) << "Linux has it everywhere";
  expect_error("/dev/full: cannot write (No space left on device)",
               [] { write_file("/dev/full", "a"); });
  expect_error("/dev/full: cannot write (No space left on device)",
               [] { write_file("/dev/full", std::string(1 << 20, 'a')); });
}

TEST_F(Writer, AFailedFrameLeavesNothingBehind) {
  ASSERT_TRUE(fs::exists("/dev/full")) << "Linux has it everywhere";
  {
    RecordingWriter writer(out_, tiny_info());
    fs::create_symlink("/dev/full", partial_ / "depth/000000.png");
    expect_error("depth/000000.png: cannot write (No space left",
                 [&] { write_frame(writer, tiny_frames()[0]); });
    for (const int index : {1, 2, 3})
      write_frame(writer, tiny_frames()[static_cast<std::size_t>(index)]);
    writer.write_shapes(tiny_shapes());
    expect_error("writing depth image 0 failed", [&] { writer.finish(); });
  }
  EXPECT_FALSE(fs::exists(partial_));
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(Writer, WithoutFinishNothingIsLeft) {
  {
    RecordingWriter writer(out_, tiny_info());
    write_frame(writer, tiny_frames()[0]);
    EXPECT_TRUE(fs::exists(partial_ / "color/000000.png"));
  }
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(Writer, ExistingFolderIsRefusedAndKept) {
  fs::create_directory(out_);
  write_file(out_ / "keep", "me");
  expect_error("exists already; remove it or give another folder",
               [&] { RecordingWriter writer(out_, tiny_info()); });
  expect_error("exists already", [&] { RecordingWriter writer(out_ / "", tiny_info()); });
  EXPECT_EQ(read_file(out_ / "keep"), "me");
}

TEST_F(Writer, FolderThatCannotBeMadeIsRefused) {
  write_file(folder_.path() / "file", "");
  expect_error("cannot create the folder",
               [&] { RecordingWriter writer(folder_.path() / "file/out", tiny_info()); });
}

TEST_F(Writer, WhatACrashLeftIsReplaced) {
  fs::create_directories(partial_ / "color");
  write_file(partial_ / "color/000099.png", "old");
  write_tiny_recording(out_ / "");  // the closing slash must not put the partial folder inside
  EXPECT_FALSE(fs::exists(out_ / "color/000099.png"));
  EXPECT_FALSE(fs::exists(partial_));
  EXPECT_EQ(Recording::open(out_).frame_count(), 4);
}

TEST_F(Writer, ASecondWriterOfTheSameFolderIsRefusedAndHarmsNothing) {
  {
    RecordingWriter first(out_, tiny_info());
    write_frame(first, tiny_frames()[0]);
    expect_error("out: another process is writing it; wait for it",
                 [&] { RecordingWriter second(out_, tiny_info()); });
    EXPECT_TRUE(fs::exists(partial_ / "color/000000.png"));
    for (const int index : {1, 2, 3})
      write_frame(first, tiny_frames()[static_cast<std::size_t>(index)]);
    first.write_shapes(tiny_shapes());
    first.finish();
  }
  EXPECT_EQ(Recording::open(out_).frame_count(), 4);
  expect_error("exists already", [&] { RecordingWriter third(out_, tiny_info()); });
}

TEST_F(Writer, OfTwoThatStartAtOnceOneWrites) {
  for (int round = 0; round < 500; ++round) {
    std::atomic<int> winners = 0;
    std::barrier together(2);
    const auto start = [&] {
      std::optional<RecordingWriter> writer;
      together.arrive_and_wait();
      try {
        writer.emplace(out_, tiny_info());
        ++winners;
      } catch (const Error&) {  // the loser's refusal
      }
      together.arrive_and_wait();  // both hold what they have
    };
    std::jthread other(start);
    start();
    other.join();
    ASSERT_EQ(winners, 1) << "round " << round;
  }
}

TEST_F(Writer, ALinkInThePlaceOfThePartialFolderIsNotWrittenThrough) {
  const fs::path elsewhere = folder_.path() / "elsewhere";
  fs::create_directory(elsewhere);
  write_file(elsewhere / "keep", "me");
  fs::create_directory_symlink(elsewhere, partial_);
  write_tiny_recording(out_);
  EXPECT_EQ(read_file(elsewhere / "keep"), "me");
  EXPECT_EQ(std::distance(fs::directory_iterator(elsewhere), {}), 1);
}

TEST_F(Writer, MissingParentFoldersAreMade) {
  write_tiny_recording(folder_.path() / "a/b/c");
  EXPECT_EQ(Recording::open(folder_.path() / "a/b/c").frame_count(), 4);
}

TEST_F(Writer, ThreadsAndOrderDoNotChangeTheBytes) {
  write_tiny_recording(folder_.path() / "in_order");
  RecordingWriter writer(out_, tiny_info());
  writer.write_shapes(tiny_shapes());
  {
    std::vector<std::jthread> threads;
    for (int i = 3; i >= 0; --i)
      threads.emplace_back(
          [&writer, i] { write_frame(writer, tiny_frames()[static_cast<std::size_t>(i)]); });
  }
  writer.finish();
  for (const auto& entry : fs::recursive_directory_iterator(out_)) {
    if (!entry.is_regular_file()) continue;
    const fs::path other = folder_.path() / "in_order" / fs::relative(entry.path(), out_);
    EXPECT_EQ(read_file(entry.path()), read_file(other)) << other;
  }
  EXPECT_EQ(Recording::open(out_).content_hash(),
            Recording::open(folder_.path() / "in_order").content_hash());
}

TEST_F(Writer, FrameCountIsThatOfTheFramesWritten) {
  RecordingInfo info = tiny_info();
  info.frame_count = 0;
  RecordingWriter writer(out_, info);
  writer.write_shapes(tiny_shapes());
  for (int i : {0, 1}) write_frame(writer, tiny_frames()[static_cast<std::size_t>(i)]);
  writer.finish();
  EXPECT_EQ(Recording::open(out_).info().frame_count, 2);
}

TEST_F(Writer, FinishRefusesWhatIsNotWhole) {
  const std::vector<Frame> frames = tiny_frames();
  RecordingInfo info = tiny_info();
  info.frame_count = 0;
  RecordingWriter writer(out_, info);
  expect_error("no frames were written", [&] { writer.finish(); });
  write_frame(writer, frames[0]);
  expect_error("surfaces were not written", [&] { writer.finish(); });
  writer.write_shapes(tiny_shapes());
  write_frame(writer, frames[2]);
  expect_error("color images 0 to 2 are not all there", [&] { writer.finish(); });
  Frame late = frames[1];
  late.stamp_s = 1.0;
  write_frame(writer, late);
  expect_error("stamp of color image 2 does not come after", [&] { writer.finish(); });
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(Writer, AnnouncedFramesMustCome) {
  RecordingWriter writer(out_, tiny_info());
  writer.write_shapes(tiny_shapes());
  write_frame(writer, tiny_frames()[0]);
  expect_error("1 frames were written, 4 were announced", [&] { writer.finish(); });
}

TEST_F(Writer, RefusesFramesThatDoNotFit) {
  RecordingWriter writer(out_, tiny_info());
  Frame frame = tiny_frames()[0];
  write_frame(writer, frame);
  expect_error("color image 0 was written twice", [&] { write_frame(writer, frame); });
  frame.index = 1;
  frame.depth = cv::Mat1w(3, 3);
  expect_error("frame 1: depth is 3 x 3, its camera 64 x 48", [&] { write_frame(writer, frame); });
  frame = tiny_frames()[2];
  frame.depth_label.release();
  expect_error("frame 2: depth_label is 0 x 0", [&] { write_frame(writer, frame); });
  frame = tiny_frames()[3];
  frame.T_world_base.translation().x() = std::numeric_limits<double>::infinity();
  expect_error("color image 3: stamp or pose is not finite", [&] { write_frame(writer, frame); });
  std::vector<Shape> shapes = tiny_shapes();
  shapes[0].instance = 3;
  expect_error("instance 3 is not in the class table", [&] { writer.write_shapes(shapes); });
}

}  // namespace
}  // namespace mapscore::eval
