// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/lab/trial_run.hpp"
#include "eval/lab/truth_cache.hpp"
#include "eval/recording/frame_cache.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"

#include <gmock/gmock.h>

#include <numbers>

namespace mapscore::eval {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::study_of;
using testing::TinyExperiment;

Study with_faults(const std::string& faults) {
  return study_of("faults: {" + faults + "}\n");
}

class SensorFaults : public TinyExperiment {
 protected:
  [[nodiscard]] Task task(const std::string& faults, Labels labels = Labels::detected) const {
    const Study study = with_faults(faults);
    return task_of(study, trials(study)[0], labels, recording().content_hash());
  }
  [[nodiscard]] TrialResult result(const Task& task) const {
    FrameCache frames(recording(),
                      {.color = false, .label = true, .depth = true, .depth_label = true},
                      std::size_t{1} << 24);
    TruthCache truths(recording(), table(), frames, 1);
    PoseSources poses(recording());
    TrialRun run(task, recording(), table(), truths, poses);
    for (int index = 0; index < recording().frame_count(); ++index) run.advance(*frames.get(index));
    return run.finish();
  }
};

TEST_F(SensorFaults, DosesOfZeroChangeNeitherCountsNorKey) {
  const Task plain = task("");
  const TrialResult expected = result(plain);
  for (const char* zero :
       {"depth: {preset: ideal}", "depth: {axial: 0, range_max_m: 3}",
        "depth: {preset: kinect_v1, scale: 0}", "labels: {preset: typical, scale: 0}",
        "labels: {boundary_px: 0, confusion: 0, holes: 0, disc_radius_px: 9}",
        "labels: {confusion_matrix: [[0.4, 0.6], [0.5, 0.5]], scale: 0}"}) {
    EXPECT_EQ(task(zero).key, plain.key) << zero;
    const TrialResult found = result(task(zero));
    EXPECT_EQ(found.counts, expected.counts) << zero;
    EXPECT_EQ(found.accounting, expected.accounting) << zero;
  }
}

TEST_F(SensorFaults, KeysOfOlderStudiesStayTheirs) {
  EXPECT_THAT(task("").description, HasSubstr("    kind: white\n    reported_scale: 1\nscore:\n"));
  EXPECT_THAT(to_yaml(study_of("")), HasSubstr("  depth:\n    preset: ideal\n    scale: 1\n"));
}

TEST_F(SensorFaults, AKeyHoldsNumbersInPlaceOfAPreset) {
  const Task astra = task("depth: {preset: astra}");
  EXPECT_THAT(astra.description, HasSubstr("  depth:\n    axial: 1\n    lateral: 1\n"));
  EXPECT_THAT(astra.description, Not(HasSubstr("astra")));
  EXPECT_EQ(astra.key, task("depth: {axial: 2, lateral: 2, quantisation: 2, grazing: 2, shadow: 2, "
                            "flying: 2, range: 2, scale: 0.5}")
                           .key);
  EXPECT_NE(astra.key, task("depth: {preset: kinect_v1}").key);
}

TEST_F(SensorFaults, EveryDoseChangesTheCounts) {
  const Counts plain = result(task("")).counts;
  for (const char* fault :
       {"depth: {axial: 3}", "depth: {lateral: 1}", "depth: {quantisation: 10}",
        "depth: {grazing: 1, grazing_from_deg: 5, grazing_to_deg: 30}", "depth: {flying: 5}",
        "depth: {range: 1, range_min_m: 7}", "depth: {preset: astra}", "labels: {boundary_px: 2}",
        "labels: {boundary_px: -2}", "labels: {ragged_px: 2}",
        "labels: {miss: 1, miss_area_px: 100000}", "labels: {scores: 1, score_mean: 0.5}",
        "labels: {holes: 0.3, disc_radius_px: 1}", "labels: {islands: 0.5, disc_radius_px: 1}"})
    EXPECT_NE(result(task(fault)).counts, plain) << fault;
}

TEST_F(SensorFaults, TheShadowTakesTheWallBesideTheCrate) {
  const Counts grown = result(task("labels: {boundary_px: 4}")).counts;
  const Counts shadowed = result(task("labels: {boundary_px: 4}, depth: {shadow: 3}")).counts;
  EXPECT_LT(shadowed.at(1).false_leak, grown.at(1).false_leak);
  EXPECT_EQ(shadowed.at(1).true_predicted, grown.at(1).true_predicted);
}

TEST_F(SensorFaults, ConfusedClassesComeIntoTheMap) {
  Study study = with_faults("labels: {confusion: 1}");
  study.detect = DetectedSet{true, {}};
  ClassTable all = table();
  for (SemanticClass& one : all.classes) one.detect = one.id != kBackground;
  const Task confused =
      task_of(study, trials(study)[0], Labels::detected, recording().content_hash());
  FrameCache frames(recording(),
                    {.color = false, .label = true, .depth = true, .depth_label = true},
                    std::size_t{1} << 24);
  TruthCache truths(recording(), all, frames, 1);
  PoseSources poses(recording());
  TrialRun run(confused, recording(), all, truths, poses);
  for (int index = 0; index < recording().frame_count(); ++index) run.advance(*frames.get(index));
  const TrialResult found = run.finish();
  EXPECT_GT(found.counts.at(1).predicted, 0);
  EXPECT_GT(found.counts.at(1).false_leak, 0) << "the wall under the crate's name";
  EXPECT_EQ(found.counts.at(1).boxes.iou_sum_nano, 0);
  EXPECT_GT(found.counts.at(1).boxes.detections, 0);
}

TEST_F(SensorFaults, CeilingsKnowNothingOfThem) {
  const Study study = with_faults("depth: {preset: astra}, labels: {preset: typical}");
  const Plan noisy = plan(study), plain = plan(study_of(""));
  const PlannedTrial trial = noisy.trials[0];
  EXPECT_NE(noisy.tasks[trial.task].key, plain.tasks[plain.trials[0].task].key);
  EXPECT_EQ(noisy.tasks[trial.registration_ceiling].key,
            plain.tasks[plain.trials[0].registration_ceiling].key);
  EXPECT_EQ(noisy.tasks[trial.lattice_ceiling].key,
            plain.tasks[plain.trials[0].lattice_ceiling].key);
  const Task truth_labels = task("depth: {preset: astra}, labels: {miss: 1}", Labels::truth);
  EXPECT_EQ(result(truth_labels).counts, result(noisy.tasks[trial.lattice_ceiling]).counts);
}

TEST(SensorDoses, StartAtThePreset) {
  const sim::DepthDose dose =
      with_faults("depth: {preset: kinect_v1, axial: 2, grazing_from_deg: 60, scale: 0.5}")
          .faults.depth.dose();
  EXPECT_EQ(dose.axial, 1.0);
  EXPECT_EQ(dose.lateral, 0.5);
  EXPECT_EQ(dose.range_max_m, 4.0);
  EXPECT_EQ(dose.grazing_from_deg.deg, 60);
  const sim::LabelDose labels =
      with_faults("labels: {preset: typical, confusion_matrix: [[0.8, 0.2], [0, 1]], scale: 0.5}")
          .faults.labels.dose();
  EXPECT_EQ(labels.confusion, 0.0);
  EXPECT_NEAR(labels.confusion_matrix.at(0).at(0), 0.9, 1e-12);
  EXPECT_NEAR(labels.confusion_matrix.at(0).at(1), 0.1, 1e-12);
  EXPECT_EQ(labels.ragged_px, 0.75);
}

TEST(SensorDoses, AreSweptLikeAnyLeaf) {
  const Study study = study_of(
      "sweep: {faults.depth.preset: [ideal, astra], faults.depth.scale: [0, 0.5, 1], "
      "faults.labels.boundary_px: [-2, 2]}\n");
  EXPECT_EQ(cells(study).size(), 12u);
  EXPECT_EQ(resolve(study, cells(study).back()).faults.labels.dose().boundary_px, 2.0);
}

TEST(SensorDoses, WrongOnesAreRefused) {
  const auto refusal = [](const std::string& faults) -> std::string {
    try {
      (void)with_faults(faults);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal("depth: {axial: -1}"), HasSubstr("faults.depth.axial"));
  EXPECT_THAT(refusal("depth: {preset: kinekt}"), HasSubstr("ideal, astra, kinect_v1"));
  EXPECT_THAT(refusal("depth: {preset: kinect_v1, range_min_m: 5}"),
              HasSubstr("range_min_m: is not below range_max_m"));
  EXPECT_THAT(refusal("labels: {boundary_px: 1001}"), HasSubstr("faults.labels.boundary_px"));
  EXPECT_THAT(refusal("labels: {miss: 1.5}"), HasSubstr("faults.labels.miss"));
  EXPECT_THAT(refusal("labels: {confusion: 0.1, confusion_matrix: [[1]]}"),
              HasSubstr("keep one of the two"));
  EXPECT_THAT(refusal("labels: {confusion_matrix: [[0.5, 0.4], [0, 1]]}"),
              HasSubstr("row 1: does not add up to 1"));
  EXPECT_THAT(refusal("labels: {confusion_matrix: [[1, 0]]}"), HasSubstr("not square"));
  EXPECT_THAT(refusal("labels: {confusion_matrix: [[0.5, 0.5], [0, 1]], scale: 3}"),
              HasSubstr("negative"));
}

}  // namespace
}  // namespace mapscore::eval
