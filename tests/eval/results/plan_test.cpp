// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/plan.hpp"

#include "eval/score/counts.hpp"
#include "files/file_bytes.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"
#include "tests/support/expect_error.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::study_of;

const std::string kTwoMethods = "  erosion: {segmentation: {erosion: {radius_px: 2}}}\n";

/// The key of the first trial of a study.
std::string key_of(const Study& study, const std::string& recording = "recording") {
  const Plan plan = plan_of(study, recording);
  return plan.tasks[plan.trials[0].task].key;
}

TEST(Plan, SharesItsCeilings) {
  const Plan plan = plan_of(
      study_of(kTwoMethods + "sweep: {faults.misregistration.magnitude_m: [0, 0.01, 0.02]}\n"
                             "seeds: 2\n"),
      "recording");
  EXPECT_EQ(plan.trials.size(), 3u * 2u * 2u);
  // 3 doses x 2 seeds x 2 methods; dose 0 is the registration ceiling; a lattice ceiling a seed.
  EXPECT_EQ(plan.tasks.size(), 12u + 2u);
  std::set<std::string> keys;
  for (std::size_t n = 0; n < plan.tasks.size(); ++n) keys.insert(plan.tasks.key(n));
  EXPECT_EQ(keys.size(), plan.tasks.size());
}

TEST(Plan, CeilingsAreTheMethodWithoutFaultsAndTheTrueLabels) {
  const Plan plan =
      plan_of(study_of("faults: {misregistration: {magnitude_m: 0.01}, pose: {sigma_xy_m: 0.1}}\n"
                       "seeds: 2\n"),
              "recording");
  ASSERT_EQ(plan.tasks.size(), 6u);
  for (const PlannedTrial trial : plan.trials) {
    const Task task = plan.tasks[trial.task];
    const Task registration = plan.tasks[trial.registration_ceiling];
    const Task lattice = plan.tasks[trial.lattice_ceiling];
    EXPECT_EQ(task.config.faults.misregistration.rigid.magnitude_m, 0.01);
    EXPECT_EQ(registration.config.faults, FaultSettings{});
    EXPECT_EQ(registration.config.methods, task.config.methods);
    EXPECT_EQ(registration.labels, Labels::detected);
    EXPECT_EQ(lattice.config.faults, FaultSettings{});
    EXPECT_EQ(lattice.config.fusion, task.config.fusion);
    EXPECT_EQ(lattice.labels, Labels::truth);
    for (const Task* of_trial : {&task, &registration, &lattice})
      EXPECT_EQ(of_trial->seed_index, trial.spec.seed_index);
  }
}

TEST(Plan, ATrialByItselfIsTheOneOfThePlan) {
  const Study study =
      study_of(kTwoMethods + "sweep: {faults.misregistration.magnitude_m: [0, 0.01]}\nseeds: 2\n");
  const Plan plan = plan_of(study, "recording");
  for (const PlannedTrial trial : plan.trials) {
    EXPECT_EQ(task_of(study, trial.spec, Labels::detected, "recording").key,
              plan.tasks[trial.task].key);
    EXPECT_EQ(task_of(study, trial.spec, Labels::truth, "recording").labels, Labels::truth);
  }
}

TEST(Plan, SingleTrialsAreThoseOfThePlanWithoutCeilings) {
  const Study study =
      study_of(kTwoMethods + "sweep: {faults.misregistration.magnitude_m: [0, 0.01]}\nseeds: 9\n");
  const Plan plan = plan_of(study, "recording");
  std::vector<TrialSpec> specs;
  std::vector<std::string> keys;
  for (const PlannedTrial trial : plan.trials)
    if (trial.spec.seed_index % 4 == 3) {
      specs.push_back(trial.spec);
      keys.push_back(plan.tasks.key(trial.task));
    }
  ASSERT_EQ(specs.size(), 8u);
  specs.push_back(specs.front());  // asked for twice, made once
  keys.push_back(keys.front());
  const TrialTasks single = tasks_of_trials(study, specs, "recording");
  EXPECT_EQ(single.tasks.size(), 8u);
  ASSERT_EQ(single.positions.size(), 9u);
  for (std::size_t n = 0; n < specs.size(); ++n) {
    EXPECT_EQ(single.tasks.key(single.positions[n]), keys[n]);
    EXPECT_EQ(single.tasks.seed_index(single.positions[n]), specs[n].seed_index);
  }
}

TEST(Plan, KeysDoNotDependOnNamesOrOnWhatElseTheStudyHolds) {
  const std::string key = key_of(study_of(""));
  EXPECT_EQ(key_of(study_of("name: another\n")), key);
  EXPECT_EQ(key_of(study_of("seeds: 7\n")), key);
  EXPECT_EQ(key_of(study_of(kTwoMethods)), key);
  EXPECT_EQ(key_of(study_of("sweep: {faults.misregistration.magnitude_m: [0, 0.01]}\n")), key);
  Study renamed = study_of("");
  renamed.methods[0].name = "plain";
  renamed.methods[0].title = "Plain segmentation";
  renamed.class_titles["crate"] = "box";
  renamed.recording = "/moved/elsewhere";
  EXPECT_EQ(key_of(renamed), key);
}

TEST(Plan, KeysDependOnEverythingThatDecidesTheResult) {
  std::set<std::string> keys{key_of(study_of("")), key_of(study_of(""), "another recording")};
  const std::vector<std::string> changes{"seed=2",
                                         "voxel_m=0.04",
                                         "place=voxels",
                                         "map_origin_m=[0, 0, 0.01]",
                                         "map_yaw_deg=1",
                                         "detect=[wall]",
                                         "fusion.blend.K=0.4",
                                         "fusion.blend.N=2",
                                         "fusion.blend.noise_at=odom",
                                         "faults.misregistration.magnitude_m=0.001",
                                         "faults.misregistration.angle_deg=0.1",
                                         "faults.misregistration.focal_error_percent=1",
                                         "faults.mount.magnitude_m=0.001",
                                         "faults.pose.sigma_xy_m=0.01",
                                         "faults.pose.reported_scale=2",
                                         "faults.pose.kind=walk",
                                         "score.unit=frame",
                                         "score.threshold=0.3",
                                         "score.min_samples=4",
                                         "score.epsilon_m=0",
                                         "score.tolerances=[0, 2]",
                                         "score.distances_m=[0.03]",
                                         "score.instances=true"};
  for (const std::string& change : changes) keys.insert(key_of(study_of("", {change})));
  EXPECT_EQ(keys.size(), 2 + changes.size());
}

TEST(Plan, EachSeedAndEachDoseHasAKeyOfItsOwn) {
  const Plan plan = plan_of(
      study_of("sweep: {faults.misregistration.magnitude_m: [0.01, 0.02]}\nseeds: 3\n"), "r");
  std::set<std::string> keys;
  for (const PlannedTrial trial : plan.trials) keys.insert(plan.tasks.key(trial.task));
  EXPECT_EQ(keys.size(), 6u);
}

TEST(Plan, KeysNameTheScoringVersionAndTheRecordingButNoPlace) {
  const Task task = plan_of(study_of("scene: rooms/here.xml\n"), "0123abcd").tasks[0];
  EXPECT_THAT(task.description, HasSubstr("scoring_version: " + std::to_string(kScoringVersion)));
  EXPECT_THAT(task.description, HasSubstr("recording: 0123abcd"));
  EXPECT_THAT(task.description, Not(HasSubstr("here.xml")));
}

/// So that a change of the CRF makes only those trials new.
TEST(Plan, KeysNameTheCrfsVersionOnlyWhereThereIsACrf) {
  const auto description = [](const std::string& refinement, Labels labels) {
    const Study study = study_of("", {"methods.direct.refinement=" + refinement});
    return task_of(study, trials(study)[0], labels, "recording").description;
  };
  EXPECT_THAT(description("{crf: {}}", Labels::detected), HasSubstr("\ncrf: 2\n"));
  EXPECT_THAT(description("{none: {}}", Labels::detected), Not(HasSubstr("\ncrf: 2\n")));
  EXPECT_THAT(description("{crf: {}}", Labels::truth), Not(HasSubstr("\ncrf: 2\n")));
}

/// So that what was swept before there was such a leaf is not computed again.
TEST(Plan, KeysNameInstancesOnlyWhereTheyAreScored) {
  const auto description = [](const char* score) {
    return plan_of(study_of(score), "recording").tasks[0].description;
  };
  EXPECT_THAT(description(""), Not(HasSubstr("instances")));
  EXPECT_EQ(description("score: {instances: false}\n"), description(""));
  EXPECT_THAT(description("score: {instances: true}\n"), HasSubstr("\n  instances: true\n"));
}

/// So that no other trial is computed again.
TEST(Plan, KeysNameTheRevisedMeanOfScoresOnlyWhereItIsAskedFor) {
  const auto description = [](const char* labels) {
    return plan_of(study_of(fmt::format("faults: {{labels: {}}}\n", labels)), "recording")
        .tasks[0]
        .description;
  };
  const auto revised = HasSubstr("\nlabel_scores: 2\n");
  EXPECT_THAT(description("{scores: 1, score_mean: 0.8}"), revised);
  EXPECT_THAT(description("{preset: typical, score_mean: 0.8}"), revised);
  for (const char* labels : {"{}", "{preset: typical}", "{scores: 1, confusion: 0.2}",
                             "{confusion: 0.2, score_mean: 0.8}"})
    EXPECT_THAT(description(labels), Not(HasSubstr("label_scores"))) << labels;
}

TEST(Plan, KeysNameTheRevisedRootOnlyWhereACovarianceMayBeCorrelated) {
  const auto description = [](const std::string& lines) {
    return plan_of(study_of(lines), "recording").tasks[0].description;
  };
  const auto noise = [](const char* xy) {
    return fmt::format(
        "faults: {{pose: {{covariance_m_rad: [[.01,{0},0,0,0,0],[{0},.01,0,0,0,0],[0,0,0,0,0,0],"
        "[0,0,0,0,0,0],[0,0,0,0,0,0],[0,0,0,0,0,0]]}}}}\n",
        xy);
  };
  const std::string full = "fusion: {vote: {N: 2, covariance: full}}\n",
                    odometry = "localization: {source: odometry}\n";
  const auto revised = HasSubstr("\ncovariance_root: 2\n");
  for (const std::string& lines : {noise("0.001"), noise("0.001") + full, odometry + full})
    EXPECT_THAT(description(lines), revised) << lines;
  for (const std::string& lines :
       {std::string(), full, odometry, noise("0") + full, noise("0.001") + odometry,
        "faults: {pose: {sigma_xy_m: 0.1}}\n" + full})
    EXPECT_THAT(description(lines), Not(revised)) << lines;
}

TEST(Plan, RefusesASweepOfWhatIsRecorded) {
  mapscore::testing::expect_error("sweep.cameras.width_px: decides what is recorded", [] {
    (void)plan_of(study_of("sweep: {cameras.width_px: [64, 128]}\n"), "recording");
  });
}

TEST(Plan, RefusesASweepOfTheDetectedSetWhichAllTrialsShare) {
  mapscore::testing::expect_error("sweep.detect: all trials of a sweep have one detected set", [] {
    (void)plan_of(study_of("sweep: {detect: [all, [cup]]}\n"), "recording");
  });
}

/// A plan that is written down task by task, each merged by its key: what TaskList counts out.
struct PlainPlan {
  std::vector<Task> tasks;
  std::vector<std::array<std::size_t, 3>> trials;  ///< task, registration and lattice ceiling
};

PlainPlan plain_plan_of(const Study& study) {
  PlainPlan plan;
  std::map<std::string, std::size_t> positions;
  const auto add = [&](const Task& task) {
    const auto [entry, is_new] = positions.try_emplace(task.key, plan.tasks.size());
    if (is_new) plan.tasks.push_back(task);
    return entry->second;
  };
  for (const Cell& cell : cells(study)) {
    Study faultless = resolve(study, cell);
    faultless.localization = {};
    faultless.faults = {};
    for (int seed = 0; seed < study.seeds; ++seed) {
      for (const MethodSettings& method : study.methods) {
        const TrialSpec spec{0, method.name, cell, seed}, plain{0, method.name, {}, seed};
        const std::size_t task = add(task_of(study, spec, Labels::detected, "recording"));
        const std::size_t ceiling = add(task_of(faultless, plain, Labels::detected, "recording"));
        plan.trials.push_back(
            {task, ceiling, add(task_of(study, spec, Labels::truth, "recording"))});
      }
    }
  }
  return plan;
}

TEST(Plan, CountsOutTheTasksOfThePlainOne) {
  const std::filesystem::path configs = std::filesystem::path(MAPSCORE_SOURCE_DIR) / "configs";
  for (const char* name : {"demo", "covariance", "crf", "paper_fusion_labels", "paper_fusion_pose",
                           "person_offset", "segmentation_person"})
    for (const char* more : {"seeds=3", "sweep.voxel_m=[0.05, 0.1]"}) {  // which ceilings have too
      const Study study = load_study(configs / (std::string(name) + ".yaml"), {"seeds=3", more});
      const PlainPlan plain = plain_plan_of(study);
      const Plan plan = plan_of(study, "recording");
      ASSERT_EQ(plan.tasks.size(), plain.tasks.size()) << name;
      ASSERT_EQ(plan.trials.size(), plain.trials.size()) << name;
      for (std::size_t n = 0; n < plain.tasks.size(); ++n) {
        const Task task = plan.tasks[n];
        ASSERT_EQ(task.key, plain.tasks[n].key) << name << " task " << n;
        ASSERT_EQ(plan.tasks.key(n), task.key);
        ASSERT_EQ(task.description, plain.tasks[n].description);
        ASSERT_EQ(task.config.methods, plain.tasks[n].config.methods);
        ASSERT_EQ(task.labels, plain.tasks[n].labels);
        ASSERT_EQ(task.seed_index, plain.tasks[n].seed_index);
        ASSERT_EQ(plan.tasks.seed_index(n), task.seed_index);
        ASSERT_EQ(plan.tasks.config(n), task.config);
      }
      for (std::size_t n = 0; n < plain.trials.size(); ++n) {
        const PlannedTrial trial = plan.trials[n];
        ASSERT_EQ((std::array{trial.task, trial.registration_ceiling, trial.lattice_ceiling}),
                  plain.trials[n])
            << name << " trial " << n;
        ASSERT_EQ(trial.spec, trials(study)[n]);
      }
    }
}

TEST(Plan, OfAKeyIsTheHashOfTheDescriptionWithTheSeedsIndex) {
  const Plan plan = plan_of(study_of("seeds: 12\n"), "recording");
  const std::string first = plan.tasks[0].description;
  for (const PlannedTrial trial : plan.trials) {
    const Task task = plan.tasks[trial.task];
    std::string description = first;
    description.replace(first.find("seed_index: 0\n"), 13,
                        "seed_index: " + std::to_string(trial.spec.seed_index));
    EXPECT_EQ(task.description, description);
    EXPECT_EQ(task.key, hash_of(description));
  }
}

/// Written down, these tasks and their descriptions would take gigabytes.
TEST(Plan, OfAMillionTrialsIsCountedOutToo) {
  const Study study = study_of(
      "sweep: {voxel_m: [.01, .02, .03, .04, .05, .06, .07, .08, .09, .1]}\n"
      "seeds: 100000\n");
  const Plan plan = plan_of(study, "recording");
  EXPECT_EQ(plan.trials.size(), 1000000u);
  EXPECT_EQ(plan.tasks.size(), 2000000u);  // without a fault a trial is its registration ceiling
  const PlannedTrial last = plan.trials[999999];
  EXPECT_EQ(last.spec.seed_index, 99999);
  EXPECT_EQ(plan.tasks.key(last.task),
            task_of(study, last.spec, Labels::detected, "recording").key);
  EXPECT_EQ(plan.tasks.key(last.lattice_ceiling),
            task_of(study, last.spec, Labels::truth, "recording").key);
}

}  // namespace
}  // namespace mapscore::eval
