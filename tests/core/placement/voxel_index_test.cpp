// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/placement/voxel_index.hpp"

#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <map>

namespace mapscore {
namespace {

TEST(VoxelIndex, NumbersVoxelsInTheOrderOfTheirFirstAsking) {
  RandomStream stream(1, "voxel_index");
  VoxelIndex index;
  std::map<VoxelKey, std::uint32_t> expected;
  const auto near = [&] { return static_cast<int>(stream.bits() % 60) - 30; };
  for (int n = 0; n < 40000; ++n) {
    VoxelKey key{near(), near(), near()};
    if (n % 10 == 0) key.i += n % 20 == 0 ? (1 << 20) - 31 : -(1 << 20) + 30;
    const auto known = expected.find(key);
    EXPECT_EQ(index.find(pack(key)), known == expected.end() ? VoxelIndex::kNone : known->second);
    if (n % 2 == 0) continue;
    const auto next = static_cast<std::uint32_t>(expected.size());
    EXPECT_EQ(index.number(pack(key)), expected.try_emplace(key, next).first->second);
  }
  ASSERT_EQ(index.keys().size(), expected.size());
  EXPECT_GT(expected.size(), 15000u);
  for (const auto& [key, number] : expected) EXPECT_EQ(unpack(index.keys()[number]), key);
}

}  // namespace
}  // namespace mapscore
