// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/fusion/fusion_rule.hpp"
#include "eval/lab/runner.hpp"
#include "eval/lab/trial_run.hpp"
#include "eval/render/replay_check.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"

#include <gmock/gmock.h>

namespace mapscore::eval {
namespace {

using testing::study_of;

ClassTable four_classes() {
  ClassTable table;
  table.classes = {{0, "background", {}, false},
                   {1, "cup", {}, true},
                   {2, "wall", {}, false},
                   {3, "chair", {}, true}};
  return table;
}

TEST(TrialFusion, PriorsAreThoseOfDetectedClassesAndTheOthersShareTheRest) {
  Drawn<BayesRule> settings;
  settings.rule.priors = {0.3, 0.5};
  const Fusion fusion = for_classes(settings, four_classes());
  const std::vector<double> priors = std::get<BayesRule>(fusion.rule).priors;
  ASSERT_EQ(priors.size(), 4u);
  EXPECT_NEAR(priors[0], 0.1, 1e-15);
  EXPECT_EQ(priors[1], 0.3);
  EXPECT_NEAR(priors[2], 0.1, 1e-15);
  EXPECT_EQ(priors[3], 0.5);
  EXPECT_NO_THROW(check(fusion.rule));
}

TEST(TrialFusion, PriorsThatDoNotFitAreRefused) {
  Drawn<BayesRule> settings;
  settings.rule.priors = {0.3};
  EXPECT_THROW((void)for_classes(settings, four_classes()), Error);
  settings.rule.priors = {0.5, 0.5};
  EXPECT_THROW((void)for_classes(settings, four_classes()), Error);
}

TEST(TrialFusion, EachRuleHasItsOwnThreshold) {
  const auto threshold = [](const DrawnFusion& settings) {
    return default_threshold(for_classes(settings, four_classes()).rule);
  };
  EXPECT_EQ(threshold(Drawn<BlendRule>{}), 0.25);
  EXPECT_EQ(threshold(Drawn<BlendRule>{{0.0, Decay::hit}, {}}), 0.5);
  EXPECT_DOUBLE_EQ(threshold(Drawn<BlendRule>{{0.8, Decay::hit}, {}}), 0.1);
  EXPECT_EQ(threshold(Drawn<MaxConfidenceRule>{}), 0.5);
  EXPECT_EQ(threshold(Drawn<VoteRule>{}), 0.5);
  EXPECT_NEAR(threshold(Drawn<BayesRule>{}), 0.475, 1e-15);
  EXPECT_NEAR(threshold(Drawn<Top3Rule>{}), 0.475, 1e-15);
}

TEST(TrialFusion, IsReadFromAStudyAndAMethodMayHaveItsOwn) {
  const Study study = study_of(
      "  voted: {segmentation: {direct: {}}, fusion: {vote: {N: 4}}}\n"
      "fusion: {top3: {lambda: 0.8, N: 3, noise_at: odom}}\n");
  const auto& top3 = std::get<Drawn<Top3Rule>>(study.fusion);
  EXPECT_EQ(top3.rule.lambda, 0.8);
  EXPECT_EQ(top3.draws.N, 3);
  EXPECT_EQ(top3.draws.noise_at, NoiseAt::odom);
  EXPECT_EQ(fusion_of(study.fusion, study.methods[0].fusion), study.fusion);
  EXPECT_EQ(std::get<Drawn<VoteRule>>(fusion_of(study.fusion, study.methods[1].fusion)).draws.N, 4);
  EXPECT_EQ(leaf_text(study, "methods.voted.fusion.vote.N"), "4");
  EXPECT_EQ(parse_study(to_yaml(study), "study.yaml"), study);
}

TEST(TrialFusion, OldKeysStayAndAMethodsOwnFusionIsTheStudysInAKey) {
  const Study old = study_of("");
  EXPECT_THAT(to_key_yaml(old), ::testing::Not(::testing::HasSubstr("decay")));
  EXPECT_THAT(to_key_yaml(old), ::testing::HasSubstr("      direct: {}\nfusion:\n"))
      << "nothing between a method and the study's fusion";
  const Study own = parse_study(
      "recording: tiny\nmethods:\n  direct: {segmentation: {direct: {}}, fusion: {vote: {}}}\n",
      "study.yaml");
  const Plan of_own = plan_of(own, "r"), of_all = plan_of(study_of("fusion: {vote: {}}\n"), "r");
  EXPECT_EQ(of_own.tasks[of_own.trials[0].task].key, of_all.tasks[of_all.trials[0].task].key);
  const Plan of_old = plan_of(old, "r");
  EXPECT_EQ(of_own.tasks[of_own.trials[0].lattice_ceiling].key,
            of_old.tasks[of_old.trials[0].lattice_ceiling].key)
      << "the lattice ceiling takes the study's fusion";
}

class FusedTrial : public testing::TinyExperiment {
 protected:
  /// Map voxels and pooled counts of one trial under a fusion.
  [[nodiscard]] TrialResult run(const std::string& fusion) const {
    const Study study = study_of("fusion: " + fusion + "\nfaults: {pose: {sigma_xy_m: 0.02}}\n");
    const Plan planned = plan(study);
    ResultStore store = ResultStore::open(folder() / "fusion.sqlite");
    (void)run_plan(planned, recording(), table(), store, {});
    return *store.find(planned.tasks[planned.trials[0].task].key);
  }
};

TEST_F(FusedTrial, EveryRuleMapsTheSameVoxels) {
  const auto voxels = run("{blend: {N: 5}}").accounting.map_voxels;
  EXPECT_GT(voxels, 0);
  for (const std::string& rule : kinds_of(DrawnFusion{}))
    EXPECT_EQ(run("{" + rule + ": {N: 5}}").accounting.map_voxels, voxels) << rule;
  EXPECT_EQ(run("{blend: {N: 5, decay: view}}").accounting.map_voxels, voxels);
}

TEST_F(FusedTrial, PriorsAreCheckedBeforeTheFirstFrame) {
  EXPECT_THROW(check_classes(study_of("fusion: {bayes: {priors: [0.9]}}\n"), four_classes()),
               Error);
  const Study own = parse_study(
      "recording: tiny\nmethods:\n  mine: {segmentation: {direct: {}}, fusion: {bayes: {priors: "
      "[0.9]}}}\n",
      "study.yaml");
  try {
    check_classes(own, four_classes());
    FAIL() << "one prior for two classes";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::StartsWith("methods.mine.fusion.bayes.priors: "));
  }
}

}  // namespace
}  // namespace mapscore::eval
