// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <ostream>

namespace mapscore::testing {
namespace {

/// A line of the study, what is written in its place, and what the program then says.
struct BadLine {
  const char* name;
  const char* from;
  const char* to;
  std::vector<std::string> parts;
};
std::ostream& operator<<(std::ostream& stream, const BadLine& bad) {
  return stream << bad.name;
}

class BadStudy : public TinyStudy, public ::testing::WithParamInterface<BadLine> {};

TEST_P(BadStudy, IsRefusedWithFileLineAndKeyAndLeavesNothing) {
  replace("study.yaml", GetParam().from, GetParam().to);
  expect_refused(mapscore({"sweep", study(), "-o", results()}), GetParam().parts);
  EXPECT_FALSE(std::filesystem::exists(results()));
}

INSTANTIATE_TEST_SUITE_P(
    Every, BadStudy,
    ::testing::Values(
        BadLine{"unknown_key",
                "seeds: 2",
                "voxel: 5",
                {"study.yaml:7", "voxel", "did you mean 'voxel_m'"}},
        BadLine{"wrong_type", "seeds: 2", "seeds: two", {"study.yaml:7", "seeds", "whole number"}},
        BadLine{"nan", "seeds: 2", "voxel_m: .nan", {"study.yaml:7", "voxel_m", "finite"}},
        BadLine{
            "negative_voxel", "seeds: 2", "voxel_m: -0.05", {"study.yaml:7", "voxel_m", "above 0"}},
        BadLine{"nan_in_the_sweep",
                "[0, 0.03]",
                "[0, .nan]",
                {"study.yaml:6", "magnitude_m", "finite"}},
        BadLine{"swept_recording",
                "faults.misregistration.magnitude_m: [0, 0.03]",
                "cameras.width_px: [64, 128]",
                {"cameras.width_px", "a name under `scenes`"}},
        BadLine{"broken_yaml", "seeds: 2", "seeds: [2", {"study.yaml:", "YAML"}},
        BadLine{"empty_trajectory",
                "recording: tiny",
                "scene: room.xml\ntrajectory: {waypoints_m_deg: []}",
                {"study.yaml:2", "trajectory.waypoints_m_deg", "at least one waypoint"}},
        BadLine{"no_such_recording",
                "recording: tiny",
                "recording: small",
                {"small", "give the folder of a recording"}},
        BadLine{"no_such_class",
                "seeds: 2",
                "detect: [elephant]",
                {"detect", "'elephant'", "crate wall"}}),
    [](const auto& bad) { return bad.param.name; });

TEST_F(BadStudy, NothingIsDetected) {
  replace("tiny/recording.yaml", "detect: true", "detect: false");
  expect_refused(mapscore({"sweep", study(), "-o", results(), "-q"}),
                 {"detect", "nothing to map", "class file"});
}

}  // namespace
}  // namespace mapscore::testing
