// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <gmock/gmock.h>

namespace mapscore::testing {
namespace {

using ::testing::HasSubstr;

using TinyTolerance = TinyStudy;

TEST_F(TinyTolerance, SearchesEachMethodAndRepeatsForNothing) {
  const std::vector<std::string> command{
      "tolerance", study(), "-o",    results(),
      "--loss",    "0.1",   "--set", "sweep.faults.misregistration.magnitude_m=[0,0.3]"};
  const Outcome first = mapscore(command);
  expect_done(first);
  EXPECT_THAT(first.out, HasSubstr("f1 loses at most 0.1"));
  EXPECT_THAT(first.out, HasSubstr("misregistration  direct   pooled"));
  EXPECT_THAT(first.out, HasSubstr("misregistration  erosion  pooled"));
  EXPECT_THAT(first.err, HasSubstr(", 0 already there"));
  std::vector<std::string> with_figure = command;
  with_figure.insert(with_figure.end(), {"--figure", path("figures"), "--jobs", "1"});
  const Outcome again = mapscore(with_figure);
  expect_done(again);
  EXPECT_EQ(again.out, first.out);
  EXPECT_THAT(again.err, HasSubstr(" 0 trials computed"));
  for (const char* file : {"tolerance.png", "tolerance.pdf", "tolerance.gp", "tolerance.dat"})
    EXPECT_TRUE(std::filesystem::exists(folder() / "figures" / file)) << file;
}

TEST_F(TinyTolerance, MakesTheTrialsOfTheStudyAndNoCeilings) {
  expect_done(mapscore({"tolerance", study(), "-o", results(), "-q"}));
  const Outcome info = mapscore({"info", results()});
  expect_done(info);
  EXPECT_THAT(info.out, HasSubstr("trials of `mapscore tolerance`, no study swept, build "));
  expect_refused(mapscore({"table", results()}), {"holds no study, but ", "mapscore sweep"});
  const Outcome sweep = mapscore({"sweep", study(), "-o", results(), "--set", "seeds=1"});
  expect_done(sweep);
  // Dose zero of both methods is there; the greatest dose had another seed, and there was no
  // lattice ceiling.
  EXPECT_THAT(sweep.err, HasSubstr("3 trials computed, 2 already there"));
}

// An end with more digits than the doses in between: rounded down, no trial would stand at it.
TEST_F(TinyTolerance, TriesTheVeryEndOfTheRange) {
  const Outcome found =
      mapscore({"tolerance", study(), "-o", results(), "-q", "--trials", "24", "--method", "direct",
                "--set", "sweep.faults.misregistration.magnitude_m=[0,0.00012344]"});
  expect_done(found);
  EXPECT_THAT(found.out, HasSubstr("> 0.123 mm"));
}

TEST_F(TinyTolerance, DrawsTheFrontierOfTwoFaults) {
  const Outcome frontier =
      mapscore({"tolerance", study(), "-o", results(), "-q", "--trials", "24", "--method", "direct",
                "--fault", "faults.misregistration.magnitude_m", "--against",
                "faults.pose.sigma_xy_m", "--set",
                "sweep={faults.misregistration.magnitude_m: [0, 0.3], faults.pose.sigma_xy_m: [0, "
                "0.1, 0.2]}",
                "--figure", path("figures")});
  expect_done(frontier);
  for (const char* at : {"x and y = 0 mm", "x and y = 100 mm", "x and y = 200 mm"})
    EXPECT_THAT(frontier.out, HasSubstr(at));
  EXPECT_TRUE(std::filesystem::exists(folder() / "figures" / "frontier.png"));
}

TEST_F(TinyTolerance, RefusesWhatCannotBeSearched) {
  const auto refused = [&](std::vector<std::string> flags, const std::vector<std::string>& words) {
    flags.insert(flags.begin(), {"tolerance", study(), "-o", results(), "-q"});
    expect_refused(mapscore(flags), words);
  };
  refused({"--target", "0.5", "--loss", "0.1"}, {"--loss", "--target"});
  refused({"--fault", "faults.mount.magnitude_m"}, {"--fault faults.mount", "misregistration"});
  refused({"--method", "guess"}, {"--method guess", "direct, erosion"});
  refused({"--group", "wall"}, {"--group wall", "pooled"});
  refused({"--metric", "f9"}, {"f9"});
  refused({"--metric", "accuracy_mean_m"}, {"--metric accuracy_mean_m", "rises"});
  refused({"--against", "faults.misregistration.magnitude_m"}, {"--against", "sweep another"});
  refused({"--reference", "guess"}, {"--reference guess"});
  refused({"--against", "faults.mount.magnitude_m"}, {"--against faults.mount", "misregistration"});
  refused({"--trials", "5"}, {"--trials", "24"});
  refused({"--target", "1.5"}, {"--target 1.5", "lattice ceiling of f1", "pooled"});
  refused({"--set", "sweep={}"}, {"sweep", "--set"});
  refused({"--set", "sweep={faults.misregistration.magnitude_m: [0.01]}"}, {"no range", "least"});
  refused({"--set", "sweep={faults.pose.kind: [white, walk]}"}, {"white is no number"});
}

}  // namespace
}  // namespace mapscore::testing
