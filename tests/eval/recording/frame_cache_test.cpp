// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/frame_cache.hpp"

#include "files/file_bytes.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <functional>
#include <thread>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using mapscore::testing::TemporaryFolder;
using mapscore::testing::tiny_frames;
using mapscore::testing::write_tiny_recording;

constexpr std::size_t kFrameBytes = 2 * 64 * 48 * 2;  // label and depth
constexpr std::size_t kPlenty = 1 << 30;
constexpr int kThreads = 4;

class Cache : public ::testing::Test {
 protected:
  Cache() { write_tiny_recording(tiny_); }

  /// Runs `body` on several threads that start together.
  static void together(const std::function<void(int)>& body) {
    std::barrier start(kThreads);
    std::vector<std::jthread> threads;
    for (int t = 0; t < kThreads; ++t)
      threads.emplace_back([&, t] {
        start.arrive_and_wait();
        body(t);
      });
  }

  TemporaryFolder folder_;
  const std::filesystem::path tiny_ = folder_.path() / "tiny";
};

TEST_F(Cache, GivesTheFramesOfTheRecording) {
  FrameCache cache(Recording::open(tiny_), {}, kPlenty);
  const auto frame = cache.get(2);
  EXPECT_EQ(frame->index, 2);
  EXPECT_EQ(cv::norm(frame->depth, tiny_frames()[2].depth, cv::NORM_INF), 0.0);
  EXPECT_TRUE(frame->color.empty());
  EXPECT_EQ(cache.get(2)->label.data, frame->label.data);
  EXPECT_EQ(cache.get(2)->depth.data, frame->depth.data);
  EXPECT_EQ(cache.decoded(), 2);
  EXPECT_EQ(cache.bytes(), kFrameBytes);
}

TEST_F(Cache, StaysWithinItsBytesAndDropsTheLeastRecentlyUsed) {
  FrameCache cache(Recording::open(tiny_), {}, 2 * kFrameBytes + 1);
  for (const int index : {0, 1, 0, 2}) (void)cache.get(index);  // 2 pushes 1 out, not 0
  EXPECT_EQ(cache.bytes(), 2 * kFrameBytes);
  EXPECT_EQ(cache.decoded(), 6);
  (void)cache.get(0);
  (void)cache.get(2);
  EXPECT_EQ(cache.decoded(), 6);
  (void)cache.get(1);
  EXPECT_EQ(cache.decoded(), 8);
  EXPECT_EQ(cache.bytes(), 2 * kFrameBytes);
}

TEST_F(Cache, AFrameLargerThanTheCacheIsGivenAndNotKept) {
  FrameCache cache(Recording::open(tiny_), {}, kFrameBytes / 2 - 1);
  const auto frame = cache.get(0);
  EXPECT_EQ(cache.bytes(), 0u);
  EXPECT_EQ(frame->index, 0);
  EXPECT_FALSE(frame->depth.empty());
}

TEST_F(Cache, ThreadsThatAskTogetherShareOneDecoding) {
  const Recording recording = Recording::open(tiny_);
  for (int round = 0; round < 20; ++round) {
    FrameCache cache(recording, {true, true, true, true}, kPlenty);
    std::array<std::shared_ptr<const Frame>, kThreads> got;
    together([&](int t) {
      for (int index = 0; index < 4; ++index) got[static_cast<std::size_t>(t)] = cache.get(index);
    });
    EXPECT_EQ(cache.decoded(), 8);
    for (const auto& frame : got) {
      EXPECT_EQ(frame->color.data, got[0]->color.data);
      EXPECT_EQ(frame->depth_label.data, got[0]->depth_label.data);
    }
  }
}

TEST_F(Cache, ManyThreadsInASmallCacheStayWithinItsBytes) {
  FrameCache cache(Recording::open(tiny_), {}, kFrameBytes);
  std::atomic<bool> within{true}, right{true};
  together([&](int t) {
    for (int i = 0; i < 100; ++i) {
      const int index = (i * (t + 1)) % 4;
      if (cache.get(index)->index != index) right = false;
      if (cache.bytes() > kFrameBytes) within = false;
    }
  });
  EXPECT_TRUE(within);
  EXPECT_TRUE(right);
}

TEST_F(Cache, AnErrorReachesEveryoneAndIsForgotten) {
  FrameCache cache(Recording::open(tiny_), {}, kPlenty);
  const std::string image = read_file(tiny_ / "depth/000001.png");
  write_file(tiny_ / "depth/000001.png", image.substr(0, 50));
  std::atomic<int> errors{0};
  together([&](int) {
    try {
      (void)cache.get(1);
    } catch (const Error&) {
      ++errors;
    }
  });
  EXPECT_EQ(errors, kThreads);
  EXPECT_EQ(cache.bytes(), kFrameBytes / 2);  // the colour side
  expect_error("depth/000001.png", [&] { (void)cache.get(1); });
  write_file(tiny_ / "depth/000001.png", image);
  EXPECT_EQ(cache.get(1)->index, 1);
  EXPECT_EQ(cache.decoded(), 2);
}

TEST_F(Cache, PairsAFrameWithAnotherDepthImage) {
  FrameCache cache(Recording::open(tiny_), {true, true, true, true}, kPlenty);
  const auto own = cache.get(1), later = cache.get(1, 2), next = cache.get(2);
  EXPECT_EQ(later->index, 1);
  EXPECT_EQ(later->depth_index, 2);
  EXPECT_EQ(later->stamp_s, next->stamp_s);
  EXPECT_TRUE(later->T_world_base.isApprox(next->T_world_base, 0.0));
  EXPECT_EQ(later->color.data, own->color.data);
  EXPECT_EQ(later->label.data, own->label.data);
  EXPECT_EQ(later->depth.data, next->depth.data);
  EXPECT_EQ(later->depth_label.data, next->depth_label.data);
  EXPECT_EQ(cache.decoded(), 4);
}

}  // namespace
}  // namespace mapscore::eval
