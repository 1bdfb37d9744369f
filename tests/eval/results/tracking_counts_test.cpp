// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/tracking_counts.hpp"

#include "eval/results/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

/// An image of every verdict, but two of lost.
VisualTrajectory one_of_each() {
  VisualTrajectory visual;
  for (std::size_t n = 0; n < names_of(Tracking{}).size(); ++n)
    visual.steps.push_back({.tracking = static_cast<Tracking>(n)});
  visual.steps.push_back({.tracking = Tracking::lost});
  visual.loops = 3;
  return visual;
}

TEST(TrackingCounts, EveryImageIsCountedOnceUnderItsVerdict) {
  const TrackingCounts counts = TrackingCounts::of(one_of_each());
  EXPECT_EQ(counts, (TrackingCounts{1, 1, 1, 1, 1, 1, 2, 1, 1, 3}));
  EXPECT_EQ(counts.images(), 10);
  EXPECT_EQ(counts.untracked(), 6) << "unsure, blind, two lost, restarted, relocated";
}

TEST(TrackingCounts, GuessesAreNamedThatAreThere) {
  EXPECT_THAT(TrackingCounts::of(one_of_each()).untracked_names(),
              ::testing::ElementsAre("images_unsure", "images_blind", "images_lost",
                                     "images_restarted", "images_relocated"));
  EXPECT_THAT((TrackingCounts{.images_tracked = 40, .images_blind = 2}.untracked_names()),
              ::testing::ElementsAre("images_blind"));
}

TEST(TrackingCounts, TextNamesWhatIsThere) {
  TrackingCounts counts{.images_started = 1, .images_tracked = 40, .images_lost = 2};
  EXPECT_EQ(counts.text(), "1 started, 40 tracked, 2 lost of 43 depth images; 0 loops closed");
}

TEST(TrackingCounts, AddUpOverTrials) {
  Accounting total, tracked;
  total.frames = 2;
  tracked.frames = 3;
  tracked.frames_left_out = 1;
  tracked.tracking = TrackingCounts::of(one_of_each());
  total += tracked;
  EXPECT_EQ(total.frames, 5);
  EXPECT_EQ(total.frames_left_out, 1);
  total += Accounting{};
  EXPECT_EQ(total.tracking, tracked.tracking);
  total += tracked;
  EXPECT_EQ(total.tracking->images_lost, 4);
  EXPECT_EQ(total.tracking->loops_closed, 6);
}

}  // namespace
}  // namespace mapscore::eval
