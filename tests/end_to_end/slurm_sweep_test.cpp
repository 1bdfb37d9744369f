// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Takes the place of sbatch: writes down its arguments and runs the script at once, a task after
/// the other. Files beside it: `refuse` (says so), `lost` (numbers of tasks that never run),
/// `twice` (every task runs as two processes at once).
constexpr const char* kSbatch = R"(#!/bin/bash
here=$(dirname "$0")
[ -e "$here/refuse" ] && { echo "sbatch: error: invalid partition" >&2; exit 1; }
number=$(( $(ls "$here" | grep -c call) + 1 ))
printf '%s\n' "$@" >"$here/call$number"
for word; do case $word in --array=*) list=${word#--array=} ;; esac; done
script=${!#}
if [ -n "$list" ]; then
  for part in ${list//,/ }; do
    for task in $(seq "${part%-*}" "${part#*-}"); do
      grep -qsx "$task" "$here/lost" && continue
      [ -e "$here/twice" ] && SLURM_ARRAY_TASK_ID=$task sh "$script" >>"$here/log" 2>&1 &
      SLURM_ARRAY_TASK_ID=$task sh "$script" >>"$here/log" 2>&1
      wait
    done
  done
else
  sh "$script" >"$here/merge_log" 2>&1
  echo $? >"$here/merge_code"
fi
echo "$number;cluster"
)";

/// `mapscore sweep --slurm` where sbatch and squeue are stand-ins.
class SlurmSweep : public TinyStudy {
 protected:
  SlurmSweep() {
    program("sbatch", kSbatch);
    program("squeue", "#!/bin/sh\nexit 1\n");
    setenv("PATH", (path("bin") + ":" + path_).c_str(), 1);
  }
  ~SlurmSweep() override { setenv("PATH", path_.c_str(), 1); }

  void program(const std::string& name, const std::string& text) const {
    fs::create_directories(path("bin"));
    write_text(path("bin/" + name), text);
    fs::permissions(path("bin/" + name), fs::perms::owner_all);
  }
  [[nodiscard]] Outcome submit(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"sweep", study(), "-o", results(), "--slurm"};
    words.insert(words.end(), more.begin(), more.end());
    return mapscore(words);
  }
  [[nodiscard]] static std::string tidy(const std::string& of) {
    const Outcome table = mapscore({"table", of, "--tidy"});
    expect_done(table);
    return table.out;
  }
  /// What a sweep in one process gives.
  [[nodiscard]] std::string expected() const {
    expect_done(mapscore({"sweep", study(), "-o", path("whole"), "-q"}));
    return tidy(path("whole"));
  }
  [[nodiscard]] bool submitted() const { return fs::exists(path("bin/call1")); }

 private:
  std::string path_ = std::getenv("PATH");
};

TEST_F(SlurmSweep, AnArrayAndItsMergeGiveTheSameTable) {
  const Outcome outcome = submit({"--tasks", "3", "--", "--partition=a b", "--time=5"});
  expect_done(outcome);
  EXPECT_THAT(outcome.err, HasSubstr("10 missing trials submitted, array job 1, merge job 2"));
  EXPECT_THAT(bytes_of(path("bin/call1")),
              AllOf(HasSubstr("--parsable\n"), HasSubstr("\n--array=1-3\n--partition=a b\n"),
                    HasSubstr("\n--cpus-per-task=1\n"), HasSubstr("\n--time=5\n./array.sh\n")));
  EXPECT_THAT(
      bytes_of(path("bin/call2")),
      AllOf(HasSubstr("\n--dependency=afterany:1\n--partition=a b\n"), Not(HasSubstr("--array"))));
  EXPECT_EQ(bytes_of(path("bin/merge_code")), "0\n") << bytes_of(path("bin/merge_log"));
  EXPECT_EQ(tidy(results()), expected());

  expect_done(submit());
  EXPECT_FALSE(fs::exists(path("bin/call3"))) << "there is nothing left to submit";
}

TEST_F(SlurmSweep, WhatLostTasksLeftIsNamedAndSubmittedAgain) {
  write_text(path("bin/lost"), "2\n");
  expect_done(submit({"--tasks", "3"}));
  EXPECT_EQ(bytes_of(path("bin/merge_code")), "1\n");
  EXPECT_THAT(bytes_of(path("bin/merge_log")),
              AllOf(HasSubstr("sweep: 3 of 10 trials are missing: 3 of shard 2/3; "),
                    HasSubstr("`mapscore sweep " + study()), HasSubstr("--slurm --tasks 3`")));
  EXPECT_THAT(mapscore({"status", results()}).out,
              AllOf(HasSubstr("7 of 10 trials and ceilings done, 0 failed, 3 not tried"),
                    HasSubstr("shards: 2 finished"),
                    HasSubstr("array job 1 of 3 shards, merge job 2: not in the queue")));

  fs::remove(path("bin/lost"));
  expect_done(submit({"--tasks", "3"}));
  EXPECT_THAT(bytes_of(path("bin/call3")), HasSubstr("\n--array=2\n"));
  EXPECT_EQ(bytes_of(path("bin/merge_code")), "0\n") << bytes_of(path("bin/merge_log"));
  EXPECT_EQ(tidy(results()), expected());
}

TEST_F(SlurmSweep, CommandsThatFailedAreSubmittedAgainOnlyWhenAsked) {
  replace("study.yaml", "methods:\n",
          "methods:\n  broken: {command: [sh, -c, exit 3, \"{map}\"], map: voxels.csv}\n");
  const Outcome first = submit({"--tasks", "2"});
  expect_done(first);
  EXPECT_THAT(bytes_of(path("bin/merge_log")),
              AllOf(HasSubstr("4 trials failed before"), HasSubstr("all 10 other trials are in")));
  const Outcome again = submit();
  EXPECT_EQ(again.exit_code, 1) << "as a sweep whose commands failed";
  EXPECT_THAT(again.err, HasSubstr("--retry_failed tries them again"));
  EXPECT_FALSE(fs::exists(path("bin/call3"))) << "there is nothing left to submit";
  expect_done(submit({"--retry_failed"}));
  EXPECT_TRUE(fs::exists(path("bin/call3")));
  EXPECT_THAT(bytes_of(path("bin/merge_log")), HasSubstr("4 trials failed before"));
}

TEST_F(SlurmSweep, TasksThatRunTwiceAtOnceCountOnce) {
  write_text(path("bin/twice"), "");
  expect_done(submit({"--tasks", "4"}));
  EXPECT_EQ(bytes_of(path("bin/merge_code")), "0\n") << bytes_of(path("bin/merge_log"));
  EXPECT_THAT(bytes_of(path("bin/merge_log")), HasSubstr("10 trials taken over from shards"));
  EXPECT_EQ(tidy(results()), expected());
}

TEST_F(SlurmSweep, AStoreThatATaskLeftUnreadableCostsThatTask) {
  fs::create_directories(path("results/shards/1-of-9@gone"));
  write_text(path("results/shards/1-of-9@gone/results.sqlite"), "");
  fs::create_directories(path("results/shards/2-of-9@gone"));
  const Outcome outcome = submit();
  expect_done(outcome);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("left out: "), HasSubstr("1-of-9@gone"), HasSubstr("2-of-9@gone")));
  EXPECT_EQ(bytes_of(path("bin/merge_code")), "0\n") << bytes_of(path("bin/merge_log"));
}

TEST_F(SlurmSweep, NamesNeverRunAsCommands) {
  const std::string trap = "touch trap";
  const std::string name = "a'b\"$(" + trap + ")`" + trap + "`;" + trap + "\n#SBATCH --wrap\n\\%A";
  fs::rename(path("tiny"), path("held"));
  const fs::path hostile = folder() / name;
  fs::create_directories(hostile);
  fs::rename(path("held"), hostile / "tiny");
  fs::rename(study(), hostile / (name + ".yaml"));
  const Outcome outcome =
      mapscore({"sweep", hostile / (name + ".yaml"), "-o", hostile / "r", "--set",
                "name=$(touch trap)'`touch trap`", "--slurm", "--", "--comment=$(touch trap)"});
  expect_done(outcome);
  EXPECT_EQ(bytes_of(path("bin/merge_code")), "0\n") << bytes_of(path("bin/merge_log"));
  EXPECT_THAT(bytes_of(path("bin/call1")), HasSubstr("--comment=$(touch trap)\n"));
  for (const std::string& file : contents_of(folder()))
    EXPECT_NE(fs::path(file).filename(), "trap") << file;
  EXPECT_THAT(mapscore({"status", hostile / "r"}).out, HasSubstr("10 of 10 trials"));
}

TEST_F(SlurmSweep, RefusesBeforeTheWork) {
  expect_refused(submit({"--shard", "1/2"}), {"--slurm", "leave --shard"});
  expect_refused(submit({"--merge_only"}), {"--slurm", "--merge_only"});
  expect_refused(submit({"--tasks", "0"}), {"--tasks"});
  for (const char* option :
       {"--array=1-5", "-a1-5", "--dependency=singleton", "--dep=singleton", "-W"})
    expect_refused(submit({"--", option}), {option, "mapscore sets this option"});
  expect_refused(mapscore({"sweep", study(), "-o", results(), "--tasks", "3"}),
                 {"--tasks: goes with --slurm"});
  expect_refused(mapscore({"sweep", study(), study(), "-o", results()}), {"one study a sweep"});
  expect_refused(mapscore({"sweep", study(), "-o", results(), "--merge_only", "--shard", "1/2"}),
                 {"--merge_only"});
  setenv("PATH", "/nowhere", 1);
  expect_refused(submit(), {"--slurm: no sbatch on this machine"});
  EXPECT_FALSE(fs::exists(results()));
  EXPECT_FALSE(submitted());
}

TEST_F(SlurmSweep, SaysWhatSbatchRefuses) {
  write_text(path("bin/refuse"), "");
  expect_refused(submit({"-q"}), {"sbatch refuses array.sh: sbatch: error: invalid partition"});
  program("sbatch", "#!/bin/sh\necho Submitted batch job 7\n");
  expect_refused(submit({"-q"}), {"sbatch: gave no number of a job", "Submitted batch job 7"});
}

TEST_F(SlurmSweep, JobsInTheQueueAreToldAndNotSubmittedTwice) {
  write_text(path("bin/lost"), "1\n2\n");
  expect_done(submit({"--tasks", "2"}));
  program("squeue", "#!/bin/sh\n[ \"$4\" = 1 ] && printf 'RUNNING\\nPENDING\\nPENDING\\n'\n");
  EXPECT_THAT(mapscore({"status", results()}).out,
              HasSubstr("array job 1 of 2 shards, merge job 2: 2 pending, 1 running"));
  expect_refused(submit(), {"jobs 1 and 2", "in the queue (2 pending, 1 running)", "scancel 1 2"});
  write_text(path("results/slurm/jobs.json"), "{\"array\": \"1; touch trap\"}");
  expect_refused(mapscore({"status", results()}), {"jobs.json", "not what `sweep --slurm` writes"});
}

TEST_F(SlurmSweep, AFailedTrialIsToldByTheMerge) {
  write_text(path("short.txt"), "0 0 0 0 0 0 0 1\n0.1 0 0 0 0 0 0 1\n");
  write_text(path("whole.txt"), "0 0 0 0 0 0 0 1\n10 0 0 0 0 0 0 1\n");
  write_text(study(),
             "recording: tiny\n"
             "methods: {direct: {segmentation: {direct: {}}}}\n"
             "localization: {source: trajectory, trajectory: whole.txt}\n"
             "sweep: {localization.trajectory: [whole.txt, short.txt]}\n");
  expect_done(submit({"--tasks", "2"}));
  EXPECT_EQ(bytes_of(path("bin/merge_code")), "1\n");
  const Outcome failed = mapscore({"trials", results(), "--state", "failed"});
  EXPECT_THAT(failed.out, HasSubstr("short.txt"));
}

// What GNU parallel, Snakemake or several hands do.
TEST_F(SlurmSweep, ShardsSideBySideAndASweepThatTakesThemOver) {
  for (const int shards : {3, 7}) {
    fs::remove_all(results());
    std::vector<std::unique_ptr<Process>> all;
    for (int shard = 1; shard <= shards; ++shard)
      all.push_back(std::make_unique<Process>(
          mapscore_command({"sweep", study(), "-o", results(), "-q", "-j", "1", "--shard",
                            std::to_string(shard) + "/" + std::to_string(shards)})));
    for (const auto& shard : all) expect_done(shard->wait());
    EXPECT_THAT(mapscore({"status", results()}).out,
                AllOf(HasSubstr("10 of 10 trials and ceilings done"),
                      HasSubstr("shards: " + std::to_string(shards) + " finished")));
    const Outcome whole = mapscore({"sweep", study(), "-o", results()});
    expect_done(whole);
    EXPECT_THAT(whole.err, AllOf(HasSubstr("10 trials taken over from shards"),
                                 HasSubstr(": 0 trials computed")));
    EXPECT_EQ(tidy(results()), expected());
    expect_done(mapscore({"sweep", study(), "-o", path("elsewhere" + std::to_string(shards)),
                          "--merge", results(), "--merge_only"}));
  }
}

TEST_F(SlurmSweep, StatusTellsSetsOfShardsApart) {
  for (const char* shard : {"1/3", "2/7", "3/7"})
    expect_done(mapscore({"sweep", study(), "-o", results(), "-q", "--shard", shard}));
  EXPECT_THAT(mapscore({"status", results()}).out,
              AllOf(HasSubstr("\n3 shards: 1 finished, 2 not begun\n"),
                    HasSubstr("\n7 shards: 2 finished, 5 not begun\n")));
}

TEST_F(SlurmSweep, AShardLeavesOutWhatTheFolderHolds) {
  expect_done(mapscore({"sweep", study(), "-o", results(), "-q", "--set", "seeds=1"}));
  const Outcome first = mapscore({"sweep", study(), "-o", results(), "--shard", "1/2"});
  expect_done(first);
  EXPECT_THAT(first.err, HasSubstr(": 0 trials computed")) << "the first seed is there";
  const Outcome missing = mapscore({"sweep", study(), "-o", results(), "--merge_only"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.err, HasSubstr("sweep: 5 of 10 trials are missing; `mapscore trials "));
}

}  // namespace
}  // namespace mapscore::testing
