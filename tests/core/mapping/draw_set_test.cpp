// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/draw_set.hpp"

#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace mapscore {
namespace {

TEST(DrawSet, HoldsTheDrawsWhoseLevelIsAtLeastABound) {
  RandomStream stream(3, "levels");
  DrawLevels levels;
  for (std::uint8_t& level : levels.of) level = static_cast<std::uint8_t>(stream.bits());
  levels.of[0] = 0;
  levels.of[127] = 255;
  for (unsigned least = 0; least < 258; ++least) {
    const DrawSet set = at_least(levels, least);
    std::vector<std::size_t> expected, found;
    for (std::size_t n = 0; n < DrawSet::kMost; ++n) {
      if (levels.of[n] >= least) expected.push_back(n);
      EXPECT_EQ(set.has(n), levels.of[n] >= least) << n;
    }
    for_each_draw(set, [&](std::size_t draw) { found.push_back(draw); });
    EXPECT_EQ(found, expected);
    EXPECT_EQ(set.count(), expected.size());
  }
}

TEST(DrawSet, JoinsMeetsAndTurnsRound) {
  const DrawSet some = DrawSet::of(3) | DrawSet::of(64),
                others = DrawSet::of(64) | DrawSet::of(127);
  EXPECT_EQ((some | others).count(), 3u);
  EXPECT_EQ((some & others).count(), 1u);
  EXPECT_TRUE((some & others).has(64));
  EXPECT_EQ((~some).count(), 126u);
  EXPECT_FALSE((some & ~some).any());
}

}  // namespace
}  // namespace mapscore
