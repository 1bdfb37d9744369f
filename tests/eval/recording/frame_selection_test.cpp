// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/frame_selection.hpp"

#include "core/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::vector<int> of(const char* text, int frame_count) {
  return FrameSelection(text).of(frame_count);
}

TEST(FrameSelection, AllUnlessSaidOtherwise) {
  EXPECT_TRUE(FrameSelection().all());
  EXPECT_THAT(FrameSelection().of(4), ElementsAre(0, 1, 2, 3));
  EXPECT_FALSE(FrameSelection(":").all());
  EXPECT_THAT(of(":", 3), ElementsAre(0, 1, 2));
}

TEST(FrameSelection, SlicesAreThoseOfPython) {
  EXPECT_THAT(of("0:6:2", 6), ElementsAre(0, 2, 4));
  EXPECT_THAT(of("1:4", 6), ElementsAre(1, 2, 3));
  EXPECT_THAT(of("4:", 6), ElementsAre(4, 5));
  EXPECT_THAT(of(":2", 6), ElementsAre(0, 1));
  EXPECT_THAT(of("::4", 6), ElementsAre(0, 4));
  EXPECT_THAT(of("1::3", 6), ElementsAre(1, 4));
  EXPECT_THAT(of("2:3:", 6), ElementsAre(2));
  EXPECT_THAT(of("0:6:2147483647", 6), ElementsAre(0));
}

TEST(FrameSelection, ListsNameEachFrameOnceInTheOrderOfTheRecording) {
  EXPECT_THAT(of("9,3,7", 10), ElementsAre(3, 7, 9));
  EXPECT_THAT(of("5,0:6:5,4:7", 10), ElementsAre(0, 4, 5, 6));
}

TEST(FrameSelection, ComparesWhatWasAskedFor) {
  EXPECT_EQ(FrameSelection("1:3"), FrameSelection("1:3"));
  EXPECT_NE(FrameSelection("1:3"), FrameSelection("1:4"));
  EXPECT_EQ(FrameSelection(), FrameSelection());
  EXPECT_NE(FrameSelection(), FrameSelection(":"));
}

TEST(FrameSelection, RefusesWhatIsNoSelectionNamingThePart) {
  for (const char* text : {"", "x", "1,", ",1", "-1", "+1", "1.5", " 1", "1 ", "1:2:3:4", "1:2:0",
                           "1:2:-1", "1:b", "99999999999"}) {
    EXPECT_THAT([&] { FrameSelection{text}; }, ThrowsMessage<Error>(HasSubstr("first:end:step")))
        << text;
  }
  EXPECT_THAT([] { FrameSelection("3,4x,5"); }, ThrowsMessage<Error>(HasSubstr("'4x'")));
}

TEST(FrameSelection, RefusesFramesBeyondTheRecordingSayingHowManyThereAre) {
  for (const char* text : {"5", "2147483647", "0:6", "5:", "0,1,5", "3:6:2"}) {
    EXPECT_THAT([&] { static_cast<void>(of(text, 5)); },
                ThrowsMessage<Error>(AllOf(HasSubstr("5 frames"), HasSubstr("0 to 4"))))
        << text;
  }
  EXPECT_THAT(of("4", 5), ElementsAre(4));
  EXPECT_THAT(of("0:5", 5), ElementsAre(0, 1, 2, 3, 4));
}

TEST(FrameSelection, RefusesToSelectNothing) {
  for (const char* text : {"3:3", "3:1", ":0", "2:2,4:3"}) {
    EXPECT_THAT([&] { static_cast<void>(of(text, 5)); },
                ThrowsMessage<Error>(AllOf(HasSubstr("none"), HasSubstr("5"))))
        << text;
  }
}

TEST(SpreadOver, TakesFitFramesEvenlyAndInOrder) {
  const auto any = [](int) { return true; };
  const std::vector<int> frames = FrameSelection().of(16);
  EXPECT_THAT(spread_over(frames, 4, any), ElementsAre(0, 4, 8, 12));
  EXPECT_THAT(spread_over({3, 5, 9}, 7, any), ElementsAre(3, 5, 9));
  EXPECT_THAT(spread_over(FrameSelection().of(5), 2, any), ElementsAre(0, 4));
  EXPECT_THAT(spread_over(frames, 4, [](int frame) { return frame % 2 == 1; }),
              ElementsAre(1, 5, 9, 13));
  EXPECT_TRUE(spread_over({}, 4, any).empty());
  EXPECT_TRUE(spread_over(frames, 4, [](int) { return false; }).empty());
}

}  // namespace
}  // namespace mapscore::eval
