// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/shards.hpp"

#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

TEST(Shards, FoldersAreFoundInOrderAndOtherNamesPassedOver) {
  const mapscore::testing::TemporaryFolder results;
  EXPECT_TRUE(shard_folders(results.path()).empty());
  const auto own = shard_folder(results.path(), 10, 12);
  std::filesystem::create_directories(own);
  for (const char* name : {"2-of-12@b", "2-of-12@a", "1-of-3@a", "0-of-3@a", "4-of-3@a", "1-of-3",
                           "notes", "1-of-x@a"})
    std::filesystem::create_directories(results.path() / "shards" / name);
  std::vector<std::string> names;
  for (const ShardFolder& shard : shard_folders(results.path()))
    names.push_back(shard.folder.filename());
  EXPECT_EQ(names, (std::vector<std::string>{"1-of-3@a", "2-of-12@a", "2-of-12@b",
                                             own.filename().string()}));
  EXPECT_EQ(shard_folders(results.path()).front().host, "a");
  EXPECT_EQ(own.parent_path(), results.path() / "shards");
}

}  // namespace
}  // namespace mapscore::eval
