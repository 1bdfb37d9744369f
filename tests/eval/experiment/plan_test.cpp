// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/plan.hpp"

#include "tests/eval/experiment/tiny_experiment.hpp"
#include "tests/eval/recording/expect_error.hpp"

#include <gmock/gmock.h>

#include <set>

namespace mapscore::eval {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::study_of;

const std::string kTwoMethods = "  erosion: {segmentation: {erosion: {radius_px: 2}}}\n";

/// The key of the first trial of a study.
std::string key_of(const Study& study, const std::string& recording = "recording") {
  const Plan plan = plan_of(study, recording);
  return plan.tasks.at(plan.trials.at(0).task).key;
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
  for (const Task& task : plan.tasks) keys.insert(task.key);
  EXPECT_EQ(keys.size(), plan.tasks.size());
}

TEST(Plan, CeilingsAreTheMethodWithoutFaultsAndTheTrueLabels) {
  const Plan plan =
      plan_of(study_of("faults: {misregistration: {magnitude_m: 0.01}, pose: {sigma_xy_m: 0.1}}\n"
                       "seeds: 2\n"),
              "recording");
  ASSERT_EQ(plan.tasks.size(), 6u);
  for (const PlannedTrial& trial : plan.trials) {
    const Task& task = plan.tasks[trial.task];
    const Task& registration = plan.tasks[trial.registration_ceiling];
    const Task& lattice = plan.tasks[trial.lattice_ceiling];
    EXPECT_EQ(task.config.faults.misregistration.magnitude_m, 0.01);
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
  for (const PlannedTrial& trial : plan.trials) {
    EXPECT_EQ(task_of(study, trial.spec, Labels::detected, "recording").key,
              plan.tasks[trial.task].key);
    EXPECT_EQ(task_of(study, trial.spec, Labels::truth, "recording").labels, Labels::truth);
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
  for (const PlannedTrial& trial : plan.trials) keys.insert(plan.tasks[trial.task].key);
  EXPECT_EQ(keys.size(), 6u);
}

TEST(Plan, KeysNameTheScoringVersionAndTheRecordingButNoPlace) {
  const Task task = plan_of(study_of("scene: rooms/here.xml\n"), "0123abcd").tasks.at(0);
  EXPECT_THAT(task.description, HasSubstr("scoring_version: " + std::to_string(kScoringVersion)));
  EXPECT_THAT(task.description, HasSubstr("recording: 0123abcd"));
  EXPECT_THAT(task.description, Not(HasSubstr("here.xml")));
}

/// So that what was swept before there was such a leaf is not computed again.
TEST(Plan, KeysNameInstancesOnlyWhereTheyAreScored) {
  const auto description = [](const char* score) {
    return plan_of(study_of(score), "recording").tasks.at(0).description;
  };
  EXPECT_THAT(description(""), Not(HasSubstr("instances")));
  EXPECT_EQ(description("score: {instances: false}\n"), description(""));
  EXPECT_THAT(description("score: {instances: true}\n"), HasSubstr("\n  instances: true\n"));
}

TEST(Plan, RefusesASweepOfWhatIsRecorded) {
  mapscore::testing::expect_error("sweep.cameras.width_px: decides what is recorded", [] {
    (void)plan_of(study_of("sweep: {cameras.width_px: [64, 128]}\n"), "recording");
  });
}

}  // namespace
}  // namespace mapscore::eval
