// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// Studies on disk: what a file may name beside it, and the page that says what one may hold.

#include "core/error.hpp"
#include "eval/study/study.hpp"
#include "tests/support/expect_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

using ::testing::HasSubstr;

TEST(StudyFile, LoadsAFileFromDisk) {
  const auto folder = std::filesystem::temp_directory_path() / "mapscore_study_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "kitchen.yaml") << R"(
scene: room.xml
trajectory: {waypoints_m_deg: [[0.5, 0.5, 0]]}
methods: {direct: {segmentation: {direct: {}}}}
)";
  const Study study = load_study(folder / "kitchen.yaml");
  EXPECT_EQ(study.name, "kitchen");
  EXPECT_EQ(study.base_folder, folder);
  std::filesystem::remove_all(folder);
}

/// The recording is replayed as it is; a flag may put one in the place of what is rendered.
TEST(StudyFile, RefusesWhatCannotActBesideARecording) {
  const auto folder = std::filesystem::temp_directory_path() / "mapscore_study_recording_test";
  std::filesystem::create_directories(folder);
  const std::string methods = "methods: {d: {segmentation: {direct: {}}}}\n";
  const auto load = [&](const std::string& text, const std::vector<std::string>& flags) {
    std::ofstream(folder / "study.yaml") << text + methods;
    return load_study(folder / "study.yaml", flags);
  };
  const std::string rendered = "scene: a.xml\ntrajectory: {waypoints_m_deg: [[0, 0, 0]]}\n";
  EXPECT_EQ(load(rendered, {"recording=there"}).recording, "there");
  const std::string why = "cannot act beside recording";
  for (const char* key :
       {"trajectory: {max_frames: 2}\n", "cameras: {width_px: 64}\n", "lidar: {}\n"})
    mapscore::testing::expect_error(
        why, [&] { (void)load(std::string("recording: there\n") + key, {}); });
  mapscore::testing::expect_error(
      why, [&] { (void)load("recording: there\n", {"cameras.width_px=64"}); });
  mapscore::testing::expect_error(why, [&] {
    (void)load(rendered, {"recording=there", "trajectory.max_frames=2"});
  });
  mapscore::testing::expect_error("scene: a.xml is not there; beside recording pictures show",
                                  [&] { (void)load("recording: there\nscene: a.xml\n", {}); });
  mapscore::testing::expect_error("flag scene=b.xml: scene: b.xml is not there", [&] {
    (void)load(rendered, {"recording=there", "scene=b.xml"});
  });
  std::ofstream(folder / "a.xml") << "<mujoco/>";
  EXPECT_EQ(load("recording: there\nscene: a.xml\n", {}).scene, "a.xml");
  const Study stored = load(rendered, {"recording=there"});
  EXPECT_EQ(parse_study(to_yaml(stored), folder / "study.yaml"), stored) << "a store is read again";
  std::filesystem::remove_all(folder);
}

/// MAPSCORE_UPDATE_DOCS=1 in the environment writes the page anew.
TEST(StudyReference, IsThePageInDocs) {
  const std::filesystem::path page =
      std::filesystem::path(MAPSCORE_SOURCE_DIR) / "docs/study_reference.md";
  if (std::getenv("MAPSCORE_UPDATE_DOCS") != nullptr) std::ofstream(page) << config_reference();
  std::ifstream stream(page);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(text, config_reference()) << "run with MAPSCORE_UPDATE_DOCS=1 to write it anew";
}

TEST(StudyReference, NamesTypeUnitDefaultAndRange) {
  const std::string reference = config_reference();
  EXPECT_THAT(reference, HasSubstr("| `voxel_m` | number | m | 0.05 | above 0, up to 10 |"));
  EXPECT_THAT(reference, HasSubstr("| `methods.NAME.segmentation.erosion.radius_px` | whole number "
                                   "| px | 5 |"));
  EXPECT_THAT(reference, HasSubstr("| `faults.labels.score_concentration` | number |  | 10 |"));
  EXPECT_THAT(reference, HasSubstr("| `faults.labels.score_mean` | number |  | - |"));
  EXPECT_THAT(reference, HasSubstr("| `faults.labels.confusion_matrix` | list of list of number |  "
                                   "| [] |"));
  EXPECT_THAT(reference, HasSubstr("| `faults.pose.kind` | white, walk, constant |  | white |"));
}

}  // namespace
}  // namespace mapscore::eval
