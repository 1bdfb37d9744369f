// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/explore/visible_surface.hpp"

#include "core/random_stream.hpp"
#include "files/file_bytes.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

constexpr double kEdge = 0.1;

/// Class 1 is detected, class 2 is not; instances have the numbers of their classes.
ClassTable two_classes() {
  ClassTable table;
  table.classes.push_back({1, "cup", {}, true});
  table.classes.push_back({2, "wall", {}, false});
  table.instances.push_back({1, "cup_1", 1});
  table.instances.push_back({2, "wall_1", 2});
  return table;
}

/// A row of voxels along x: 0 and 1 cup, 2 wall, 3 and 4 background.
SurfaceTruth row_of_voxels() {
  return {{{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{2, 0, 0}, 2}, {{3, 0, 0}, 0}, {{4, 0, 0}, 0}}, kEdge};
}

SurfacePoint in_voxel(int i, InstanceId instance, float share = 0.5f) {
  return {{(static_cast<float>(i) + share) * 0.1f, 0.05f, 0.05f}, instance};
}

/// Voxel 1 is never seen; two of three points in voxel 0 are the cup's; voxel 7 is no surface.
const std::vector<SurfacePoint> kCloud{in_voxel(0, 1), in_voxel(0, 1, 0.3f), in_voxel(0, 0, 0.8f),
                                       in_voxel(2, 2), in_voxel(3, 0),       in_voxel(4, 0),
                                       in_voxel(7, 1)};

/// A camera of one pixel that looks along x of the world from its origin.
Calibration one_pixel() {
  Calibration calibration;
  calibration.depth = CameraModel{1, 1, 1.0, 1.0, 0.0, 0.0};
  calibration.range_min_m = 0.01;
  calibration.range_max_m = 10.0;
  Eigen::Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  calibration.T_base_depth = Pose::Identity();
  calibration.T_base_depth.linear() = R;
  calibration.T_base_depth.translation() = Eigen::Vector3d(0, 0.05, 0.05);
  return calibration;
}

Frame looking_at(double x_m, InstanceId instance = 0) {
  Frame frame;
  frame.depth = cv::Mat1w(1, 1, static_cast<std::uint16_t>(x_m * kDepthUnitsPerMetre));
  frame.depth_label = cv::Mat1w(1, 1, instance);
  return frame;
}

TEST(VisibleSurface, HoldsSurfaceVoxelsOfEveryClassThatTheCloudMeets) {
  const VisibleSurface surface(kCloud, row_of_voxels(), two_classes(), Pose::Identity());
  EXPECT_EQ(surface.size(), 4u);  // 0, 2, 3, 4
  EXPECT_EQ(surface.detected(), 1u);
  EXPECT_LT(surface.find(pack({0, 0, 0})), 4u);
  EXPECT_EQ(surface.find(pack({1, 0, 0})), 4u);
  EXPECT_EQ(surface.find(pack({7, 0, 0})), 4u);
}

TEST(VisibleSurface, LiesOnTheLatticeOfTheMap) {
  const Pose T_map_world = planar_pose(0.1, 0, 0);  // a voxel further along x
  const VisibleSurface surface({in_voxel(0, 1)}, row_of_voxels(), two_classes(), T_map_world);
  EXPECT_EQ(surface.find(pack({1, 0, 0})), 0u);
}

TEST(SeenSurface, CoverageIsTheSeenShareAndDetectedClassesAreCountedApart) {
  const VisibleSurface surface(kCloud, row_of_voxels(), two_classes(), Pose::Identity());
  SeenSurface seen(surface, one_pixel(), Pose::Identity());
  EXPECT_EQ(seen.coverage(), 0.0);
  seen.add(looking_at(0.35));
  seen.add(looking_at(0.36));  // the same voxel
  EXPECT_EQ(seen.coverage(), 0.25);
  EXPECT_EQ(seen.coverage_detected(), 0.0);
  seen.add(looking_at(0.05));
  EXPECT_EQ(seen.coverage(), 0.5);
  EXPECT_EQ(seen.coverage_detected(), 1.0);
  seen.add(looking_at(0.15));  // surface, but no view of the dense set saw it
  seen.add(looking_at(0.75));
  seen.add(looking_at(0.0));  // nothing measured
  EXPECT_EQ(seen.coverage(), 0.5);
}

TEST(SeenSurface, OfASceneWithoutSurfaceAllIsSeen) {
  const VisibleSurface surface({}, row_of_voxels(), two_classes(), Pose::Identity());
  EXPECT_EQ(SeenSurface(surface, one_pixel(), Pose::Identity()).coverage(), 1.0);
}

TEST(VisibleSurface, ScoresTheDetectedClassesOfAMap) {
  const VisibleSurface surface({in_voxel(0, 1), in_voxel(1, 1), in_voxel(3, 0)}, row_of_voxels(),
                               two_classes(), Pose::Identity());
  SemanticMap map(kEdge);
  // Right in voxel 0, wrong in voxel 3, of a class that is not detected in voxel 2; 1 is missing.
  const std::vector<VoxelHit> hits{
      {{0, 0, 0}, 1, 1, 1.0}, {{2, 0, 0}, 2, 1, 1.0}, {{3, 0, 0}, 1, 1, 1.0}};
  map.fuse(hits, 1, BlendRule{}, 3);
  const MapState state = surface.state_of(map, 0.25);
  EXPECT_DOUBLE_EQ(state.precision, 0.5);
  EXPECT_DOUBLE_EQ(state.recall, 0.5);
  EXPECT_DOUBLE_EQ(state.f1, 0.5);
  EXPECT_NEAR(state.known_m3, 3 * kEdge * kEdge * kEdge, 1e-12);
  EXPECT_EQ(surface.state_of(map, 0.75).f1, 0.0);
}

TEST(VisibleCloud, KeepsOnePointACubeAndInstance) {
  VisibleCloud cloud(0.1);
  cloud.add(looking_at(0.31), one_pixel());
  cloud.add(looking_at(0.38), one_pixel());
  cloud.add(looking_at(0.38, 1), one_pixel());
  cloud.add(looking_at(0.45), one_pixel());
  cloud.add(looking_at(0.0), one_pixel());
  ASSERT_EQ(cloud.points().size(), 3u);
  EXPECT_FLOAT_EQ(cloud.points()[0].p_world.x(), 0.31f);
  EXPECT_EQ(cloud.points()[1].instance, 1);
}

TEST(VisibleCloud, IsKeptInAFileAndMadeAnewWhereThatIsDamaged) {
  const mapscore::testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "surfaces/a.cloud";
  int made = 0;
  const auto make = [&] {
    ++made;
    return kCloud;
  };
  EXPECT_EQ(kept_cloud(file, make), kCloud);
  EXPECT_EQ(kept_cloud(file, make), kCloud);
  EXPECT_EQ(made, 1);
  std::string bytes = read_file(file);
  bytes[40] ^= 1;
  write_file(file, bytes);
  EXPECT_EQ(kept_cloud(file, make), kCloud);
  EXPECT_EQ(made, 2);
  EXPECT_EQ(cloud_of_bytes(""), std::nullopt);
  EXPECT_EQ(cloud_of_bytes(bytes.substr(0, 60)), std::nullopt);
}

}  // namespace
}  // namespace mapscore::eval
