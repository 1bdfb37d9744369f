// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <gmock/gmock.h>

#include <regex>
#include <string>

// All methods side by side, frame by frame, by the built program.

namespace mapscore::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class FrameByFrame : public TinyStudy {
 protected:
  [[nodiscard]] Outcome frames(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"frames", study(),           "-o", results(), "-q",
                                       "--set",  "score.unit=frame"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return mapscore(arguments);
  }
};

TEST_F(FrameByFrame, WritesATableAndAFigureOfItsNumbers) {
  const Outcome outcome = frames({"--format", "csv"});
  expect_done(outcome);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, StartsWith("method,"));
  EXPECT_THAT(outcome.out, HasSubstr("\ndirect,"));
  EXPECT_THAT(outcome.out, HasSubstr("\nerosion,"));
  EXPECT_EQ(outcome.out, bytes_of(path("results/frames/by_method.csv")));
  EXPECT_GT(bytes_of(path("results/frames/by_frame.png")).size(), 5000u);
  EXPECT_THAT(bytes_of(path("results/frames/by_frame.pdf")), StartsWith("%PDF"));
}

TEST_F(FrameByFrame, AMapOfNothingIsDrawnAllTheSame) {
  const Outcome outcome =
      frames({"--set", "faults.labels.miss=1", "--set", "faults.labels.miss_area_px=1000000000"});
  expect_done(outcome);
  EXPECT_THAT(bytes_of(path("results/frames/by_frame.gp")), HasSubstr("direct maps nothing in "));
  EXPECT_GT(bytes_of(path("results/frames/by_frame.png")).size(), 5000u);
}

TEST_F(FrameByFrame, FramesAreThoseOfTrialsThatScoreEachFrame) {
  const Outcome outcome = frames({"--set", "sweep={}", "--set", "seeds=1", "--format", "csv"});
  expect_done(outcome);
  expect_done(mapscore({"sweep", study(), "-o", path("swept"), "-q", "--set", "score.unit=frame",
                        "--set", "sweep={}", "--set", "seeds=1"}));
  const Outcome table = mapscore({"table", path("swept"), "--format", "markdown"});
  expect_done(table);
  // METHOD,precision,recall,F1 begin a row of the one and end a row of the other.
  for (const std::string method : {"direct", "erosion"}) {
    std::smatch row;
    ASSERT_TRUE(std::regex_search(table.out, row,
                                  std::regex(method + " \\| (\\S+) \\| (\\S+) \\| (\\S+) \\|")))
        << table.out;
    const std::string scores = row.str(1) + ',' + row.str(2) + ',' + row.str(3);
    EXPECT_TRUE(std::regex_search(outcome.out, std::regex(method + ",[^\n]*" + scores + "\n")))
        << scores << " in " << outcome.out;
  }
}

TEST_F(FrameByFrame, BadInputIsRefusedInOneLine) {
  expect_refused(frames({"--seed", "2"}), {"seed", "2"});
  expect_refused(frames({"--format", "xml"}), {"--format", "xml"});
  expect_refused(frames({"--set", "seeds=0"}), {"seeds"});
  expect_refused(frames({"--set", "score.unit=map"}), {"score.unit", "frame"});
  expect_refused(mapscore({"frames", path("nothing.yaml")}), {"nothing.yaml"});
  EXPECT_FALSE(std::filesystem::exists(path("results/frames")));
}

}  // namespace
}  // namespace mapscore::testing
