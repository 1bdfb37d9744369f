// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/experiment/store.hpp"
#include "tests/end_to_end/program.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int kTrialsAndCeilings = 21;

/// configs/gate.yaml, recorded and swept once for all tests of the suite.
class Gate : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    expect_done(mapscore({"record", study(), "-o", recording(), "--jobs", "2", "-q"}));
    expect_done(sweep(reference(), {"--jobs", "2"}));
  }
  static void TearDownTestSuite() { shared_.reset(); }

  [[nodiscard]] static std::string study() { return MAPSCORE_SOURCE_DIR "/configs/gate.yaml"; }
  [[nodiscard]] static std::string recording() { return shared_->path() / "recording"; }
  [[nodiscard]] static std::string reference() { return shared_->path() / "reference"; }
  [[nodiscard]] static std::string baseline() { return shared_->path() / "baseline.csv"; }
  [[nodiscard]] std::string results() const { return own_.path() / "results"; }
  [[nodiscard]] std::string store() const { return results() + "/results.sqlite"; }

  /// Arguments that sweep the gate's recording into a folder.
  [[nodiscard]] static std::vector<std::string> sweep_arguments(
      const std::string& into, const std::vector<std::string>& flags) {
    std::vector<std::string> arguments{"sweep", study(), "--set", "recording=" + recording(),
                                       "-o",    into};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return arguments;
  }
  [[nodiscard]] static Outcome sweep(const std::string& into,
                                     const std::vector<std::string>& flags) {
    return mapscore(sweep_arguments(into, flags));
  }
  [[nodiscard]] static std::string tidy(const std::string& of) {
    const Outcome table = mapscore({"table", of, "--tidy"});
    expect_done(table);
    return table.out;
  }
  void expect_same_as_reference() const {
    const std::string expected = tidy(reference());
    EXPECT_THAT(expected, HasSubstr("trial,region_growing,2,0.02,pooled,f1,"));
    EXPECT_TRUE(tidy(results()) == expected) << "the tidy CSV differs";
  }
  [[nodiscard]] static Outcome check(const std::string& of, const std::vector<std::string>& flags) {
    std::vector<std::string> arguments{"check", of, "--baseline", baseline()};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return mapscore(arguments);
  }

  /// Trials in a store that another process may be writing; none while there is no store.
  [[nodiscard]] static std::size_t trials_in(const std::string& file) {
    try {
      return eval::ResultStore::open_existing(file).keys().size();
    } catch (const Error&) {
      return 0;
    }
  }

 private:
  inline static std::unique_ptr<TemporaryFolder> shared_;
  TemporaryFolder own_;
};

TEST_F(Gate, RecordingDoesNotDependOnJobs) {
  const std::string again = results();
  expect_done(mapscore({"record", study(), "-o", again, "--jobs", "1", "-q"}));
  ASSERT_EQ(contents_of(again), contents_of(recording()));
  for (const std::string& file : contents_of(again)) {
    if (fs::is_directory(fs::path(again) / file)) continue;
    EXPECT_TRUE(bytes_of(fs::path(again) / file) == bytes_of(fs::path(recording()) / file)) << file;
  }
}

TEST_F(Gate, ResultsDoNotDependOnJobs) {
  expect_done(sweep(results(), {"--jobs", "1"}));
  expect_same_as_reference();
}

TEST_F(Gate, ResultsDoNotDependOnMemory) {
  expect_done(sweep(results(), {"--memory", "300KB"}));
  expect_same_as_reference();
}

TEST_F(Gate, ResultsDoNotDependOnShards) {
  expect_done(sweep(results(), {"--shard", "2/2"}));
  EXPECT_EQ(trials_in(store()), kTrialsAndCeilings / 2u);
  expect_done(sweep(results(), {"--shard", "1/2"}));
  expect_same_as_reference();
}

TEST_F(Gate, ShardsThatStartAtOnceFromNothingRecordOnce) {
  const auto shard = [&](const char* part) {
    return mapscore_command({"sweep", study(), "-o", results(), "-q", "--shard", part});
  };
  Process first(shard("1/2")), second(shard("2/2"));
  expect_done(first.wait());
  expect_done(second.wait());
  expect_same_as_reference();
}

TEST_F(Gate, AKilledSweepGoesOnWhereItStopped) {
  Process sweep_to_kill(mapscore_command(sweep_arguments(results(), {"--jobs", "1"})));
  while (trials_in(store()) == 0 && !sweep_to_kill.ended())
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  ASSERT_TRUE(sweep_to_kill.kill()) << "it ended before it could be killed";
  EXPECT_EQ(mapscore({"table", results()}).exit_code, 2);

  const Outcome resumed = sweep(results(), {});
  expect_done(resumed);
  EXPECT_THAT(resumed.err, Not(HasSubstr("sweep gate: 21 trials computed")));
  EXPECT_THAT(resumed.err, Not(HasSubstr("sweep gate: 0 trials computed")));
  expect_same_as_reference();
}

TEST_F(Gate, ASecondSweepComputesNothingAnew) {
  const std::string before = bytes_of(reference() + "/results.sqlite");
  const Outcome again = sweep(reference(), {});
  expect_done(again);
  EXPECT_THAT(again.err, HasSubstr("sweep gate: 0 trials computed, 21 already there"));
  EXPECT_TRUE(bytes_of(reference() + "/results.sqlite") == before);
}

TEST_F(Gate, AnErrorOfHalfAVoxelFailsTheCheck) {
  expect_done(check(reference(), {"--write"}));
  expect_done(check(reference(), {}));

  std::vector<std::string> mutant{MAPSCORE_MUTANT};
  const auto arguments = sweep_arguments(results(), {"-q"});
  mutant.insert(mutant.end(), arguments.begin(), arguments.end());
  expect_done(Process(mutant).wait());
  const Outcome checked = check(results(), {});
  EXPECT_EQ(checked.exit_code, 1) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("what"));
  EXPECT_THAT(checked.out, HasSubstr("lattice_ceiling direct"));
  EXPECT_THAT(checked.out, HasSubstr("figures fell by more than"));
}

}  // namespace
}  // namespace mapscore::testing
