// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/runner.hpp"

#include "tests/eval/lab/tiny_experiment.hpp"
#include "tests/support/expect_error.hpp"

#include <fmt/format.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <map>
#include <new>
#include <stdexcept>

namespace mapscore::eval {
namespace {

/// Key -> everything that was stored.
using Results = std::map<std::string, std::string>;

class Runner : public testing::TinyExperiment {
 protected:
  [[nodiscard]] Plan plan_with_pose_noise() const {
    return plan(
        testing::study_of("  erosion: {segmentation: {erosion: {radius_px: 1}}}\n"
                          "fusion: {blend: {N: 3}}\n"
                          "faults: {pose: {sigma_xy_m: 0.02}}\n"
                          "sweep: {faults.misregistration.magnitude_m: [0, 0.02]}\n"
                          "seeds: 2\n"));
  }
  [[nodiscard]] ResultStore store(const std::string& name = "results") const {
    return ResultStore::open(folder() / (name + ".sqlite"));
  }
  [[nodiscard]] static Results results_of(const Plan& plan, const ResultStore& store) {
    Results results;
    for (std::size_t n = 0; n < plan.tasks.size(); ++n)
      if (const auto found = store.find(plan.tasks.key(n)))
        results[plan.tasks.key(n)] = to_json(*found);
    return results;
  }
  /// All results of the plan, from a store of its own.
  [[nodiscard]] Results run(const Plan& plan, const RunnerOptions& options,
                            const char* name) const {
    ResultStore results = store(name);
    const RunnerOutcome outcome = run_plan(plan, recording(), table(), results, options);
    EXPECT_EQ(outcome.computed, plan.tasks.size());
    EXPECT_EQ(outcome.reused, 0u);
    return results_of(plan, results);
  }
  [[nodiscard]] static RunnerOptions one_job() {
    RunnerOptions options;
    options.jobs = 1;
    return options;
  }
};

TEST_F(Runner, ResultsDoNotDependOnJobs) {
  const Plan plan = plan_with_pose_noise();
  RunnerOptions three = one_job();
  three.jobs = 3;
  const Results results = run(plan, one_job(), "one");
  EXPECT_EQ(results.size(), plan.tasks.size());
  EXPECT_EQ(run(plan, three, "three"), results);
}

TEST_F(Runner, ResultsOfAllKindsOfTrialsDoNotDependOnJobs) {
  const Plan all =
      plan(testing::study_of("  grown: {segmentation: {region_growing: {}}, fusion: {bayes: {}}}\n"
                             "  aligned: {segmentation: {edge_aligned: {}}}\n"
                             "  component: {segmentation: {largest_component: {}}}\n"
                             "  cluster: {segmentation: {dbscan: {}}}\n"
                             "  segments: {segmentation: {depth_segments: {min_segment_px: 20}}}\n"
                             "  refined: {segmentation: {direct: {}}, refinement: {crf: {}}}\n"
                             "fusion: {blend: {N: 3, decay: view}}\n"
                             "occupancy: {carve: true}\n"
                             "seeds: 2\n"));
  RunnerOptions four = one_job();
  four.jobs = 4;
  EXPECT_EQ(run(all, four, "four"), run(all, one_job(), "one"));
}

TEST_F(Runner, AFrameUnderFaultsIsMadeOnceForAllWhoSeeIt) {
  const Plan swept = plan(
      testing::study_of("  erosion: {segmentation: {erosion: {radius_px: 1}}}\n"
                        "faults: {depth: {preset: astra}}\n"
                        "sweep: {faults.depth.scale: [0.5, 1], faults.pose.sigma_xy_m: [0, 0.02]}\n"
                        "seeds: 2\n"));
  ResultStore results = store();
  const RunnerOutcome outcome = run_plan(swept, recording(), table(), results, one_job());
  EXPECT_EQ(outcome.computed, 2u * (2 * 4 + 2 + 1)) << "methods and cells, two kinds of ceilings";
  const std::size_t seen = 2 /* doses */ + 1 /* no fault */ + 1 /* exact, of lattice ceilings */;
  EXPECT_EQ(outcome.sights, 2 * seen * static_cast<std::size_t>(recording().frame_count()));
}

TEST_F(Runner, ResultsDoNotDependOnBlocksOfFrames) {
  const Plan plan = plan_with_pose_noise();
  const Results results = run(plan, one_job(), "whole");
  for (const std::size_t frames : {0u, 1u, 3u}) {
    RunnerOptions tight = one_job();
    tight.jobs = 2;
    tight.memory_bytes = frames * 64 * 48 * 3 * sizeof(std::uint16_t);
    EXPECT_EQ(run(plan, tight, std::to_string(frames).c_str()), results) << frames;
  }
}

TEST_F(Runner, ShardsShareTheTasksOut) {
  const Plan plan = plan_with_pose_noise();
  ResultStore results = store();
  std::size_t computed = 0;
  for (const int shard : {2, 3, 1}) {
    RunnerOptions options = one_job();
    options.shard = shard;
    options.shards = 3;
    computed += run_plan(plan, recording(), table(), results, options).computed;
    EXPECT_EQ(results.builds().size(), computed);
  }
  EXPECT_EQ(computed, plan.tasks.size());
  EXPECT_EQ(results_of(plan, results), run(plan, one_job(), "whole"));
}

TEST_F(Runner, AShardIsASliceThatKeepsSeedsTogether) {
  const TaskList tasks = plan_with_pose_noise().tasks;
  const auto seeds_of = [&](int shard, int shards) {
    std::vector<int> seeds;
    for (const std::size_t position : missing_tasks(tasks, {}, shard, shards))
      seeds.push_back(tasks.seed_index(position));
    return seeds;
  };
  const int half = static_cast<int>(tasks.size() / 2);
  EXPECT_EQ(seeds_of(1, 2), std::vector<int>(static_cast<std::size_t>(half), 0));
  EXPECT_EQ(seeds_of(2, 2), std::vector<int>(static_cast<std::size_t>(half), 1));
  std::size_t sum = 0;  // of shards of which some are empty
  for (int shard = 1; shard <= 99; ++shard) sum += seeds_of(shard, 99).size();
  EXPECT_EQ(sum, tasks.size());
}

TEST_F(Runner, SlicesStayWhereTheyAreWhateverIsHeld) {
  const TaskList tasks = plan_with_pose_noise().tasks;
  const auto second = missing_tasks(tasks, {}, 2, 3);
  const std::unordered_set<std::string> held{tasks.key(0), tasks.key(second.front())};
  const auto left = missing_tasks(tasks, held, 2, 3);
  EXPECT_EQ(left, std::vector<std::size_t>(second.begin() + 1, second.end()));
  std::vector<std::size_t> counts;
  for (int shard = 1; shard <= 3; ++shard)
    counts.push_back(missing_tasks(tasks, held, shard, 3).size());
  EXPECT_EQ(missing_by_shard(tasks, held, 3), counts);
}

TEST_F(Runner, WhatIsHeldElsewhereIsNotComputed) {
  const Plan plan = plan_with_pose_noise();
  ResultStore results = store();
  RunnerOptions options = one_job();
  options.held_elsewhere = {plan.tasks.key(0), plan.tasks.key(3)};
  const RunnerOutcome outcome = run_plan(plan, recording(), table(), results, options);
  EXPECT_EQ(outcome.computed, plan.tasks.size() - 2);
  EXPECT_FALSE(results.find(plan.tasks.key(3)));
}

TEST_F(Runner, WhatTheStoreHoldsIsNotComputedAgain) {
  const Plan plan = plan_with_pose_noise();
  ResultStore results = store();
  TrialResult mark;
  mark.accounting.points = 123456789;
  results.add(plan.tasks[1].key, "", mark);
  const RunnerOutcome outcome = run_plan(plan, recording(), table(), results, one_job());
  EXPECT_EQ(outcome.computed, plan.tasks.size() - 1);
  EXPECT_EQ(outcome.reused, 1u);
  EXPECT_EQ(results.find(plan.tasks[1].key)->accounting.points, 123456789);
  EXPECT_EQ(run_plan(plan, recording(), table(), results, one_job()).computed, 0u);
}

TEST_F(Runner, WhatAnotherBuildMadeIsComputedAnewUnlessItIsKept) {
  const Plan plan = plan_with_pose_noise();
  const std::size_t all = plan.tasks.size();
  TrialResult mark;
  mark.accounting.points = 123456789;
  {
    ResultStore other = ResultStore::open(folder() / "results.sqlite", "another build");
    for (std::size_t n = 0; n < all; ++n) other.add(plan.tasks[n].key, "", mark);
  }
  ResultStore results = store();
  RunnerOptions keeping = one_job();
  keeping.keep_builds = true;
  EXPECT_EQ(run_plan(plan, recording(), table(), results, keeping).computed, 0u);
  EXPECT_EQ(run_plan(plan, recording(), table(), results, one_job()).computed, all);
  EXPECT_EQ(results_of(plan, results), run(plan, one_job(), "whole"));
  EXPECT_EQ(run_plan(plan, recording(), table(), results, one_job()).computed, 0u);
}

TEST_F(Runner, TellsItsProgressInFrameEvaluations) {
  const Plan plan = plan_with_pose_noise();
  ResultStore results = store();
  std::atomic<std::int64_t> calls{0}, most{0};
  RunnerOptions options = one_job();
  options.jobs = 2;
  const auto whole = static_cast<std::int64_t>(plan.tasks.size()) * recording().frame_count();
  options.progress = [&](std::int64_t done, std::int64_t total) {
    ++calls;
    if (done == total) most = done;
    EXPECT_EQ(total, whole);
  };
  run_plan(plan, recording(), table(), results, options);
  EXPECT_EQ(calls, whole);
  EXPECT_EQ(most, whole);
}

TEST_F(Runner, AnExceptionOfAWorkerIsRethrownAndWhatWasDoneStays) {
  const Plan plan = plan_with_pose_noise();
  ResultStore results = store();
  RunnerOptions options = one_job();
  options.jobs = 2;
  options.progress = [](std::int64_t done, std::int64_t) {
    if (done == 21) throw std::runtime_error("enough");
  };
  EXPECT_THROW(run_plan(plan, recording(), table(), results, options), std::runtime_error);
  const std::size_t done = results.builds().size();
  EXPECT_GT(done, 0u);
  EXPECT_LT(done, plan.tasks.size());
  const RunnerOutcome rest = run_plan(plan, recording(), table(), results, one_job());
  EXPECT_EQ(rest.computed, plan.tasks.size() - done);
}

TEST_F(Runner, OutOfMemoryInATrialSaysWhatHelps) {
  ResultStore results = store();
  RunnerOptions options = one_job();
  options.progress = [](std::int64_t, std::int64_t) { throw std::bad_alloc(); };
  mapscore::testing::expect_error("out of memory in a trial; use fewer --jobs", [&] {
    run_plan(plan_with_pose_noise(), recording(), table(), results, options);
  });
}

/// The trajectory of the second cell covers the first frame alone.
TEST_F(Runner, AFailingTrialCostsThatTrialAlone) {
  const auto write = [&](const char* name, const char* end) {
    std::ofstream file(folder() / name);
    for (const char* stamp : {"0", end}) file << stamp << " 0 0 0 0 0 0 1\n";
  };
  write("whole.txt", "10");
  write("short.txt", "0.1");
  const Plan swept = plan(testing::study_of(
      fmt::format("localization: {{source: trajectory, trajectory: {0}/whole.txt}}\n"
                  "sweep: {{localization.trajectory: [{0}/whole.txt, {0}/short.txt]}}\n",
                  folder().string())));
  ResultStore results = store();
  RunnerOptions options = one_job();
  std::size_t computed = 0, failed = 0;
  options.ended = [&](std::size_t c, std::size_t f) { computed = c, failed = f; };
  std::int64_t done = 0, total = 1;
  options.progress = [&](std::int64_t d, std::int64_t t) { done = d, total = t; };
  const RunnerOutcome outcome = run_plan(swept, recording(), table(), results, options);
  EXPECT_EQ(outcome.computed, swept.tasks.size() - 1);
  ASSERT_EQ(outcome.failures.size(), 1u);
  const TrialFailure& failure = outcome.failures.front();
  EXPECT_EQ(failure.key, swept.tasks.key(swept.trials[1].task));
  EXPECT_NE(failure.reason.find("short.txt"), std::string::npos) << failure.reason;
  EXPECT_EQ(results.failures(),
            (std::map<std::string, std::string>{{failure.key, failure.reason}}));
  EXPECT_EQ(computed, outcome.computed);
  EXPECT_EQ(failed, 1u);
  EXPECT_EQ(done, total) << "what failed is not waited for";
  EXPECT_EQ(run_plan(swept, recording(), table(), results, one_job()).failures.size(), 1u)
      << "tried again";
}

TEST_F(Runner, ABrokenImageFailsAllThatNeedItAndIsMended) {
  const auto image = folder() / "tiny/depth/000002.png";
  const auto kept = folder() / "kept.png";
  std::filesystem::copy_file(image, kept);
  std::ofstream(image) << "broken";
  const Plan all = plan_with_pose_noise();
  ResultStore results = store();
  const RunnerOutcome broken = run_plan(all, recording(), table(), results, one_job());
  EXPECT_EQ(broken.failures.size(), all.tasks.size());
  for (const TrialFailure& failure : broken.failures)
    EXPECT_NE(failure.reason.find("depth/000002.png"), std::string::npos) << failure.reason;
  EXPECT_TRUE(results.keys().empty());
  EXPECT_EQ(results.failures().size(), all.tasks.size());
  std::filesystem::copy_file(kept, image, std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(run_plan(all, recording(), table(), results, one_job()).computed, all.tasks.size());
  EXPECT_TRUE(results.failures().empty());
}

TEST_F(Runner, StopsBeforeTheNextFrameAndGoesOnLater) {
  const Plan all = plan_with_pose_noise();
  ResultStore results = store();
  RunnerOptions options = one_job();
  int frames = 0;
  options.stop = [&] { return ++frames > 9; };
  const RunnerOutcome outcome = run_plan(all, recording(), table(), results, options);
  EXPECT_TRUE(outcome.stopped);
  EXPECT_GT(outcome.computed, 0u);
  EXPECT_EQ(outcome.computed, results.keys().size());
  EXPECT_LT(outcome.computed, all.tasks.size());
  const RunnerOutcome rest = run_plan(all, recording(), table(), results, one_job());
  EXPECT_FALSE(rest.stopped);
  EXPECT_EQ(rest.computed, all.tasks.size() - outcome.computed);
}

}  // namespace
}  // namespace mapscore::eval
