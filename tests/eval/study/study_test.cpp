// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/study.hpp"

#include "core/error.hpp"
#include "tests/support/expect_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <variant>

namespace mapscore::eval {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kMinimal = R"(
scene: room.xml
trajectory: {waypoints_m_deg: [[0.5, 0.5, 0]]}
methods: {direct: {segmentation: {direct: {}}}}
)";

/// A long file, though not every leaf there is; what it writes differs from the defaults.
constexpr const char* kFull = R"(
name: "a: full \"study\""
seed: 18446744073709551615
seeds: 6
scene: ../scenes/apartment.xml
classes: ../scenes/other.classes.yaml
robot: robots/my robot.xml
recording: /data/recording
trajectory:
  waypoints_m_deg: [[0.5, 0.5, 0], [2, -0.5, 45.5]]
  speed_mps: 0.3
  turn_rate_dps: 30
  frames_per_s: 5
  max_frames: 7
cameras: {width_px: 320, height_px: 240, range_min_m: 0.5, range_max_m: 6.5, shadows: true}
voxel_m: 0.02
place: voxels
map_origin_m: [0.001, -0.02, 0]
map_yaw_deg: 12.5
detect: [cup, person]
methods:
  direct: {segmentation: {direct: {}}}
  erosion: {segmentation: {erosion: {radius_px: 3}}, place: points}
  region-growing_2:
    segmentation: {region_growing: {radius_factor: 0.5, released: true, seed: mask_centroid}}
fusion: {blend: {K: 0.25, N: 20, noise_at: odom, covariance: full}}
faults:
  misregistration:
    magnitude_m: 0.01
    angle_deg: 0.5
    focal_error_percent: -1
    principal_point_px: [1, -2]
  mount: {translation_m: [0.01, 0, -0.01], rotation_deg: [0, 1, 0]}
  pose:
    {sigma_xy_m: 0.02, sigma_z_m: 0.01, sigma_roll_pitch_deg: 0.1, sigma_yaw_deg: 1,
     sigma_scale: 2, kind: walk, reported_scale: 0.5}
  depth:
    {preset: astra, scale: 0.5, axial: 2, lateral: 3, quantisation: 4, grazing: 5, shadow: 6,
     flying: 7, range: 8, axial_base_m: 0.01, axial_growth_per_m: 0.02, lateral_px: 0.5,
     baseline_m: 0.05, subpixel_px: 0.25, grazing_from_deg: 60, grazing_to_deg: 80,
     flying_share: 0.2, range_min_m: 1, range_max_m: 5}
  labels:
    {preset: typical, scale: 0.5, boundary_px: -2, ragged_px: 1, miss: 0.1, confusion: 0.2,
     scores: 0.5, holes: 0.1, islands: 0.2, ragged_length_px: 4, miss_area_px: 100,
     disc_radius_px: 2, island_reach_px: 10, score_mean: 0.8, score_concentration: 5}
score:
  {unit: frame, threshold: 0.3, min_samples: 4, epsilon_m: 0, tolerances: [0, 2],
   distances_m: [0.03]}
sweep:
  faults.misregistration.magnitude_m: [0, 0.005, 1e-2]
  methods.erosion.segmentation.erosion.radius_px: [2, 5]
  detect: [all, [cup, "wine glass"]]
)";

Study parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_study(text, "studies/demo.yaml", overrides);
}

TEST(Study, MinimalFileTakesDefaults) {
  const Study study = parse(kMinimal);
  Study expected;
  expected.name = "demo";
  expected.base_folder = "studies";
  expected.scene = "room.xml";
  expected.trajectory.waypoints_m_deg = {{0.5, 0.5, 0}};
  expected.methods = {{"direct", Direct{}, {}}};
  EXPECT_EQ(study, expected);
}

TEST(Study, FlagsTakeTheEndOfAPathWhereItIsUnique) {
  const Study study = parse(kMinimal, {"sigma_xy_m=0.02", "misregistration.magnitude_m=0.01",
                                       "speed_mps=0.7", "sweep.mount.magnitude_m=[0, 0.1]"});
  EXPECT_EQ(study, parse(kMinimal,
                         {"faults.pose.sigma_xy_m=0.02", "faults.misregistration.magnitude_m=0.01",
                          "trajectory.speed_mps=0.7", "sweep.faults.mount.magnitude_m=[0, 0.1]"}));
  mapscore::testing::expect_error(
      "flag magnitude_m=1: magnitude_m: may be several keys; write one of "
      "faults.misregistration.magnitude_m, faults.mount.magnitude_m",
      [] { (void)parse(kMinimal, {"magnitude_m=1"}); });
  mapscore::testing::expect_error(
      "faults.mount.magnitude_m: is swept; set sweep.faults.mount.magnitude_m=[...]", [] {
        (void)parse(kMinimal, {"sweep.mount.magnitude_m=[0, 0.1]", "mount.magnitude_m=1"});
      });
  mapscore::testing::expect_error("unknown key 'sigma'",
                                  [] { (void)parse(kMinimal, {"sigma=1"}); });
}

TEST(Study, ReadsLeavesOfEveryTypeFromALongFile) {
  const Study s = parse(kFull);
  EXPECT_EQ(s.name, "a: full \"study\"");
  EXPECT_EQ(s.seed, 18446744073709551615u);
  EXPECT_EQ(s.seeds, 6);
  EXPECT_EQ(s.recording, "/data/recording");
  EXPECT_EQ(s.trajectory.waypoints_m_deg.at(1), (std::array<double, 3>{2, -0.5, 45.5}));
  EXPECT_EQ(s.cameras, (CameraSettings{320, 240, 0.5, 6.5, true}));
  EXPECT_EQ(s.place, Place::voxels);
  EXPECT_EQ(s.map_origin_m, (std::array<double, 3>{0.001, -0.02, 0}));
  EXPECT_EQ(s.detect, (DetectedSet{false, {"cup", "person"}}));
  ASSERT_EQ(s.methods.size(), 3u);
  EXPECT_EQ(s.methods[1], (MethodSettings{"erosion", Erosion{3}, Place::points}));
  EXPECT_EQ(std::get<RegionGrowing>(s.methods[2].segmentation),
            (RegionGrowing{0.5, true, SeedRule::mask_centroid}));
  EXPECT_EQ(std::get<Drawn<BlendRule>>(s.fusion),
            (Drawn<BlendRule>{{0.25}, {20, NoiseAt::odom, CovarianceUse::full}}));
  EXPECT_EQ(s.faults.misregistration.principal_point_px, (std::array<double, 2>{1, -2}));
  EXPECT_EQ(s.faults.mount.rigid.rotation_deg, (std::array<Degrees, 3>{{{0}, {1}, {0}}}));
  EXPECT_EQ(s.faults.pose.kind, sim::PoseNoiseKind::walk);
  EXPECT_EQ(s.score.unit, ScoreUnit::frame);
  EXPECT_EQ(s.score.threshold.value, 0.3);
  EXPECT_THAT(s.score.tolerances, ElementsAre(0, 2));
}

TEST(Study, TitlesAreKeptAndStandForNames) {
  const std::string text =
      "recording: r\nmethods: {a: {segmentation: {direct: {}}, title: \"A, plain\"}, b: "
      "{segmentation: {direct: {}}}}\nclass_titles: {tv: TV set, \"wine glass\": \"glass: 'x'\"}\n";
  const Study study = parse(text);
  EXPECT_EQ(method_title(study, "a"), "A, plain");
  EXPECT_EQ(method_title(study, "b"), "b");
  EXPECT_EQ(class_title(study, "tv"), "TV set");
  EXPECT_EQ(class_title(study, "wine glass"), "glass: 'x'");
  EXPECT_EQ(class_title(study, "cup"), "cup");
  EXPECT_EQ(parse(to_yaml(study)), study) << to_yaml(study);
  EXPECT_EQ(without_titles(study),
            parse(text.substr(0, text.find(", title")) + "}, b: {segmentation: {direct: {}}}}\n"));
}

TEST(Study, MethodsAndSweepKeepTheOrderOfTheFile) {
  const Study study = parse(kFull);
  EXPECT_EQ(study.methods[0].name, "direct");
  EXPECT_EQ(study.methods[2].name, "region-growing_2");
  ASSERT_EQ(study.sweep.size(), 3u);
  EXPECT_EQ(study.sweep[0].path, "faults.misregistration.magnitude_m");
  EXPECT_EQ(study.sweep[2].path, "detect");
}

TEST(Study, SweptValuesAreCanonical) {
  const Study study = parse(kFull);
  EXPECT_THAT(study.sweep[0].values, ElementsAre("0", "0.005", "0.01"));
  EXPECT_THAT(study.sweep[2].values, ElementsAre("all", "[cup, \"wine glass\"]"));
}

TEST(Study, ResolvedConfigurationLoadsBackEqual) {
  for (const std::string text : {kMinimal, kFull}) {
    const Study study = parse(text);
    const std::string yaml = to_yaml(study);
    EXPECT_EQ(parse(yaml), study) << yaml;
    EXPECT_EQ(to_yaml(parse(yaml)), yaml);
  }
}

TEST(Study, ResolvedConfigurationWritesEveryDefault) {
  const std::string yaml = to_yaml(parse(kMinimal));
  EXPECT_THAT(yaml, HasSubstr("name: demo\nseed: 1\nseeds: 1\nscene: room.xml\ntrajectory:\n"));
  EXPECT_THAT(yaml, HasSubstr("methods:\n  direct:\n    segmentation:\n      direct: {}\n"));
  EXPECT_THAT(yaml, HasSubstr("  distances_m: [0.01, 0.02, 0.05, 0.1]\n"));
  EXPECT_THAT(yaml, HasSubstr("  instances: false\n"));
  EXPECT_THAT(yaml, HasSubstr("  threshold: auto\n"));
  EXPECT_THAT(yaml, HasSubstr("sweep: {}\n"));
}

TEST(Study, ResolvedConfigurationHoldsNoFolderOfTheMachine) {
  const Study study = parse_study(kMinimal, "/home/someone/studies/demo.yaml");
  EXPECT_EQ(to_yaml(study).find("someone"), std::string::npos);
}

TEST(Study, DoublesSurviveTheRoundTripBitForBit) {
  Study study = parse(kMinimal);
  for (const double value : {0.1 + 0.2, 1.0 / 3, 1e-300, 5e-324, 0.05}) {
    study.voxel_m = value;
    EXPECT_EQ(parse(to_yaml(study)).voxel_m, value);
  }
}

TEST(Study, CovarianceIsReadAndWritten) {
  const Study study = parse(std::string(kMinimal) +
                            "faults: {pose: {covariance_m_rad: [[0.04, 0.01, 0, 0, 0, 0], "
                            "[0.01, 0.04, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], "
                            "[0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0.01]]}}\n");
  ASSERT_TRUE(study.faults.pose.covariance_m_rad);
  EXPECT_EQ((*study.faults.pose.covariance_m_rad)[0][1], 0.01);
  EXPECT_EQ((*study.faults.pose.covariance_m_rad)[5][5], 0.01);
  EXPECT_EQ(parse(to_yaml(study)), study);
}

TEST(Study, FlagsOverrideTheFileInTheirOrder) {
  const Study study =
      parse(kFull, {"voxel_m=0.1", "faults.pose.sigma_xy_m=0.5", "voxel_m=0.2", "detect=all",
                    "sweep={score.min_samples: [1, 4]}", "sweep.score.epsilon_m=[0]",
                    "methods.region-growing_2.segmentation.region_growing.radius_factor=1"});
  EXPECT_EQ(study.voxel_m, 0.2);
  EXPECT_EQ(study.faults.pose.sigma_xy_m, 0.5);
  EXPECT_TRUE(study.detect->all);
  ASSERT_EQ(study.sweep.size(), 2u);
  EXPECT_EQ(study.sweep[0], (SweepAxis{"score.min_samples", {"1", "4"}}));
  EXPECT_EQ(study.sweep[1], (SweepAxis{"score.epsilon_m", {"0"}}));
  EXPECT_EQ(std::get<RegionGrowing>(study.methods[2].segmentation).radius_factor, 1);
}

TEST(Study, AFlagMayGiveWhatTheFileLacks) {
  const std::string no_scene =
      "trajectory: {waypoints_m_deg: [[0, 0, 0]]}\n"
      "methods: {direct: {segmentation: {direct: {}}}}\n";
  EXPECT_THROW(parse(no_scene), Error);
  EXPECT_EQ(parse(no_scene, {"scene=a=b.xml"}).scene, "a=b.xml");
}

/// JSON is YAML, and has words in quotes.
TEST(Study, MayBeWrittenAsJson) {
  const Study study = parse(
      R"({"scene": "room.xml", "trajectory": {"waypoints_m_deg": [[0.5, 0.5, 0]]},
          "methods": {"direct": {"segmentation": {"direct": {}}, "place": "voxels"}},
          "faults": {"depth": {"preset": "astra"}, "pose": {"kind": "walk"}},
          "score": {"unit": "frame", "threshold": "auto"}, "detect": "all",
          "sweep": {"faults.pose.kind": ["white", "walk"], "voxel_m": [0.05, 0.1]}})");
  EXPECT_EQ(study, parse("scene: room.xml\ntrajectory: {waypoints_m_deg: [[0.5, 0.5, 0]]}\n"
                         "methods: {direct: {segmentation: direct, place: voxels}}\n"
                         "faults: {depth: {preset: astra}, pose: {kind: walk}}\n"
                         "score: {unit: frame, threshold: auto}\ndetect: all\n"
                         "sweep: {faults.pose.kind: [white, walk], voxel_m: [0.05, 0.1]}\n"));
}

TEST(Study, ARecordingNeedsNeitherSceneNorTrajectory) {
  const Study study = parse("recording: somewhere\nmethods: {d: {segmentation: {direct: {}}}}\n");
  EXPECT_EQ(study.recording, "somewhere");
  EXPECT_EQ(parse(to_yaml(study)), study);
}

TEST(Study, SetLeafAndLeafTextAreInverse) {
  Study study = parse(kMinimal);
  EXPECT_EQ(leaf_text(study, "map_origin_m"), "-");
  for (const auto& [path, value] : std::vector<std::pair<std::string, std::string>>{
           {"voxel_m", "0.1"},
           {"map_origin_m", "[0, 0.5, -1]"},
           {"place", "voxels"},
           {"cameras.shadows", "true"},
           {"fusion.blend.noise_at", "odom"},
           {"methods.direct.place", "voxels"},
           {"score.threshold", "auto"},
           {"trajectory.waypoints_m_deg", "[[0, 0, 0], [1, 2, 3]]"}}) {
    set_leaf(study, path, value);
    EXPECT_EQ(leaf_text(study, path), value) << path;
  }
}

TEST(Study, ARefusedLeafLeavesTheStudyAsItWas) {
  Study study = parse(kMinimal);
  const Study before = study;
  EXPECT_THROW(set_leaf(study, "map_origin_m", "[0, 0, x]"), Error);
  EXPECT_EQ(study, before);
}

TEST(Study, PathsStartAtTheStudyFile) {
  const Study study = parse(
      "scene: ../scenes/room.xml\nmethods: {d: {segmentation: {direct: {}}}}\n"
      "trajectory: {waypoints_m_deg: [[0, 0, 0]]}\n");
  EXPECT_EQ(resolve_path(study, *study.scene), "scenes/room.xml");
  EXPECT_EQ(resolve_path(study, "/abs/x"), "/abs/x");
  EXPECT_EQ(robot_path(study), "scenes/robot.xml");
}

TEST(Study, AMethodPlacesAsItSaysOrAsTheStudySays) {
  const Study study = parse(kFull);
  EXPECT_EQ(place_of(study, study.methods[0]), Place::voxels);
  EXPECT_EQ(place_of(study, study.methods[1]), Place::points);
}

TEST(Study, KnowsWhichLeavesDecideTheRecording) {
  EXPECT_TRUE(decides_recording("cameras.width_px"));
  EXPECT_TRUE(decides_recording("scene"));
  EXPECT_FALSE(decides_recording("voxel_m"));
}

}  // namespace
}  // namespace mapscore::eval
