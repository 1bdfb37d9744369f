// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/localization_settings.hpp"

#include "eval/study/study.hpp"
#include "tests/support/expect_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

using ::testing::ElementsAre;

Study localised(const std::string& source, const std::vector<std::string>& changes = {}) {
  Study study;
  study.recording = "driven";
  set_leaf(study, "localization.trajectory", "poses.txt");
  set_leaf(study, "localization.source", source);
  set_leaves(study, changes);
  return study;
}

/// Those of some keys that decide the poses of a source.
std::vector<std::string> deciding(const Study& study) {
  std::vector<std::string> keys;
  for (const char* key :
       {"localization.trajectory", "localization.odometry_noise.alpha1",
        "localization.filter.temper", "localization.filter.start_sigma_xy_m",
        "localization.grid_resolution_m", "localization.visual.wheels",
        "localization.visual.points_across", "localization.visual.loop_way_m",
        "localization.visual.corrected", "faults.lidar.preset", "faults.depth.preset",
        "faults.mount.magnitude_m", "faults.pose.sigma_xy_m", "voxel_m"})
    if (decides_poses(study, key)) keys.emplace_back(key);
  return keys;
}

TEST(LocalizationSettings, EachSourceHasItsKeys) {
  EXPECT_THAT(deciding(localised("truth")), ElementsAre());
  EXPECT_THAT(deciding(localised("gaussian")), ElementsAre("faults.pose.sigma_xy_m"));
  EXPECT_THAT(deciding(localised("trajectory")), ElementsAre("localization.trajectory"));
  EXPECT_THAT(deciding(localised("odometry")), ElementsAre("localization.odometry_noise.alpha1"));
  EXPECT_THAT(deciding(localised("particle_filter")),
              ElementsAre("localization.odometry_noise.alpha1", "localization.filter.temper",
                          "localization.filter.start_sigma_xy_m", "localization.grid_resolution_m",
                          "faults.lidar.preset"));
  EXPECT_THAT(deciding(localised("visual_odometry")),
              ElementsAre("localization.odometry_noise.alpha1", "localization.visual.wheels",
                          "localization.visual.points_across", "faults.depth.preset",
                          "faults.mount.magnitude_m"));
  EXPECT_THAT(deciding(localised("visual_slam")),
              ElementsAre("localization.odometry_noise.alpha1", "localization.visual.wheels",
                          "localization.visual.points_across", "localization.visual.loop_way_m",
                          "localization.visual.corrected", "faults.depth.preset",
                          "faults.mount.magnitude_m"));
}

TEST(LocalizationSettings, OtherSettingsTakeKeysAway) {
  EXPECT_THAT(deciding(localised("particle_filter", {"localization.filter.start=global",
                                                     "localization.grid=map.yaml"})),
              ElementsAre("localization.odometry_noise.alpha1", "localization.filter.temper",
                          "faults.lidar.preset"));
  EXPECT_FALSE(decides_poses(localised("visual_slam", {"localization.visual.wheels=false"}),
                             "localization.odometry_noise.alpha1"));
}

TEST(LocalizationSettings, AKeyThatIsNoneIsAnError) {
  mapscore::testing::expect_error("localization.filter.tempr", [] {
    (void)decides_poses(localised("odometry"), "localization.filter.tempr");
  });
}

}  // namespace
}  // namespace mapscore::eval
