// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/plan.hpp"
#include "files/file_bytes.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>

// A method that is a command: what may stand in a study, and what decides a trial's key.

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;

class CommandMethodTest : public ::testing::Test {
 protected:
  [[nodiscard]] Study study(const std::string& keys, const std::string& more = "") const {
    return parse_study(
        "recording: tiny\nmethods:\n  direct: {segmentation: {direct: {}}}\n  mine: {" + keys +
            "}\n" + more,
        folder_.path() / "study.yaml");
  }
  /// Of the command's trial.
  [[nodiscard]] Task task(const Study& of) const {
    return task_of(of, {0, "mine", cells(of)[0], 0}, Labels::detected, "recording");
  }
  [[nodiscard]] std::string key(const std::string& keys, const std::string& more = "") const {
    return task(study(keys, more)).key;
  }
  [[nodiscard]] std::filesystem::path file(const std::string& name) const {
    return folder_.path() / name;
  }

 private:
  mapscore::testing::TemporaryFolder folder_;
};

const std::string kCommand = "command: [mapper, \"{trial}\", \"{map}\"]";
const std::string kPlain = kCommand + ", map: voxels.csv";

TEST_F(CommandMethodTest, IsReadAndWrittenAsItStands) {
  const Study of = study(kPlain + ", timeout_s: 7, threads: 2, title: My mapper");
  const MethodSettings& mine = of.methods.at(1);
  ASSERT_TRUE(mine.command);
  EXPECT_EQ(mine.command->command, (std::vector<std::string>{"mapper", "{trial}", "{map}"}));
  EXPECT_EQ(mine.command->timeout_s, 7);
  EXPECT_EQ(mine.command->threads, 2);
  EXPECT_EQ(method_title(of, "mine"), "My mapper");
  EXPECT_EQ(parse_study(to_yaml(of), file("study.yaml")), of);
  EXPECT_FALSE(of.methods.at(0).command);
}

TEST_F(CommandMethodTest, KeyHoldsTheCommandAndWhatItDependsOn) {
  write_file(file("my.py"), "first");
  const std::string depends = kPlain + ", depends: [my.py]";
  const std::string first = key(depends);
  EXPECT_NE(first, key(kPlain));
  EXPECT_NE(key(kPlain), key("command: [mapper, -v, \"{trial}\", \"{map}\"], map: voxels.csv"));
  EXPECT_NE(key(kPlain), key(kCommand + ", map: voxels.ply"));
  EXPECT_EQ(key(kPlain), key(kPlain + ", timeout_s: 7, threads: 2, title: My mapper"));
  write_file(file("my.py"), "other");
  EXPECT_NE(key(depends), first);
  write_file(file("my.py"), "first");
  EXPECT_EQ(key(depends), first);
  expect_error("gone.py", [&] { (void)key(kPlain + ", depends: [gone.py]"); });
}

TEST_F(CommandMethodTest, KeyHoldsWhatFilesHoldThatTheCommandNames) {
  const std::string keys = "command: [python3, my.py, \"{trial}\", \"{map}\"], map: voxels.csv";
  const std::string missing = key(keys);
  write_file(file("my.py"), "first");
  const std::string first = key(keys);
  EXPECT_NE(first, missing);
  EXPECT_EQ(key(keys + ", depends: [my.py]"), first);
  write_file(file("my.py"), "other");
  EXPECT_NE(key(keys), first);
}

TEST_F(CommandMethodTest, KeyHoldsTheNoiseOfTheScansThatItIsGiven) {
  const std::string noise = "faults: {lidar: {preset: rplidar_a2, scale: ";
  EXPECT_NE(key(kPlain, noise + "1}}\n"), key(kPlain));
  EXPECT_NE(key(kPlain, noise + "1}}\n"), key(kPlain, noise + "2}}\n"));
  EXPECT_EQ(key(kPlain, noise + "0}}\n"), key(kPlain));
  // Our own methods see no scans but through their poses.
  const auto own = [&](const std::string& more) {
    const Study of = study(kPlain, more);
    return task_of(of, {0, "direct", cells(of)[0], 0}, Labels::detected, "recording").key;
  };
  EXPECT_EQ(own(noise + "1}}\n"), own(""));
}

TEST_F(CommandMethodTest, APlanOfStoredHashesLooksAtNoFile) {
  write_file(file("my.py"), "first");
  write_file(file("weights"), "w");
  const Study of = study(
      "command: [python3, my.py, \"{trial}\", \"{map}\"], map: voxels.csv, depends: [weights]");
  const Plan swept = plan_of(of, "recording");
  EXPECT_TRUE(is_as_planned(task(of)));
  const Task before = task(of);
  std::filesystem::remove(file("weights"));
  write_file(file("my.py"), "other");
  const Plan read = plan_of(of, "recording", InputFiles(swept.inputs));
  for (std::size_t n = 0; n < swept.tasks.size(); ++n)
    EXPECT_EQ(read.tasks.key(n), swept.tasks.key(n));
  EXPECT_EQ(read.inputs, swept.inputs);
  expect_error("weights", [&] { (void)plan_of(of, "recording"); });
  write_file(file("weights"), "w");
  EXPECT_FALSE(is_as_planned(before));
  expect_error("not stored",
               [&] { (void)plan_of(of, "recording", InputFiles(InputFiles::Hashes{})); });
}

TEST_F(CommandMethodTest, OtherMethodsKeepTheirKeys) {
  const Study with = study(kPlain);
  Study without = with;
  without.methods.pop_back();
  const auto of_direct = [](const Study& of) {
    return task_of(of, {0, "direct", cells(of)[0], 0}, Labels::detected, "recording").description;
  };
  EXPECT_EQ(of_direct(with), of_direct(without));
  EXPECT_THAT(of_direct(with), ::testing::Not(::testing::HasSubstr("command")));
}

TEST_F(CommandMethodTest, CeilingsAreItsOwnAndThoseOfAll) {
  const Study of = study(kPlain, "faults: {pose: {sigma_xy_m: 0.1}}\n");
  const Plan plan = plan_of(of, "recording");
  EXPECT_TRUE(plan.tasks.config(plan.trials[1].registration_ceiling).methods.front().command);
  EXPECT_EQ(plan.trials[0].lattice_ceiling, plan.trials[1].lattice_ceiling);
}

TEST_F(CommandMethodTest, WhatItCannotFollowIsRefused) {
  const auto refused = [&](const std::string& part, const std::string& keys,
                           const std::string& more = "") {
    expect_error(part, [&] { (void)study(keys, more); });
  };
  refused("unknown key 'segmentation'", kPlain + ", segmentation: {direct: {}}");
  refused("unknown key 'refinement'", kPlain + ", refinement: {crf: {}}");
  refused("names no program", "command: [], map: voxels.csv");
  refused("'map' is missing", kCommand);
  refused("does not name {map}", "command: [mapper, \"{trial}\"], map: voxels.csv");
  refused("did you mean '{trial}'", "command: [mapper, \"{trail}\", \"{map}\"], map: voxels.csv");
  refused("NUL", "command: [mapper, \"a\\0b\", \"{map}\"], map: voxels.csv");
  EXPECT_NO_THROW((void)study("command: [awk, \"{print}\", \"{map}\"], map: voxels.csv"));
  refused("no name of a file", kCommand + ", map: ../voxels.csv");
  refused("no name of a file", kCommand + ", map: .csv");
  refused("timeout_s", kPlain + ", timeout_s: 0");
  refused("threads", kPlain + ", threads: 0");
  refused("score.unit", kPlain, "score: {unit: frame}\n");
  refused("methods.mine.timeout_s cannot be swept", kPlain,
          "sweep: {methods.mine.timeout_s: [1]}\n");
  refused("'segmentation' is missing", "title: nothing");
}

}  // namespace
}  // namespace mapscore::eval
