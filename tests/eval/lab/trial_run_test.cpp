// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/trial_run.hpp"

#include "eval/lab/runner.hpp"
#include "eval/lab/truth_cache.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"
#include "tests/support/plate_recording.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace mapscore::eval {
namespace {

using testing::study_of;
using testing::TinyExperiment;

/// What a task comes to, frame by frame.
TrialResult result_of(const Task& task, const Recording& recording, const ClassTable& table) {
  FrameCache frames(recording, {.color = false, .label = true, .depth = true, .depth_label = true},
                    std::size_t{1} << 24);
  TruthCache truths(recording, table, frames, 1);
  PoseSources poses(recording);
  TrialRun run(task, recording, table, truths, poses);
  for (int index = 0; index < recording.frame_count(); ++index) run.advance(*frames.get(index));
  return run.finish();
}

/// Trials of the plate, whose counts are known by hand.
class PlateTrial : public ::testing::Test {
 protected:
  PlateTrial() : recording_(opened()) {}

  [[nodiscard]] static Study study(const std::vector<std::string>& overrides) {
    return parse_study(mapscore::testing::kPlateStudy, "study.yaml", overrides);
  }
  [[nodiscard]] TrialResult first_trial(const Study& study, Labels labels) const {
    const Task task = task_of(study, trials(study)[0], labels, recording_.content_hash());
    return result_of(task, recording_, recording_.info().table);
  }
  [[nodiscard]] TrialResult direct(const std::vector<std::string>& overrides,
                                   Labels labels = Labels::detected) const {
    return first_trial(study(overrides), labels);
  }

  static constexpr const char* kOnePixel =
      "sweep={'faults.misregistration.translation_m': [[0.05, 0, 0]]}";

 private:
  [[nodiscard]] Recording opened() const {
    mapscore::testing::write_plate_recording(folder_.path() / "plate");
    return Recording::open(folder_.path() / "plate");
  }

  mapscore::testing::TemporaryFolder folder_;
  Recording recording_;
};

TEST_F(PlateTrial, WithoutFaultsIsPerfect) {
  for (const Labels labels : {Labels::detected, Labels::truth}) {
    const TrialResult result = direct({}, labels);
    const ClassCounts& plate = result.counts.at(1);
    EXPECT_EQ(plate.predicted, 16);
    EXPECT_EQ(plate.true_predicted, 16);
    EXPECT_EQ(plate.visible, 16);
    EXPECT_EQ(plate.found, 16);
    EXPECT_EQ(plate.accuracy.within(0), 16);
    EXPECT_EQ(plate.completeness.within(0), 16);
    EXPECT_EQ(result.counts.at(2).predicted, 0);
    EXPECT_EQ(result.accounting.map_voxels, 16);
  }
}

TEST_F(PlateTrial, ShiftedByAPixelLeaksAColumn) {
  const TrialResult result = direct({kOnePixel});
  const ClassCounts& plate = result.counts.at(1);
  EXPECT_EQ(plate.predicted, 16);
  EXPECT_EQ(plate.true_predicted, 12);
  EXPECT_EQ(plate.false_leak, 4);
  EXPECT_EQ(plate.false_near + plate.false_floating, 0);
  EXPECT_EQ(plate.visible, 16);
  EXPECT_EQ(plate.found, 12);
  EXPECT_EQ(plate.missed_unmapped, 4);
  EXPECT_EQ(plate.missed_mislabelled + plate.missed_unlabelled, 0);
}

TEST_F(PlateTrial, ShiftedByAPixelIsAsFarOffAsThePlateAndTheWall) {
  const ClassCounts plate = direct({kOnePixel}).counts.at(1);
  // Leaked cubes begin at x = 1.5 m and y = 0.15 m, the plate ends at 1.01 m and 0.1 m.
  EXPECT_NEAR(*plate.accuracy.mean_m(), 4 * std::hypot(0.49, 0.05) / 16, 1e-8);
  // The missed column is half a voxel from the next one.
  EXPECT_NEAR(*plate.completeness.mean_m(), 4 * 0.025 / 16, 1e-8);
  EXPECT_EQ(plate.completeness.within(1), 12);  // 2 cm
  EXPECT_EQ(plate.completeness.within(2), 16);  // 5 cm
}

TEST_F(PlateTrial, CurveHasOneStepAtTheFirstHit) {
  const ClassCurve curve = direct({kOnePixel}).counts.at(1).curve;
  EXPECT_EQ(curve.visible, 16);
  EXPECT_EQ(curve.steps, (std::vector<CurveStep>{{500, 16, 12, 12, 8'000'000'000}}));
  EXPECT_EQ(curve.squared_error_billionth, 4'000'000'000);
  EXPECT_EQ(direct({"score.unit=frame", kOnePixel}).counts.at(1).curve, curve);
}

TEST_F(PlateTrial, BoxOfTheDetectionReachesToTheWall) {
  const BoxCounts exact = direct({}).counts.at(1).boxes;
  EXPECT_EQ(exact, (BoxCounts{1, 0, 1'000'000'000, 1, 1, 1}));
  // Three columns of the plate, x = -7.5 to 2.5 cm, and one of the wall, whose pixels are w wide;
  // both boxes are 2.5 cm wider on each side.
  const double w = 0.05 * 1.51 / 1.01;
  const double volume = (2.5 * w + 0.075) * (3 * w + 0.05) * 0.55, common = 0.15 * 0.2 * 0.05;
  const BoxCounts shifted = direct({kOnePixel}).counts.at(1).boxes;
  EXPECT_EQ(shifted.detections, 1);
  EXPECT_NEAR(static_cast<double>(shifted.iou_sum_nano) * 1e-9,
              common / (0.2 * 0.2 * 0.05 + volume - common), 2e-9);
  EXPECT_EQ(shifted.at_25, 0);
  EXPECT_EQ(direct({}, Labels::truth).counts.at(1).boxes, BoxCounts{});
}

TEST_F(PlateTrial, IsAccountedFor) {
  const Accounting accounting = direct({kOnePixel}).accounting;
  EXPECT_EQ(accounting.frames, 1);
  EXPECT_EQ(accounting.detections, 1);
  EXPECT_EQ(accounting.points, 16);
  EXPECT_EQ(accounting.skipped_no_points + accounting.skipped_no_seed_point +
                accounting.skipped_seed_off_object + accounting.skipped_eroded_away,
            0);
}

TEST_F(PlateTrial, AFrameWhoseFitIsUnsureIsCounted) {
  const auto unsure_with = [&](const Segmentation& segmentation) {
    Study of = study({});
    of.methods[0].segmentation = segmentation;
    return first_trial(of, Labels::detected).accounting.frames_unsure;
  };
  EXPECT_EQ(unsure_with(EdgeAligned{}), 1) << "of so few pixels an outline tells nothing";
  EXPECT_EQ(unsure_with(EdgeAligned{.fit = OutlineFit::masks}), 0);
  EXPECT_EQ(unsure_with(Direct{}), 0);
}

TEST_F(PlateTrial, ErodedAwayIsSkippedAndAllIsMissed) {
  Study eroding = study({});
  eroding.methods[0].segmentation = Erosion{3};
  const TrialResult result = first_trial(eroding, Labels::detected);
  EXPECT_EQ(result.accounting.skipped_eroded_away, 1);
  EXPECT_EQ(result.counts.at(1).predicted, 0);
  EXPECT_EQ(result.counts.at(1).missed_unmapped, 16);
  EXPECT_EQ(result.counts.at(1).boxes, (BoxCounts{1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(result.counts.at(1).curve, (ClassCurve{16, 0, {}}));
}

TEST_F(PlateTrial, MinSamplesLeavesVoxelsOfOneSampleOutOfTheRecall) {
  const ClassCounts plate = direct({"score.min_samples=2"}).counts.at(1);
  EXPECT_EQ(plate.visible, 0);
  EXPECT_EQ(plate.true_predicted, 16);
}

TEST_F(PlateTrial, ThresholdAboveTheFirstHitPredictsNothing) {
  const ClassCounts plate = direct({"score.threshold=0.51"}).counts.at(1);
  EXPECT_EQ(plate.predicted, 0);
  EXPECT_EQ(plate.missed_unlabelled, 16);
}

using TinyTrial = TinyExperiment;

/// Voxels that hold a point of the crate: what direct predicts, with sets in place of a map. Each
/// voxel's samples by class go to `samples`.
std::set<VoxelKey> crate_voxels(const Recording& recording, const Pose& T_map_world,
                                const Calibration& believed,
                                std::map<VoxelKey, std::map<ClassId, int>>& samples) {
  std::set<VoxelKey> predicted;
  for (int index = 0; index < recording.frame_count(); ++index) {
    const Frame frame = recording.read(index, {.depth_label = true});
    const Pose T_map_depth = T_map_world * frame.T_world_base * believed.T_base_depth;
    const RegisteredCloud cloud = register_depth(frame.depth, believed);
    for (int v = 0; v < frame.label.rows; ++v)
      for (int u = 0; u < frame.label.cols; ++u) {
        const int source = cloud.source(u, v);
        if (frame.label(v, u) == 1 && source != RegisteredCloud::kNone)
          predicted.insert(voxel_of(T_map_depth * cloud.point(source), 0.05));
        const double z = frame.depth(v, u) / kDepthUnitsPerMetre;
        if (z == 0) continue;
        const Eigen::Vector3d p_map = T_map_depth * believed.depth.back_project(u, v, z);
        ++samples[voxel_of(p_map, 0.05)]
                 [frame.depth_label(v, u)];  // here an instance's id is its class
      }
  }
  return predicted;
}

/// The class with most samples, ties to the lower id.
ClassId owner_of(const std::map<ClassId, int>& by_class) {
  return std::max_element(by_class.begin(), by_class.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

TEST_F(TinyTrial, DirectIsTheSetOfItsPoints) {
  for (const double shift_m : {0.0, 0.08}) {
    Study study = study_of("map_origin_m: [0.01, 0.02, 0.03]\n");
    study.faults.misregistration.rigid.translation_m = {shift_m, 0, 0};
    Calibration believed = recording().info().calibration;
    believed.T_color_depth = Eigen::Translation3d(shift_m, 0, 0) * believed.T_color_depth;
    const Pose T_map_world = map_frame(study, 0).T_map_world();
    std::map<VoxelKey, std::map<ClassId, int>> samples;
    const auto predicted = crate_voxels(recording(), T_map_world, believed, samples);
    const SurfaceTruth surface =
        surface_truth(recording().read_shapes(), table(), T_map_world, {0.05, 0.0005, 1});
    std::int64_t visible = 0, found = 0, on_surface = 0;
    for (const auto& [key, by_class] : samples) {
      if (owner_of(by_class) != 1 || !surface.contains(key, 1)) continue;
      ++visible;
      found += static_cast<std::int64_t>(predicted.count(key));
    }
    for (const VoxelKey& key : predicted) on_surface += surface.contains(key, 1) ? 1 : 0;

    const ClassCounts crate = result_of(plan(study).tasks[0], recording(), table()).counts.at(1);
    const auto all = static_cast<std::int64_t>(predicted.size());
    EXPECT_EQ(on_surface<all, shift_m> 0);
    EXPECT_GT(visible, 100);
    EXPECT_EQ(crate.predicted, all);
    EXPECT_EQ(crate.true_predicted, on_surface);
    EXPECT_EQ(crate.visible, visible);
    EXPECT_EQ(crate.found, found);
  }
}

TEST_F(TinyTrial, FramesByThemselvesAddUpToTheirFrames) {
  const Task task = plan(study_of("score: {unit: frame}\nmap_origin_m: [0, 0, 0]\n")).tasks[0];
  const TrialResult result = result_of(task, recording(), table());
  EXPECT_EQ(result.accounting.frames, 4);
  const Task fused = plan(study_of("map_origin_m: [0, 0, 0]\n")).tasks[0];
  const TrialResult map = result_of(fused, recording(), table());
  EXPECT_GT(result.counts.at(1).visible, map.counts.at(1).visible);
  EXPECT_EQ(result.accounting.points, map.accounting.points);
}

TEST_F(TinyTrial, CurveHoldsTheCountsAtEveryThreshold) {
  for (const char* unit : {"map", "frame"}) {
    std::int64_t before = 0;
    for (const double threshold : {0.95, 0.8, 0.6, 0.25}) {
      const Task task =
          plan(study_of(fmt::format("score: {{unit: {}, threshold: {}}}\n"
                                    "faults: {{misregistration: {{magnitude_m: 0.03}}}}\n",
                                    unit, threshold)))
              .tasks[0];
      const ClassCounts crate = result_of(task, recording(), table()).counts.at(1);
      const CurvePoint point = point_at(crate.curve, threshold);
      EXPECT_EQ(point.predicted, crate.predicted);
      EXPECT_EQ(point.true_predicted, crate.true_predicted);
      EXPECT_EQ(point.found, crate.found);
      EXPECT_EQ(crate.curve.visible, crate.visible);
      EXPECT_GE(crate.predicted, before);
      before = crate.predicted;
    }
    EXPECT_GT(before, 0);
  }
}

TEST_F(TinyTrial, DosesOfZeroChangeNothing) {
  const Task plain = plan(study_of("")).tasks[0];
  const Task zero = plan(study_of("faults: {misregistration: {translation_m: [0, 0, 0]}, "
                                  "pose: {sigma_xy_m: 0.3, sigma_scale: 0}}\n"))
                        .tasks[0];
  EXPECT_NE(plain.key, zero.key);
  EXPECT_EQ(result_of(plain, recording(), table()).counts,
            result_of(zero, recording(), table()).counts);
}

TEST_F(TinyTrial, EveryFaultChangesTheCounts) {
  const Counts plain = result_of(plan(study_of("")).tasks[0], recording(), table()).counts;
  for (const char* fault :
       {"misregistration: {magnitude_m: 0.03}", "misregistration: {angle_deg: 2}",
        "misregistration: {focal_error_percent: 5}",
        "misregistration: {principal_point_px: [3, 0]}", "mount: {magnitude_m: 0.05}",
        "pose: {sigma_xy_m: 0.05}", "pose: {sigma_yaw_deg: 3}"}) {
    const Task task = plan(study_of(std::string("faults: {") + fault + "}\n")).tasks[0];
    EXPECT_NE(result_of(task, recording(), table()).counts, plain) << fault;
  }
}

TEST_F(TinyTrial, LatticeCeilingIsPerfectOnFlatSurfaces) {
  const Plan whole = plan(study_of("seeds: 3\n"));
  for (const PlannedTrial trial : whole.trials) {
    const ClassCounts crate =
        result_of(whole.tasks[trial.lattice_ceiling], recording(), table()).counts.at(1);
    EXPECT_GE(static_cast<double>(crate.true_predicted),
              0.995 * static_cast<double>(crate.predicted));
    EXPECT_GE(static_cast<double>(crate.found), 0.995 * static_cast<double>(crate.visible));
    EXPECT_GT(crate.visible, 0);
  }
}

}  // namespace
}  // namespace mapscore::eval
