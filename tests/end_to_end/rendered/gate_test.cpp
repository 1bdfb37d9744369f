// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/results/store.hpp"
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

using Arguments = std::vector<std::string>;

constexpr const char* kGate = MAPSCORE_SOURCE_DIR "/configs/gate.yaml";

Arguments joined(Arguments first, const Arguments& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Runs the mapscore that is wrong by half a voxel.
Outcome mutant(const Arguments& arguments) {
  return Process(joined({MAPSCORE_MUTANT}, arguments)).wait();
}

void expect_fallen(const Outcome& checked) {
  EXPECT_EQ(checked.exit_code, 1) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("verdict"));
  EXPECT_THAT(checked.out, HasSubstr("lattice ceiling"));
  EXPECT_THAT(checked.out, HasSubstr("figures got worse"));
}

/// The gate in the corner of a room, whose few surfaces take a fifth of the time of a home's,
/// recorded and swept once for all tests of the suite. Methods, doses and seeds are the gate's.
class Gate : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    expect_done(record(recording(), {"--jobs", "2"}));
    expect_done(sweep(reference(), {"--jobs", "2"}));
  }
  static void TearDownTestSuite() { shared_.reset(); }

  [[nodiscard]] static std::string recording() { return shared_->path() / "recording"; }
  [[nodiscard]] static std::string reference() { return shared_->path() / "reference"; }
  [[nodiscard]] std::string results() const { return own_.path() / "results"; }
  [[nodiscard]] std::string store() const { return results() + "/results.sqlite"; }

  /// Flags that take the gate into the corner.
  [[nodiscard]] static Arguments corner() {
    return {"--set", "scene=" MAPSCORE_SOURCE_DIR "/tests/independent/corner.xml",
            "--set", "robot=" MAPSCORE_SOURCE_DIR "/scenes/robot.xml",
            "--set", "trajectory.waypoints_m_deg=[[0.213, 0.317, 37], [0.423, 1.437, 3]]",
            "--set", "trajectory.frames_per_s=2"};
  }
  [[nodiscard]] static Outcome record(const std::string& into, const Arguments& flags) {
    return mapscore(joined({"record", kGate, "-o", into, "-q"}, joined(corner(), flags)));
  }
  /// Arguments that sweep the recording into a folder.
  [[nodiscard]] static Arguments sweep_arguments(const std::string& into, const Arguments& flags) {
    return joined({"sweep", kGate, "--set", "recording=" + recording(), "-o", into}, flags);
  }
  [[nodiscard]] static Outcome sweep(const std::string& into, const Arguments& flags) {
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

  /// Trials in a store that another process may be writing; none while there is no store.
  [[nodiscard]] static std::size_t trials_in(const std::string& file) {
    try {
      return eval::ResultStore::open_existing(file).builds().size();
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
  expect_done(record(again, {"--jobs", "1"}));
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
  expect_done(sweep(results(), {"--shard", "1/2"}));
  EXPECT_EQ(trials_in(store()), 0u) << "each has a folder of its own";
  const Outcome whole = sweep(results(), {});
  expect_done(whole);
  EXPECT_THAT(whole.err, HasSubstr("21 trials taken over from shards"));
  EXPECT_THAT(whole.err, HasSubstr("sweep gate: 0 trials computed"));
  expect_same_as_reference();
}

TEST_F(Gate, ShardsThatStartAtOnceFromNothingRecordOnce) {
  const auto shard = [&](const char* part) {
    return mapscore_command(
        joined({"sweep", kGate, "-o", results(), "-q", "--shard", part}, corner()));
  };
  Process first(shard("1/2")), second(shard("2/2"));
  expect_done(first.wait());
  expect_done(second.wait());
  expect_done(mapscore(joined({"sweep", kGate, "-o", results(), "-q", "--merge_only"}, corner())));
  expect_same_as_reference();
}

TEST_F(Gate, AKilledSweepGoesOnWhereItStopped) {
  bool killed = false;
  for (int attempt = 0; attempt < 5 && !killed; ++attempt) {  // a busy machine may wake us too late
    std::filesystem::remove_all(results());
    Process sweep_to_kill(mapscore_command(sweep_arguments(results(), {"--jobs", "1"})));
    while (trials_in(store()) == 0 && !sweep_to_kill.ended())
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    killed = sweep_to_kill.kill();
  }
  ASSERT_TRUE(killed) << "it ended each time before it could be killed";
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

// Many draws of a frame are placed in another way than one.
TEST_F(Gate, AnErrorOfHalfAVoxelInManyDrawsFailsTheCheck) {
  const std::string right = results() + "/right", wrong = results() + "/wrong";
  const Arguments draws{"--set", "fusion.blend.N=4"};
  expect_done(sweep(right, draws));
  expect_done(mutant(sweep_arguments(wrong, draws)));
  expect_done(mapscore({"check", right, "--baseline", right + ".json", "--update"}));
  expect_fallen(mutant({"check", wrong, "--baseline", right + ".json"}));
  expect_refused(mapscore({"check", wrong, "--baseline", right + ".json"}),
                 {wrong, "its trials were made by build", "--any_build"});
  expect_fallen(mapscore({"check", wrong, "--baseline", right + ".json", "--any_build"}));
}

TEST_F(Gate, TrialsOfAnotherBuildAreComputedAnew) {
  const std::string baseline = results() + ".json";
  expect_done(sweep(results(), {}));
  expect_done(mapscore({"check", results(), "--baseline", baseline, "--update"}));

  const Outcome kept = mutant(sweep_arguments(results(), {"--keep_builds"}));
  expect_done(kept);
  EXPECT_THAT(kept.err, HasSubstr("21 trials were made by another build; kept"));
  expect_same_as_reference();
  expect_refused(mutant({"check", results(), "--baseline", baseline}), {"made by build"});

  const Outcome anew = mutant(sweep_arguments(results(), {}));
  expect_done(anew);
  EXPECT_THAT(anew.err, HasSubstr("21 trials were made by another build; computed anew"));
  EXPECT_THAT(anew.err, HasSubstr("sweep gate: 21 trials computed"));
  expect_fallen(mutant({"check", results(), "--baseline", baseline}));

  expect_done(sweep(results(), {"--set", "seeds=1"}));
  expect_done(mutant(sweep_arguments(results(), {"--keep_builds"})));
  expect_refused(mapscore({"check", results(), "--baseline", baseline}),
                 {"its trials were made by 2 builds"});
}

// The very study that CI holds against its baseline.
TEST(WholeGate, AnErrorOfHalfAVoxelFailsTheCheck) {
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  const auto sweep_into = [&](const char* results) {
    return Arguments{"sweep", kGate,        "--set", "recording=" + path("recording"),
                     "-o",    path(results)};
  };
  expect_done(mapscore({"record", kGate, "-o", path("recording"), "-q"}));
  expect_done(mapscore(sweep_into("right")));
  const Arguments check{"--baseline", path("baseline.json")};
  expect_done(mapscore(joined({"check", path("right"), "--update", "--frames"}, check)));
  expect_done(mapscore(joined({"check", path("right")}, check)));

  expect_done(mutant(sweep_into("wrong")));
  const Outcome fallen =
      mutant(joined({"check", path("wrong"), "--pictures", path("pictures")}, check));
  expect_fallen(fallen);
  EXPECT_THAT(fallen.out, ::testing::ContainsRegex("frames that lost most by themselves .* of "
                                                   ".*, first seed, .*: frame [0-9]+ found"));
  for (const char* picture : {"errors.png", "frames.png"})
    EXPECT_TRUE(fs::exists(folder.path() / "pictures" / picture)) << picture;

  fs::remove_all(path("recording"));  // no frames, but the verdict stays
  const Outcome untraced = mutant(joined({"check", path("wrong")}, check));
  expect_fallen(untraced);
  EXPECT_THAT(untraced.err, HasSubstr("check: frames are not traced: "));
  EXPECT_THAT(untraced.out, Not(HasSubstr("by themselves")));
}

}  // namespace
}  // namespace mapscore::testing
