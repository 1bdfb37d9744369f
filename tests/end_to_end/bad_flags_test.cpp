// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

namespace mapscore::testing {
namespace {

using BadFlags = TinyStudy;

TEST_F(BadFlags, NoVerbOrAnUnknownOne) {
  expect_refused(mapscore({}), {"subcommand is required"});
  expect_refused(mapscore({"swep", study()}), {"swep", "sweep"});
}

TEST_F(BadFlags, UnknownOrMissing) {
  expect_refused(mapscore({"sweep"}), {"STUDY is required", "--help"});
  expect_refused(mapscore({"sweep", study(), "--frobnicate"}), {"--frobnicate", "--help"});
  expect_refused(mapscore({"check", results()}), {"--baseline is required", "--help"});
  expect_refused(mapscore({"trial", study(), "-o", path("trial"), "--memory", "1GiB"}),
                 {"--memory", "--help"});
}

TEST_F(BadFlags, OfTheWrongTypeOrOutOfRange) {
  expect_refused(mapscore({"sweep", study(), "--jobs", "0"}), {"--jobs", "1 to 1024"});
  expect_refused(mapscore({"sweep", study(), "--jobs", "two"}), {"--jobs", "1 to 1024"});
  expect_refused(mapscore({"sweep", study(), "--memory", "lots"}), {"--memory", "lots"});
  expect_refused(mapscore({"sweep", study(), "-o", results(), "--shard", "3/2"}),
                 {"--shard 3/2", "e.g. 2/4"});
  expect_refused(mapscore({"truth", path("tiny"), "-o", path("t.csv"), "--voxel_m", "-0.05"}),
                 {"--voxel_m"});
  expect_refused(mapscore({"truth", path("tiny"), "-o", path("t.txt")}), {"t.txt", ".csv or .ply"});
}

TEST_F(BadFlags, NotANumberOrNegative) {
  expect_refused(mapscore({"check", results(), "--baseline", path("b.csv"), "--allow", "nan"}),
                 {"--allow", "0 to 1"});
  expect_refused(mapscore({"score", path("m.csv"), "--truth", path("tiny"), "--threshold", "nan"}),
                 {"--threshold", "0 to 1"});
  expect_refused(mapscore({"sweep", study(), "--memory", "-5"}), {"--memory", "negative"});
}

TEST_F(BadFlags, OverridesThatAreWrong) {
  expect_refused(mapscore({"sweep", study(), "--set", "voxel_m"}), {"voxel_m", "path=value"});
  expect_refused(mapscore({"sweep", study(), "--set", "voxel=1"}), {"voxel", "voxel_m"});
  expect_refused(mapscore({"sweep", study(), "--set", "voxel_m=nan"}), {"voxel_m", "finite"});
  expect_refused(mapscore({"run", study(), "-o", results(), "--seed", "2"}), {"seed 2", "0 to 1"});
  expect_refused(mapscore({"run", study(), "-o", results(), "--method", "guess"}),
                 {"'guess'", "direct erosion"});
  expect_refused(mapscore({"record", study(), "-o", path("new"), "--set", "scene=study.yaml"}),
                 {"recording: `record` renders", "leave it out"});
}

TEST_F(BadFlags, FilesThatAreNotThere) {
  expect_refused(mapscore({"sweep", path("no.yaml")}), {"no.yaml", "give the path"});
  expect_refused(mapscore({"info", path("nothing")}), {"nothing", "no such file"});
  expect_refused(mapscore({"truth", path("nothing"), "-o", path("t.csv")}), {"nothing", "give"});
  expect_refused(mapscore({"score", path("no.csv"), "--truth", path("tiny")}),
                 {"no.csv", "check that the file is there"});
}

TEST_F(BadFlags, ANearNameIsSuggested) {
  const std::string meant = "did you mean '" + path("tiny") + "'?";
  expect_refused(mapscore({"info", path("tinny")}), {"no such file or folder", meant});
  expect_refused(mapscore({"map", path("tin"), "-o", path("m.ot")}), {"no such folder", meant});
  expect_refused(mapscore({"table", path("tinny/results")}), {"no result store there", meant});
  expect_refused(mapscore({"sweep", study().substr(0, study().size() - 1), "-o", results()}),
                 {"cannot be read", "did you mean '" + study() + "'?"});
  expect_refused(mapscore({"score", path("tiny/color.tx"), "--truth", path("tinny")}), {meant});
}

TEST_F(BadFlags, TenMillionTrialsAskForYes) {
  std::string values = "[0.01";
  for (int n = 11; n < 60; ++n) values += ", 0.0" + std::to_string(n);
  expect_refused(mapscore({"sweep", study(), "-o", results(), "--set", "seeds=100000", "--set",
                           "sweep={voxel_m: " + values + "]}"}),
                 {"50 cells x 2 methods x 100000 seeds = 10000000 trials", "time: ", "--yes"});
}

/// Voxels of 0.1 mm: hundreds of millions even here.
TEST_F(BadFlags, WithoutYesNoTruthThatFillsTheMachine) {
  const std::vector<std::string> parts{"truth at 0.0001 m: about", "GB", "add --yes", "larger"};
  const std::vector<std::string> fine{"--voxel_m", "0.0001", "--epsilon_m", "0"};
  const std::vector<std::string> study_of_fine{"-o", results(), "--set", "voxel_m=0.0001"};
  const auto with = [](std::vector<std::string> command, const std::vector<std::string>& more) {
    command.insert(command.end(), more.begin(), more.end());
    return command;
  };
  expect_refused(mapscore(with({"truth", path("tiny"), "-o", path("t.csv")}, fine)), parts);
  expect_refused(mapscore(with({"sweep", study()}, study_of_fine)), parts);
  expect_refused(mapscore(with({"run", study()}, study_of_fine)), parts);
  expect_refused(mapscore(with({"frames", study(), "--set", "score.unit=frame"}, study_of_fine)),
                 parts);
  expect_done(mapscore({"truth", path("tiny"), "-o", path("t.csv"), "--yes"}));
}

TEST_F(BadFlags, LeaveNothingBehind) {
  const auto before = contents_of(folder());
  (void)mapscore({"sweep", study(), "-o", results(), "--set", "voxel_m=-1"});
  (void)mapscore({"truth", path("tiny"), "-o", path("t.txt")});
  EXPECT_EQ(contents_of(folder()), before);
}

}  // namespace
}  // namespace mapscore::testing
