// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/results/plan.hpp"
#include "eval/study/grid.hpp"
#include "eval/study/study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kTwo =
    "trajectory: {speed_mps: 0.2}\n"
    "methods: {direct: {segmentation: {direct: {}}}}\n"
    "scenes:\n"
    "  home:\n"
    "    scene: home.xml\n"
    "    trajectory: {waypoints_m_deg: [[1, 2, 3]], drive: {wheels: {track_error_percent: 1}}}\n"
    "  hall: {recording: hall}\n";

Study two(const std::string& lines = "", const std::vector<std::string>& overrides = {}) {
  return parse_study(kTwo + lines, "study.yaml", overrides);
}

std::string scenes_refusal(const std::string& lines,
                           const std::vector<std::string>& overrides = {}) {
  try {
    (void)two(lines, overrides);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Scenes, AreTheLastAxisOfTheSweep) {
  const Study study = two("sweep: {voxel_m: [0.05, 0.1]}\n");
  ASSERT_EQ(study.sweep.size(), 2u);
  EXPECT_EQ(study.sweep[1], (SweepAxis{"scene", {"home", "hall"}}));
  const std::vector<Cell> all = cells(study);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(scene_of(study, all[1]), "hall");
  EXPECT_THAT(two("sweep: {scene: [hall], voxel_m: [0.05]}\n").sweep[0].values,
              ElementsAre("hall"));
  EXPECT_EQ(cells(two("", {"sweep.scene=[home]"})).size(), 1u);
}

TEST(Scenes, KeysAreThoseOfTheStudyAndOverThemTheirOwn) {
  const Study study = two();
  const Study home = resolve(study, cells(study)[0]), hall = resolve(study, cells(study)[1]);
  EXPECT_EQ(home.scene, "home.xml");
  EXPECT_FALSE(home.recording);
  EXPECT_EQ(home.trajectory.speed_mps, 0.2);
  EXPECT_EQ(home.trajectory.waypoints_m_deg.size(), 1u);
  EXPECT_TRUE(on_wheels(home));
  EXPECT_EQ(leaf_text(home, "trajectory.drive.wheels.track_error_percent"), "1");
  EXPECT_EQ(hall.recording, "hall");
  EXPECT_FALSE(hall.scene);
  EXPECT_TRUE(home.scenes.empty());
}

TEST(Scenes, ImagesOfANetworkAreOfOneSceneAlone) {
  const std::string images = "perception: {images: {folder: labels, classes: c.yaml}}\n";
  EXPECT_THAT(scenes_refusal(images), HasSubstr("perception.images"));
  EXPECT_THAT(scenes_refusal("sweep: {perception: [labels, images]}\n"),
              HasSubstr("perception.images"));
  EXPECT_EQ(scenes_refusal(images, {"sweep.scene=[home]"}), "accepted");
  EXPECT_EQ(scenes_refusal("sweep: {perception: [labels, simulated]}\n"), "accepted");
}

TEST(Scenes, ReadBackAsTheyAreWritten) {
  const Study study = two("sweep: {voxel_m: [0.05, 0.1]}\n");
  const Study read = parse_study(to_yaml(study), "study.yaml");
  EXPECT_EQ(read, study);
  EXPECT_EQ(to_yaml(read), to_yaml(study));
  EXPECT_EQ(to_yaml(two()).find("scenes: {}"), std::string::npos);
}

TEST(Scenes, StudiesOfEachHaveTheSweepOfAll) {
  const auto studies = studies_of_scenes(two("sweep: {voxel_m: [0.05, 0.1]}\n"));
  ASSERT_EQ(studies.size(), 2u);
  EXPECT_EQ(studies[1].first, "hall");
  ASSERT_EQ(studies[1].second.sweep.size(), 1u);
  EXPECT_EQ(studies[1].second.sweep[0].path, "voxel_m");
  EXPECT_THROW((void)study_of_only_scene(two()), Error);
  EXPECT_EQ(study_of_only_scene(two("", {"sweep.scene=[hall]"})).recording, "hall");
}

TEST(Scenes, TrialsAreThoseOfTheStudyOfTheScene) {
  const Study study = two("sweep: {faults.misregistration.magnitude_m: [0, 0.01]}\n");
  const RecordingHashes hashes(std::map<std::string, std::string>{{"home", "a"}, {"hall", "b"}});
  const Plan all = plan_of(study, hashes);
  ASSERT_EQ(all.trials.size(), 4u);
  for (const auto& [name, one] : studies_of_scenes(study)) {
    const Plan alone = plan_of(one, name == "home" ? "a" : "b");
    for (std::size_t cell = 0; cell < 2; ++cell) {
      const PlannedTrial of_all = all.trials[2 * cell + (name == "hall" ? 1 : 0)];
      const PlannedTrial of_one = alone.trials[cell];
      EXPECT_EQ(all.tasks.key(of_all.task), alone.tasks.key(of_one.task));
      EXPECT_EQ(all.tasks.key(of_all.lattice_ceiling), alone.tasks.key(of_one.lattice_ceiling));
      EXPECT_EQ(all.tasks.recording_hash(of_all.task), name == "home" ? "a" : "b");
    }
  }
  EXPECT_THROW((void)plan_of(study, "one"), Error);
}

TEST(Scenes, AFlagThatASceneOverrulesIsRefused) {
  EXPECT_EQ(scenes_refusal("", {"trajectory.speed_mps=0.3"}), "accepted");
  EXPECT_EQ(scenes_refusal("  attic:\n    scene: attic.xml\n    exploration: {budget_m: 9}\n"
                           "    trajectory: {waypoints_m_deg: [[0, 0, 0]], speed_mps: 1}\n"
                           "  cellar: {scene: cellar.xml, trajectory: "
                           "{waypoints_m_deg: [[0, 0, 0]], speed_mps: 2}}\n",
                           {"trajectory.speed_mps=0.3"}),
            "flag trajectory.speed_mps=0.3: trajectory.speed_mps: attic, cellar set it below "
            "scenes, which wins; change it there, or set sweep.trajectory.speed_mps=[...] for all "
            "scenes");
  const std::string attic =
      "  attic: {scene: a.xml, trajectory: {waypoints_m_deg: [[0, 0, 0]], speed_mps: 1}}\n";
  EXPECT_EQ(scenes_refusal(attic, {"speed_mps=0.3", "sweep.scene=[home]"}), "accepted");
  EXPECT_THAT(scenes_refusal(attic, {"speed_mps=0.3"}), HasSubstr("attic sets it below scenes"));
  const Study swept = two(attic, {"sweep.trajectory.speed_mps=[0.3]"});
  for (const Cell& cell : cells(swept)) EXPECT_EQ(resolve(swept, cell).trajectory.speed_mps, 0.3);
  // A choice that a scene makes anew takes its parameters with it.
  EXPECT_THAT(scenes_refusal("", {"trajectory.drive=wheels"}), HasSubstr("home sets it"));
}

TEST(Scenes, WrongOnesAreRefused) {
  EXPECT_THAT(scenes_refusal("scene: other.xml\n"),
              HasSubstr("study.yaml:8: scene: stands beside scenes"));
  EXPECT_THAT(scenes_refusal("  attic: {}\n"),
              HasSubstr("study.yaml:8: scenes.attic: scene: is missing"));
  EXPECT_THAT(scenes_refusal("  attic: {scene: a.xml}\n"), HasSubstr("the trajectory is empty"));
  EXPECT_THAT(scenes_refusal("  attic: {recording: a, voxel_m: 0.1}\n"),
              HasSubstr("study.yaml:8: scenes.attic.voxel_m: does not decide a recording"));
  EXPECT_THAT(scenes_refusal("  attic: {recording: a, trajectory: {speed_mps: 1}}\n"),
              HasSubstr("is replayed as it is"));
  EXPECT_THAT(scenes_refusal("  attic: {recording: a, trajectory: {speed: 1}}\n"),
              HasSubstr("unknown key 'speed'"));
  EXPECT_THAT(scenes_refusal("  attic: {trajectory: {}}\n"), HasSubstr("is a section"));
  EXPECT_THAT(scenes_refusal("  the attic: {recording: a}\n"), HasSubstr("cannot name a scene"));
  EXPECT_THAT(scenes_refusal("  all: {recording: a}\n"), HasSubstr("stands for all scenes"));
  EXPECT_THAT(scenes_refusal("sweep: {scene: [attic]}\n"), HasSubstr("no scene 'attic'"));
  EXPECT_THAT(scenes_refusal("", {"scenes.hall.recording=b"}), HasSubstr("is not a leaf"));
  EXPECT_THAT(scenes_refusal("sampling: {sobol: {points: 4}}\nsweep: {voxel_m: [0.1, 0.2]}\n"),
              HasSubstr("sampling: stands beside scenes"));
}

}  // namespace
}  // namespace mapscore::eval
