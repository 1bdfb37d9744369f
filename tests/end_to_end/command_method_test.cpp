// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/store.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

// Mappers of others as commands of a study, swept by the built program. What goes wrong with them
// is in tests/hostile/commands.py.

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path kExternal = fs::path(MAPSCORE_SOURCE_DIR) / "configs/external";

class CommandSweep : public TinyStudy {
 protected:
  /// A study with the method direct and these, which are lines of YAML.
  void write_methods(const std::string& methods, const std::string& more = "") const {
    write_text(study(), fmt::format("recording: tiny\nmethods:\n"
                                    "  direct: {{segmentation: {{direct: {{}}}}}}\n{}"
                                    "sweep: {{faults.misregistration.magnitude_m: [0, 0.03]}}\n"
                                    "seeds: 2\n{}",
                                    methods, more));
  }
  [[nodiscard]] std::string numpy(const std::string& more = "") const {
    return fmt::format(
        "  numpy: {{command: [\"{}\", \"{}\", \"{{trial}}\", \"{{map}}\"], map: voxels.csv{}}}\n",
        MAPSCORE_PYTHON, (kExternal / "numpy_mapper.py").string(), more);
  }
  [[nodiscard]] static std::string shell(const std::string& name, const std::string& script,
                                         const std::string& more = "") {
    return fmt::format(
        "  {}: {{command: [sh, -c, '{}', \"{{trial}}\", \"{{map}}\"], map: voxels.csv{}}}\n", name,
        script, more);
  }
  [[nodiscard]] Outcome sweep(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"sweep", study(), "-o", results()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return mapscore(arguments);
  }
  /// Lines of the tidy table of one method, without its name.
  [[nodiscard]] std::vector<std::string> scores_of(const std::string& method) const {
    const Outcome table = mapscore({"table", results(), "--tidy"});
    expect_done(table);
    std::vector<std::string> lines;
    std::istringstream text(table.out);
    for (std::string line; std::getline(text, line);)
      if (const std::size_t at = line.find(',' + method + ','); at != line.npos)
        lines.push_back(line.erase(at, method.size() + 1));
    return lines;
  }
};

/// Lines about what a method of ours alone tells: detections, points and boxes.
bool is_of_map(const std::string& line) {
  for (const char* own : {"box", "detections", "points", "skipped"})
    if (line.find(own) != line.npos) return false;
  return true;
}

TEST_F(CommandSweep, NumpysDirectIsOursVoxelByVoxel) {
  write_methods(numpy(),
                "score: {labels: true, instances: true}\n"
                "detect: all\nfaults: {labels: {boundary_px: 3}}\n");  // masks that overlap
  expect_done(sweep({"-j", "2"}));
  std::vector<std::string> ours = scores_of("direct"), theirs = scores_of("numpy");
  std::erase_if(ours, std::not_fn(is_of_map));
  std::erase_if(theirs, std::not_fn(is_of_map));
  EXPECT_GT(ours.size(), 100u);
  EXPECT_EQ(ours, theirs);
}

TEST_F(CommandSweep, NumpysMapIsThatOfTheTrialFolder) {
  expect_done(
      mapscore({"trial", study(), "--cell", "magnitude_m=0.03", "-o", path("trial"), "-q"}));
  expect_done(mapscore({"map", path("trial"), "-o", path("map.ot"), "--ply", path("map.ply"),
                        "--threshold", "0", "-q"}));
  const std::string run =
      fmt::format("{} {} {} {}", MAPSCORE_PYTHON, (kExternal / "numpy_mapper.py").string(),
                  path("trial"), path("map.csv"));
  ASSERT_EQ(std::system(run.c_str()), 0);
  const auto tidy = [&](const char* map) {
    const Outcome score = mapscore({"score", path(map), "--truth", path("tiny"), "--tidy"});
    expect_done(score);
    return score.out;
  };
  EXPECT_EQ(tidy("map.csv"), tidy("map.ot"));
}

TEST_F(CommandSweep, OctoMapsMapperIsInTheSameTable) {
  write_methods(
      fmt::format("  octomap: {{command: [\"{}\", \"{{trial}}\", \"{{map}}\"], map: voxels.csv}}\n",
                  OCTOMAP_MAPPER));
  expect_done(sweep());
  const Outcome table = mapscore({"table", results(), "--format", "csv"});
  expect_done(table);
  EXPECT_THAT(table.out, HasSubstr("0.03,octomap,"));
  EXPECT_FALSE(scores_of("octomap").empty());
}

TEST_F(CommandSweep, ResumesShardsAndMergesToTheSameResults) {
  write_methods(numpy(", depends: [mine.txt]"));
  write_text(path("mine.txt"), "first");
  expect_done(sweep({"-q"}));
  const auto whole = scores_of("numpy");
  EXPECT_THAT(sweep().err, HasSubstr("0 trials computed"));
  write_text(path("mine.txt"), "second");
  EXPECT_THAT(sweep().err, HasSubstr("4 trials computed"));
  EXPECT_EQ(scores_of("numpy"), whole);
  fs::remove_all(results());
  for (const char* shard : {"1/2", "2/2"}) expect_done(sweep({"-q", "--shard", shard}));
  expect_done(sweep({"-q", "-j", "3"}));
  EXPECT_EQ(scores_of("numpy"), whole);
  const Outcome trials = mapscore({"trials", results()});
  expect_done(trials);
  EXPECT_THAT(trials.out, HasSubstr("peak_MB"));
}

TEST_F(CommandSweep, FailedTrialsAreToldAndTriedAgainWhenAsked) {
  write_methods(shell("broken", "echo oh no; exit 3") + shell("silent", "true"));
  const Outcome first = sweep();
  EXPECT_EQ(first.exit_code, 1);
  EXPECT_THAT(first.err, HasSubstr("8 trials failed"));
  EXPECT_THAT(first.err, HasSubstr("--retry_failed"));
  const Outcome again = sweep();
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_THAT(again.err, HasSubstr("0 trials computed, 6 already there"));
  EXPECT_THAT(again.err, HasSubstr("8 trials failed before"));
  EXPECT_THAT(sweep({"--dry_run"}).out, HasSubstr("6 there, 0 missing, 8 failed (--retry_failed"));
  EXPECT_THAT(sweep({"--dry_run", "--retry_failed"}).out,
              HasSubstr("6 there, 8 missing, 8 of them failed before"));
  const Outcome table = mapscore({"table", results()});
  expect_done(table);
  EXPECT_THAT(table.out, HasSubstr("FAILED: 4 failed of broken, 4 failed of silent, the first: "));
  EXPECT_THAT(table.out, Not(HasSubstr("of them failed")));
  expect_done(mapscore({"figures", results(), "--no_pictures"}));
  EXPECT_TRUE(fs::exists(path("results/figures/table.txt"))) << "the sweep is finished";
  const Outcome trials = mapscore({"trials", results(), "--state", "failed"});
  EXPECT_THAT(trials.out, HasSubstr("exit code 3; its log ends: 'oh no'"));
  EXPECT_EQ(sweep({"--retry_failed", "-q"}).exit_code, 1);
  EXPECT_THAT(mapscore({"status", results()}).out, HasSubstr("8 failed"));
}

TEST_F(CommandSweep, AMapOfNothingHasNoRecall) {
  write_methods(shell("header", "echo i,j,k,class > \"$1\"") +
                shell("background", "echo 0,0,0,0 > \"$1\""));
  expect_done(sweep({"-q"}));
  const Outcome table = mapscore({"table", results(), "--metric", "recall", "--format", "csv"});
  expect_done(table);
  for (const char* row : {"0.03,header,0,", "0.03,background,0,"})
    EXPECT_THAT(table.out, HasSubstr(row));
}

TEST_F(CommandSweep, ResultsAreReadWithoutTheFilesThatTheyCameFrom) {
  write_methods(numpy(", depends: [mine.txt]"));
  write_text(path("mine.txt"), "first");
  expect_done(sweep({"-q"}));
  const auto whole = scores_of("numpy");
  fs::remove(path("mine.txt"));
  EXPECT_EQ(scores_of("numpy"), whole);
  expect_done(mapscore({"compare", results(), "numpy", "direct"}));
  expect_refused(sweep({"-q"}), {"mine.txt"});
}

TEST_F(CommandSweep, AFileThatChangesUnderASweepFailsItsTrials) {
  write_text(path("mine.txt"), "first");
  write_methods(
      shell("mine", "echo more >> " + path("mine.txt") + "; exit 3", ", depends: [mine.txt]"));
  const Outcome outcome = sweep();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("4 trials failed"));
  EXPECT_THAT(outcome.err, HasSubstr("has changed since the sweep began"));
  EXPECT_THAT(mapscore({"trials", results()}).out, HasSubstr(" done "));  // those of direct
}

TEST_F(CommandSweep, WhatFailedInTheFolderIsNotMissingOfItsShards) {
  write_methods(shell("broken", "exit 3"));
  EXPECT_EQ(sweep({"-q"}).exit_code, 1);
  const Outcome merge = sweep({"--merge_only"});
  EXPECT_EQ(merge.exit_code, 1);
  EXPECT_THAT(merge.err, HasSubstr("4 trials failed before"));
  EXPECT_THAT(merge.err, HasSubstr("all 6 other trials are in"));
  for (const char* shard : {"1/2", "2/2"}) {
    const Outcome outcome = sweep({"--shard", shard});
    expect_done(outcome);
    EXPECT_THAT(outcome.err, HasSubstr("0 trials computed, 6 already there"));
  }
  EXPECT_EQ(sweep({"--shard", "1/2", "--retry_failed"}).exit_code, 1);
}

TEST_F(CommandSweep, SeedsWhoseCommandFailedAreLeftOutOfComparisons) {
  write_methods(
      shell("some", fmt::format("grep -q \"seed_index: 0\" \"$0/trial.yaml\" && "
                                "{} {} \"$0\" \"$1\"",
                                MAPSCORE_PYTHON, (kExternal / "numpy_mapper.py").string())) +
      shell("none", "exit 3"));
  EXPECT_EQ(sweep({"-q"}).exit_code, 1);
  const Outcome with_some = mapscore({"compare", results(), "some", "direct"});
  expect_done(with_some);
  EXPECT_THAT(with_some.out, HasSubstr("FAILED: 4 failed of none, 2 failed of some"));
  EXPECT_THAT(with_some.out, HasSubstr("1.0000 by direct and by some, over 1 seeds"));
  const Outcome with_none = mapscore({"compare", results(), "none", "direct"});
  expect_done(with_none);
  EXPECT_THAT(with_none.out, HasSubstr("magnitude_m = 0: undefined"));
  expect_refused(mapscore({"check", results(), "--baseline", path("b.json"), "--update"}),
                 {"6 of them failed", "--retry_failed` again"});
}

TEST_F(CommandSweep, AFailedCeilingIsNamedForItsMethod) {
  // The ceiling alone has the true calibration, which this mapper does not take.
  write_methods(
      shell("mine", fmt::format("grep -q \"T_color_depth: .*0.025\" \"$0/trial.yaml\" && "
                                "exit 3; {} {} \"$0\" \"$1\"",
                                MAPSCORE_PYTHON, (kExternal / "numpy_mapper.py").string())));
  const Outcome outcome = sweep({"--set", "sweep.faults.misregistration.magnitude_m=[0.03]"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const Outcome table = mapscore({"table", results()});
  expect_done(table);
  EXPECT_THAT(table.out, HasSubstr("FAILED: 2 failed of mine, the first: "));
}

TEST_F(CommandSweep, WhatCannotRunIsRefusedBeforeAnyTrial) {
  const auto refused = [&](const std::string& command, const std::vector<std::string>& parts) {
    write_methods(fmt::format("  mine: {{command: {}, map: voxels.csv}}\n", command));
    expect_refused(sweep({"-q"}), parts);
    EXPECT_THAT(mapscore({"trials", results()}).out, Not(HasSubstr(" done ")));
    fs::remove_all(results());
  };
  refused("[no_such_program, \"{trial}\", \"{map}\"]", {"methods.mine.command", "PATH"});
  refused("[./mine.sh, \"{trial}\", \"{map}\"]", {"methods.mine.command", "beside the study"});
  write_text(path("mine.sh"), "#!/bin/sh\ntrue\n");
  refused("[./mine.sh, \"{trial}\", \"{map}\"]", {"mine.sh", "chmod +x"});
  fs::permissions(path("mine.sh"), fs::perms::owner_all);
  for (const auto& [script, what] :
       {std::pair("#!/usr/bin/no_such -u\ntrue\n", "'/usr/bin/no_such', which is not there"),
        std::pair("true\n", "no line of #!")}) {
    write_text(path("mine.sh"), script);
    refused("[./mine.sh, \"{trial}\", \"{map}\"]", {"mine.sh", what, "first line"});
  }
  write_methods("  mine: {command: [./mine.sh, \"{trial}\", \"{map}\"], map: voxels.txt}\n");
  expect_refused(sweep({"-q"}), {"methods.mine.map", ".csv"});
  write_methods("  mine: {command: [], map: voxels.csv}\n");
  expect_refused(sweep({"-q"}), {"methods.mine.command", "names no program"});
}

TEST_F(CommandSweep, OtherVerbsSayWhatTheyCannotDo) {
  write_methods(numpy());
  expect_refused(mapscore({"run", study(), "-o", results(), "--method", "numpy", "-q"}),
                 {"methods.numpy", "sweep"});
  expect_done(mapscore({"trial", study(), "--method", "numpy", "-o", path("trial"), "-q"}));
  expect_refused(mapscore({"map", path("trial"), "-o", path("map.ot"), "-q"}), {"command"});
  expect_refused(mapscore({"map", path("tiny"), "-o", path("map.ot"), "-q", "--study", study(),
                           "--method", "numpy"}),
                 {"--method numpy", "command"});
}

}  // namespace
}  // namespace mapscore::testing
