// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/folder_lock.hpp"

#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <thread>

namespace mapscore {
namespace {

using mapscore::testing::TemporaryFolder;

TEST(FolderLock, MakesTheFolderAndLeavesNothingInIt) {
  const TemporaryFolder folder;
  const auto locked = folder.path() / "a/b";
  { const FolderLock lock(locked); }
  EXPECT_TRUE(std::filesystem::is_empty(locked));
}

TEST(FolderLock, OnlyOneHoldsIt) {
  const TemporaryFolder folder;
  std::atomic<int> holding{0}, most{0}, turns{0};
  const auto work = [&] {
    for (int i = 0; i < 200; ++i) {
      const FolderLock lock(folder.path());
      most = std::max(most.load(), ++holding);
      std::this_thread::yield();
      --holding;
      ++turns;
    }
  };
  { std::jthread first(work), second(work); }
  EXPECT_EQ(turns, 400);
  EXPECT_EQ(most, 1);
}

TEST(FolderLock, DoesNothingWhereThereCanBeNoFolder) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << "";
  const FolderLock lock(folder.path() / "file");
  const FolderLock below(folder.path() / "file/below");
  EXPECT_TRUE(std::filesystem::is_regular_file(folder.path() / "file"));
}

}  // namespace
}  // namespace mapscore
