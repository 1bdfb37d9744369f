// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

namespace mapscore::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

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

TEST_F(TinyTolerance, PrintFlagsWithoutAFigureAreRefused) {
  expect_refused(mapscore({"tolerance", study(), "-o", results(), "--grey"}),
                 {"--grey", "--figure"});
}

TEST_F(TinyTolerance, MakesTheTrialsOfTheStudyAndNoCeilings) {
  expect_done(mapscore({"tolerance", study(), "-o", results(), "-q"}));
  const Outcome info = mapscore({"info", results()});
  expect_done(info);
  EXPECT_THAT(info.out, HasSubstr("trials of `mapscore tolerance`, no study swept, build "));
  expect_refused(mapscore({"table", results()}), {"holds no study, but ", "mapscore sweep"});
  const Outcome trials = mapscore({"trials", results(), "--format", "csv"});
  expect_done(trials);
  EXPECT_THAT(trials.out, HasSubstr("key,role,method,seed,state,faults.misregistration.magnitude_m,"
                                    "reason\n"));
  EXPECT_THAT(trials.out, HasSubstr(",tolerance,erosion,0,done,0,-\n"));
  const auto count = std::ranges::count(trials.out, '\n') - 1;
  const Outcome status = mapscore({"status", results()});
  expect_done(status);
  EXPECT_THAT(status.out,
              AllOf(HasSubstr(fmt::format("{0} of {0} trials of `mapscore tolerance` done", count)),
                    HasSubstr("faults.misregistration.magnitude_m, direct: ")));
  const std::string key = trials.out.substr(trials.out.find('\n') + 1, 12);
  expect_refused(mapscore({"run", results(), "--trial", key}),
                 {"of `mapscore tolerance`", "--method direct --seed 0 --set seeds=1",
                  "--set faults.misregistration.magnitude_m=0`"});
  const Outcome sweep = mapscore({"sweep", study(), "-o", results(), "--set", "seeds=1"});
  expect_done(sweep);
  // Dose zero of both methods is there; the greatest dose had another seed, and there was no
  // lattice ceiling.
  EXPECT_THAT(sweep.err, HasSubstr("3 trials computed, 2 already there"));
  EXPECT_THAT(mapscore({"status", results()}).out,
              AllOf(HasSubstr("5 of 5 trials and ceilings done"), HasSubstr("of `mapscore tol")));
  const Outcome all = mapscore({"trials", results(), "--format", "csv"});
  EXPECT_EQ(std::ranges::count(all.out, '\n'), 1 + count + 3) << "each once";
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
                "--fault", "magnitude_m", "--against", "pose.sigma_xy_m", "--set",
                "sweep={faults.misregistration.magnitude_m: [0, 0.3], faults.pose.sigma_xy_m: [0, "
                "0.1, 0.2]}",
                "--figure", path("figures")});
  expect_done(frontier);
  for (const char* at : {"x and y = 0 mm", "x and y = 100 mm", "x and y = 200 mm"})
    EXPECT_THAT(frontier.out, HasSubstr(at));
  EXPECT_TRUE(std::filesystem::exists(folder() / "figures" / "frontier.png"));
}

// Of the range, spread evenly, all doses but zero would be beyond what the map bears.
TEST_F(TinyTolerance, PlacesTheDosesOfAWideSecondRangeWhereItActs) {
  const std::vector<std::string> command{
      "tolerance",
      study(),
      "-o",
      results(),
      "-q",
      "--method",
      "direct",
      "--loss",
      "0.1",
      "--against",
      "faults.pose.sigma_xy_m",
      "--format",
      "csv",
      "--set",
      "sweep={faults.misregistration.magnitude_m: [0, 0.3], faults.pose.sigma_xy_m: [0, 3]}"};
  const Outcome frontier = mapscore(command);
  expect_done(frontier);
  EXPECT_THAT(frontier.out, HasSubstr("x and y,misregistration = 0 mm,direct,pooled,"));
  std::size_t crossings = 0;
  for (std::size_t at = 0; (at = frontier.out.find(",found,", at)) != std::string::npos; ++at)
    ++crossings;
  EXPECT_GE(crossings, 5U) << frontier.out;
  EXPECT_EQ(mapscore(command).out, frontier.out);
}

TEST_F(TinyTolerance, SaysWhereNothingDetectedIsVisible) {
  replace("tiny/recording.yaml", "instances:\n",
          "  - {id: 3, name: \"lamp\", colour: \"00FF00\", detect: false}\ninstances:\n");
  const std::string note = "tolerance: note: no truth voxel of a detected class was visible";
  const auto search = [&](std::vector<std::string> flags) {
    flags.insert(flags.begin(), {"tolerance", study(), "-o", results(), "-q"});
    const Outcome done = mapscore(flags);
    expect_done(done);
    return done.err;
  };
  EXPECT_THAT(search({"--set", "detect=[lamp]"}), HasSubstr(note));
  EXPECT_THAT(search({"--trials", "24", "--method", "direct"}), Not(HasSubstr(note)));
}

TEST_F(TinyTolerance, RefusesWhatCannotBeSearched) {
  const auto refused = [&](std::vector<std::string> flags, const std::vector<std::string>& words) {
    flags.insert(flags.begin(), {"tolerance", study(), "-o", results(), "-q"});
    expect_refused(mapscore(flags), words);
  };
  refused({"--target", "0.5", "--loss", "0.1"}, {"--loss", "--target"});
  refused({"--fault", "faults.mount.magnitude_m"}, {"--fault faults.mount", "misregistration"});
  refused({"--fault", "magnitude_m", "--set", "sweep.faults.mount.magnitude_m=[0, 0.1]"},
          {"--fault magnitude_m", "write one of faults.misregistration.magnitude_m, faults.mount"});
  refused({"--method", "direct,guess"}, {"--method guess"});
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
