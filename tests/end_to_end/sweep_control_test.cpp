// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

namespace mapscore::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// What a person does around a sweep: look before, look while, stop, go on, repeat a trial.
class SweepControl : public TinyStudy {
 protected:
  [[nodiscard]] std::vector<std::string> command(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"sweep", study(), "-o", results(), "-j", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  [[nodiscard]] Outcome sweep(const std::vector<std::string>& more = {}) const {
    return mapscore(command(more));
  }
  /// Waits until a file holds a text, for at most 20 s.
  [[nodiscard]] bool comes(const std::string& file, const std::string& text) const {
    for (int tries = 0; tries < 2000; ++tries) {
      if (bytes_of(path(file)).find(text) != std::string::npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  /// A study whose second cell has poses for the first frame alone.
  void make_one_trial_fail() const {
    for (const auto& [name, end] : {std::pair("whole.txt", "10"), std::pair("short.txt", "0.1")})
      write_text(path(name), fmt::format("0 0 0 0 0 0 0 1\n{} 0 0 0 0 0 0 1\n", end));
    write_text(study(),
               "recording: tiny\n"
               "methods: {direct: {segmentation: {direct: {}}}}\n"
               "localization: {source: trajectory, trajectory: whole.txt}\n"
               "sweep: {localization.trajectory: [whole.txt, short.txt]}\n");
  }
};

TEST_F(SweepControl, ADryRunCountsAndWritesNothing) {
  const auto before = contents_of(folder());
  const Outcome first = sweep({"--dry_run"});
  expect_done(first);
  EXPECT_THAT(first.out,
              AllOf(HasSubstr("2 cells x 2 methods x 2 seeds = 8 trials, 10 with ceilings"),
                    HasSubstr("0 there, 10 missing"), HasSubstr("4 frames"),
                    HasSubstr("time: unknown, no sweep into this folder has measured it yet")));
  EXPECT_EQ(contents_of(folder()), before);
  expect_done(sweep({"-q"}));
  const std::string store = bytes_of(path("results/results.sqlite"));
  EXPECT_EQ(sweep({"--dry-run"}).out, sweep({"--dry_run"}).out) << "flags may have hyphens";
  const Outcome more = sweep({"--dry_run", "--set", "seeds=3"});
  expect_done(more);
  EXPECT_THAT(more.out,
              AllOf(HasSubstr("10 there, 5 missing"), HasSubstr(" s a trial, as the last")));
  EXPECT_THAT(sweep({"--dry_run", "--set", "seeds=3", "--shard", "2/2"}).out,
              HasSubstr("5 missing, 5 in shard 2/2"));
  EXPECT_THAT(sweep({"--dry_run"}).out, HasSubstr("time: none"));
  // Direct reads no radius: 4 trials of its own, 12 of erosion, 2 lattice ceilings.
  EXPECT_THAT(sweep({"--dry_run", "--set", "sweep.radius_px=[1, 2, 3]"}).out,
              AllOf(HasSubstr("6 cells x 2 methods x 2 seeds = 24 trials, 18 with ceilings, as"),
                    HasSubstr("that differ in nothing their method reads are one")));
  EXPECT_TRUE(bytes_of(path("results/results.sqlite")) == store);
}

TEST_F(SweepControl, VeryManyTrialsNeedYes) {
  const std::vector<std::string> many{"--set", "seeds=50000"};
  expect_refused(sweep(many),
                 {"2 cells x 2 methods x 50000 seeds = 200000 trials", "time: ", "add --yes"});
  EXPECT_FALSE(std::filesystem::exists(results()));
}

TEST_F(SweepControl, RefusesBadFlagsBeforeTheWork) {
  expect_refused(sweep({"--shard", "4/3"}), {"--shard 4/3", "1 <= i <= n"});
  expect_refused(sweep({"--merge", path("nothing")}), {"nothing", "no result store there"});
  expect_refused(sweep({"--dry_run", "--set", "sweep.voxel_m=[]"}), {"sweep.voxel_m", "no values"});
  EXPECT_FALSE(std::filesystem::exists(results()));
  for (const char* verb : {"status", "trials"})
    expect_refused(mapscore({verb, path("nothing")}), {"nothing", "no result store there"});
  expect_refused(mapscore({"run", path("nothing"), "--trial", "ab"}), {"no result store there"});
}

TEST_F(SweepControl, StatusOfAFinishedAndAnUnfinishedSweep) {
  expect_done(sweep({"-q", "--set", "seeds=1"}));
  EXPECT_EQ(sweep({"-q", "--merge_only"}).exit_code, 1) << "binds the folder to both seeds";
  const Outcome half = mapscore({"status", results()});
  expect_done(half);
  EXPECT_THAT(half.out,
              AllOf(HasSubstr("5 of 10 trials and ceilings done, 0 failed, 5 not tried yet"),
                    HasSubstr("finished sweep of study study by "), HasSubstr("shard 1/1"),
                    HasSubstr("5 of 5 trials computed"), HasSubstr("frame evaluations/s")));
  expect_done(sweep({"-q"}));
  EXPECT_THAT(mapscore({"status", results()}).out, HasSubstr("10 of 10 trials and ceilings done"));
  std::filesystem::remove(path("results/status.json"));
  EXPECT_THAT(mapscore({"status", results()}).out, HasSubstr("no sweep has left its status"));
  write_text(path("results/status.json"), "{}");
  expect_refused(mapscore({"status", results()}), {"status.json", "no status of a sweep"});
}

TEST_F(SweepControl, StatusOfARunningAndAKilledSweep) {
  Process running(mapscore_command(command({"-q", "--set", "seeds=2000"})));
  ASSERT_TRUE(comes("results/status.json", "\"evaluations\": "));
  const Outcome while_running = mapscore({"status", results()});
  ASSERT_TRUE(running.kill()) << "it should have taken longer";
  expect_done(while_running);
  EXPECT_THAT(while_running.out, HasSubstr("running sweep of study study by "));
  const Outcome killed = mapscore({"status", results()});
  expect_done(killed);
  EXPECT_THAT(killed.out, HasSubstr("killed sweep of study study"));
}

TEST_F(SweepControl, CtrlCSaysWhatIsStoredAndTheNextSweepGoesOn) {
  const std::vector<std::string> flags{"-q", "--set", "seeds=400"};
  Process running(mapscore_command(command(flags)));
  ASSERT_TRUE(comes("results/status.json", "\"evaluations\": "));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  running.interrupt();
  const Outcome stopped = running.wait();
  EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
  EXPECT_THAT(stopped.err,
              AllOf(HasSubstr("sweep: stopped; "), HasSubstr(" of 2000 trials are in "),
                    HasSubstr("the same command goes on")));
  EXPECT_THAT(mapscore({"status", results()}).out, HasSubstr("stopped sweep of study"));
  expect_done(sweep(flags));
  EXPECT_THAT(mapscore({"status", results()}).out, HasSubstr("2000 of 2000 trials"));
}

TEST_F(SweepControl, ASecondSweepWaitsAndDoesNotBindTheFolderToItsStudy) {
  Process first(mapscore_command(command({"-q", "--set", "seeds=1500"})));
  ASSERT_TRUE(comes("results/status.json", "\"evaluations\": "));
  Process second(mapscore_command(command({"--set", "name=other"})));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_FALSE(second.ended()) << "it should wait";
  EXPECT_THAT(mapscore({"status", results()}).out, HasSubstr("study study, "));
  first.interrupt();
  EXPECT_EQ(first.wait().exit_code, 130);
  const Outcome waited = second.wait();
  expect_done(waited);
  EXPECT_THAT(waited.err,
              AllOf(HasSubstr("is in use by "), HasSubstr("waiting until that sweep ends"),
                    HasSubstr("held study study; its trials stay")));
  EXPECT_THAT(mapscore({"status", results()}).out, HasSubstr("study other, 10 of 10"));
}

TEST_F(SweepControl, AFailingTrialCostsThatTrialAlone) {
  make_one_trial_fail();
  for (int times = 0; times < 2; ++times) {  // the second tries it again
    const Outcome outcome = sweep();
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("1 trial failed: "), HasSubstr("short.txt"),
                                   HasSubstr("--state failed` lists them")));
  }
  const Outcome status = mapscore({"status", results()});
  EXPECT_THAT(status.out, HasSubstr("1 failed, 0 not tried yet"));
  const Outcome failed = mapscore({"trials", results(), "--state", "failed"});
  expect_done(failed);
  EXPECT_THAT(failed.out,
              AllOf(HasSubstr("failed"), HasSubstr("short.txt"), Not(HasSubstr("done"))));
  expect_refused(mapscore({"table", results()}),
                 {"1 of", "not there yet; 1 of them failed, the first: ", "short.txt",
                  "--state failed` lists them"});
  const Outcome interim = mapscore({"table", results(), "--interim"});
  expect_done(interim);
  EXPECT_THAT(interim.out, AllOf(HasSubstr("INTERIM: "), HasSubstr("1 of them failed")));
  const std::string key = failed.out.substr(failed.out.find('\n') + 1, 32);
  expect_refused(mapscore({"run", results(), "--trial", key}), {"short.txt"});
}

TEST_F(SweepControl, ListsTrialsAndRepeatsOneToTheLastCount) {
  expect_done(sweep({"-q"}));
  const Outcome all = mapscore({"trials", results(), "--format", "csv"});
  expect_done(all);
  EXPECT_EQ(std::ranges::count(all.out, '\n'), 1 + 10);
  EXPECT_THAT(all.out, AllOf(HasSubstr(",trial,erosion,1,done,0.03,-"),
                             HasSubstr(",lattice_ceiling,direct,0,done,0,-")));
  std::size_t line = all.out.find('\n') + 1;
  for (int n = 0; n < 10; ++n, line = all.out.find('\n', line) + 1) {
    const Outcome again = mapscore({"run", results(), "--trial", all.out.substr(line, 12), "-q"});
    expect_done(again);
    EXPECT_THAT(again.out, HasSubstr("# counts equal to those stored"));
  }
  expect_refused(mapscore({"run", results(), "--trial", "xyz"}), {"--trial xyz", "lists the keys"});
  expect_refused(mapscore({"run", results(), "--trial", "ab", "--seed", "1"}),
                 {"--seed", "--trial"});
  expect_refused(mapscore({"run", results(), "--trial", "ab", "--set", "voxel_m=1"}), {"--set"});
}

TEST_F(SweepControl, InterimTablesAndFiguresAreMarked) {
  expect_refused(mapscore({"table", results(), "--interim"}), {"no result store there"});
  expect_done(sweep({"-q", "--set", "seeds=1"}));  // the first seed of each line
  EXPECT_EQ(sweep({"-q", "--merge_only"}).exit_code, 1);
  expect_refused(mapscore({"table", results()}), {"5 of 10 trials are not there yet"});
  const Outcome table = mapscore({"table", results(), "--interim"});
  expect_done(table);
  EXPECT_THAT(table.out,
              AllOf(HasSubstr("INTERIM: "), HasSubstr(" of 10 trials and ceilings are there"),
                    HasSubstr("seeds there")));
  expect_done(mapscore(
      {"figures", results(), "--interim", "--no_pictures", "--trial", "magnitude_m=0.030"}));
  EXPECT_THAT(bytes_of(path("results/interim_figures/table.txt")), HasSubstr("INTERIM"));
  EXPECT_THAT(bytes_of(path("results/interim_figures/accuracy_by_dose.gp")), HasSubstr("INTERIM"));
  EXPECT_FALSE(std::filesystem::exists(path("results/figures")));
}

TEST_F(SweepControl, MergeOnlyBindsNoFolderToAnotherStudy) {
  expect_done(sweep());
  const std::string before = mapscore({"table", results()}).out;
  std::filesystem::copy(study(), path("other.yaml"));
  expect_refused(mapscore({"sweep", path("other.yaml"), "-o", results(), "--merge_only"}),
                 {"holds study", "other"});
  EXPECT_EQ(mapscore({"table", results()}).out, before);
}

TEST_F(SweepControl, CtrlCOfATolerance) {
  Process running(
      mapscore_command({"tolerance", study(), "-o", results(), "-j", "1", "--trials", "20000"}));
  ASSERT_TRUE(comes("results/results.sqlite", "SQLite"));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  running.interrupt();
  const Outcome stopped = running.wait();
  EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("the same command goes on"));
}

TEST_F(SweepControl, AStudyOfWhichEveryTrialFailedSaysSo) {
  make_one_trial_fail();
  const std::vector<std::string> flags{"--set", "sweep.localization.trajectory=[short.txt]"};
  EXPECT_EQ(sweep(flags).exit_code, 1) << "its ceilings stand";
  for (const char* flag : {"--interim", "--tidy"})
    expect_refused(mapscore({"table", results(), flag}),
                   {"1 of them failed, the first: ", "short.txt", "--state failed"});
}

TEST_F(SweepControl, SaysWhereNothingDetectedIsVisible) {
  replace("tiny/recording.yaml", "instances:\n",
          "  - {id: 3, name: \"lamp\", colour: \"00FF00\", detect: false}\ninstances:\n");
  const Outcome done = sweep({"--set", "detect=[lamp]"});
  expect_done(done);
  const std::string note = "no truth voxel of a detected class was visible in any trial";
  EXPECT_THAT(done.err, HasSubstr(note));
  EXPECT_THAT(mapscore({"table", results()}).out, HasSubstr(note));
  EXPECT_THAT(mapscore({"table", results(), "--columns", "method"}).out, HasSubstr(note));
  EXPECT_THAT(sweep().err, Not(HasSubstr(note)));
}

TEST_F(SweepControl, AClassWithACommaCanBeChosen) {
  replace("tiny/recording.yaml", "instances:\n",
          "  - {id: 3, name: \"door,double\", colour: \"00FF00\", detect: true}\ninstances:\n");
  expect_done(sweep({"-q"}));
  const Outcome table = mapscore({"table", results(), "--class", "door\\,double,pooled"});
  expect_done(table);
  EXPECT_THAT(table.out, AllOf(HasSubstr("door,double"), HasSubstr("pooled")));
  const Outcome run = mapscore({"run", study(), "--set", "detect=[\"door,double\", crate]",
                                "--method", "direct", "-o", path("run"), "-q"});
  expect_done(run);
  EXPECT_THAT(run.out, HasSubstr("door\\,double"));
}

TEST_F(SweepControl, RunOfResultsSaysHowToNameATrial) {
  expect_done(sweep({"-q"}));
  expect_refused(mapscore({"run", results()}), {"mapscore trials ", "--trial KEY"});
  EXPECT_THAT(mapscore({"help", "run"}).out, HasSubstr("STUDY or RESULTS"));
}

TEST_F(SweepControl, HelpOfAVerb) {
  const Outcome help = mapscore({"help", "sweep"});
  expect_done(help);
  EXPECT_EQ(help.out, mapscore({"sweep", "--help"}).out);
  EXPECT_EQ(mapscore({"help"}).out, mapscore({"--help"}).out);
  expect_refused(mapscore({"help", "swep"}), {"no verb 'swep'"});
}

TEST_F(SweepControl, FiguresRefuseATrialThatIsNoneBeforeTheyDraw) {
  expect_done(sweep({"-q"}));
  expect_refused(mapscore({"figures", results(), "--seed", "7"}), {"seed 7", "0 to 1"});
  expect_refused(mapscore({"figures", results(), "--method", "none"}), {"method none"});
  expect_refused(mapscore({"figures", results(), "--trial", "voxel_m=1"}), {"does not sweep it"});
  expect_refused(mapscore({"figures", results(), "--trial", "magnitude_m=0.5"}),
                 {"faults.misregistration.magnitude_m: the study has no value 0.5", "0.03"});
  EXPECT_FALSE(std::filesystem::exists(path("results/figures")));
}

}  // namespace
}  // namespace mapscore::testing
