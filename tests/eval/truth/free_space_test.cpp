// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/free_space.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"
#include "eval/truth/occupancy_truth.hpp"
#include "tests/eval/truth/truth_scenes.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace mapscore::eval {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// 8 x 6 pixels of 45 degrees to each side, looking along z of the map.
Calibration wide_camera() {
  Calibration calibration;
  calibration.depth = {8, 6, 4, 4, 3.5, 2.5};
  calibration.range_min_m = 0.2;
  calibration.range_max_m = 3.0;
  return calibration;
}

Frame flat_frame(double z_m) {
  Frame frame;
  frame.depth = cv::Mat1w(6, 8, static_cast<std::uint16_t>(std::lround(z_m * 5000)));
  frame.depth_label = cv::Mat1w::zeros(6, 8);
  return frame;
}

TEST(FreeSpace, HoldsTheCentresInFrontOfAWallByHand) {
  // Voxels of 0.5 m, planes of centres at z = 0.25, 0.75, 1.25; the wall at 1.3 m. The image holds
  // -z <= x < z and -0.75 z <= y < 0.75 z: no centre, 3 x 2 and 5 x 4 of them.
  FreeSpace free(SurfaceTruth({}, 0.5));
  free.add(flat_frame(1.3), wide_camera(), Pose::Identity());
  const std::vector<VoxelKey> voxels = free.voxels();
  std::set<VoxelKey> expected;
  for (int i = -9; i <= 9; ++i)
    for (int j = -9; j <= 9; ++j)
      for (int k = 0; k <= 2; ++k) {
        const double x = (i + 0.5) * 0.5, y = (j + 0.5) * 0.5, z = (k + 0.5) * 0.5;
        if (x >= -z && x < z && y >= -0.75 * z && y < 0.75 * z) expected.insert({i, j, k});
      }
  EXPECT_EQ(std::set<VoxelKey>(voxels.begin(), voxels.end()), expected);
  EXPECT_EQ(voxels.size(), 26u);
  EXPECT_TRUE(std::is_sorted(voxels.begin(), voxels.end()));
}

TEST(FreeSpace, TakesRangeAndDepthWithTheirLimits) {
  const auto count_at = [](double z_m, double range_min_m, double range_max_m) {
    Calibration camera = wide_camera();
    camera.range_min_m = range_min_m;
    camera.range_max_m = range_max_m;
    FreeSpace free(SurfaceTruth({}, 0.5));
    free.add(flat_frame(z_m), camera, Pose::Identity());
    int planes = 0;
    for (const VoxelKey& key : free.voxels()) planes |= 1 << key.k;
    return planes;  // bit k: the plane of centres at (k + 0.5) / 2
  };
  EXPECT_EQ(count_at(1.25, 0.25, 3.0), 0b110);
  EXPECT_EQ(count_at(1.2498, 0.25, 3.0), 0b010);
  EXPECT_EQ(count_at(2.0, 0.75, 1.25), 0b110);
  EXPECT_EQ(count_at(2.0, 0.7501, 1.2499), 0);
  EXPECT_EQ(count_at(0.0, 0.25, 3.0), 0);
  EXPECT_EQ(count_at(13.0, 1.0, 1.5), 0b100);  // a wall out of range is seen through to
}

TEST(FreeSpace, NoSurfaceIsFree) {
  const SurfaceTruth surface({{{0, 0, 1}, kBackground, true}}, 0.5);
  FreeSpace all(SurfaceTruth({}, 0.5)), but_one(surface);
  all.add(flat_frame(1.3), wide_camera(), Pose::Identity());
  but_one.add(flat_frame(1.3), wide_camera(), Pose::Identity());
  std::vector<VoxelKey> expected = all.voxels();
  EXPECT_EQ(std::erase(expected, VoxelKey{0, 0, 1}), 1u);
  EXPECT_EQ(but_one.voxels(), expected);
}

/// As it is defined, over every voxel around the camera.
void add_plainly(const Frame& frame, const Calibration& calibration, const Pose& T_map_base,
                 const SurfaceTruth& surface, std::set<VoxelKey>& free) {
  const Pose T_map_depth = T_map_base * calibration.T_base_depth;
  const Eigen::Matrix3d R = T_map_depth.linear();
  const Eigen::Vector3d t = T_map_depth.translation();
  const CameraModel& camera = calibration.depth;
  const double edge_m = surface.edge_m();
  const VoxelKey middle = voxel_of(t, edge_m);
  const int reach = static_cast<int>(2.0 * calibration.range_max_m / edge_m) + 2;
  for (int i = middle.i - reach; i <= middle.i + reach; ++i)
    for (int j = middle.j - reach; j <= middle.j + reach; ++j)
      for (int k = middle.k - reach; k <= middle.k + reach; ++k) {
        const Eigen::Vector3d q = centre_of({i, j, k}, edge_m) - t;
        const double x = R(0, 0) * q.x() + R(1, 0) * q.y() + R(2, 0) * q.z();
        const double y = R(0, 1) * q.x() + R(1, 1) * q.y() + R(2, 1) * q.z();
        const double z = R(0, 2) * q.x() + R(1, 2) * q.y() + R(2, 2) * q.z();
        if (z < calibration.range_min_m || z > calibration.range_max_m) continue;
        const double u = std::floor(camera.fx_px * x / z + camera.cx_px + 0.5);
        const double v = std::floor(camera.fy_px * y / z + camera.cy_px + 0.5);
        if (u < 0 || u >= camera.width_px || v < 0 || v >= camera.height_px) continue;
        const auto value = frame.depth(static_cast<int>(v), static_cast<int>(u));
        if (value == 0 || z > value / 5000.0 || surface.touches_any({i, j, k})) continue;
        free.insert({i, j, k});
      }
}

/// A bumpy wall with holes, some of it far behind, some close.
Frame random_frame(const CameraModel& camera, int n) {
  RandomStream random(5, "free space", {static_cast<std::uint64_t>(n)});
  Frame frame;
  frame.depth.create(camera.height_px, camera.width_px);
  frame.depth_label = cv::Mat1w::zeros(camera.height_px, camera.width_px);
  const double near = 1.0 + 5.0 * random.uniform();
  for (int v = 0; v < camera.height_px; ++v)
    for (int u = 0; u < camera.width_px; ++u) {
      const bool hole = random.uniform() < 0.05, far = (u / 12 + v / 9) % 3 == n % 3;
      const double z = near * (far ? 1.8 : 1.0) + 0.3 * random.normal();
      frame.depth(v, u) = static_cast<std::uint16_t>(hole ? 0 : std::clamp(z, 0.0, 13.0) * 5000);
    }
  frame.T_world_base = planar_pose(0.3 * n, 4.0 - 0.7 * n, 0.8 * n);
  frame.T_world_base.rotate(Eigen::AngleAxisd(0.2 * n, Eigen::Vector3d(1, 2, 3).normalized()));
  return frame;
}

Calibration small_camera() {
  Calibration calibration = testing::tiny_info().calibration;
  calibration.range_max_m = 4.0;
  return calibration;
}

SurfaceTruth random_surface(double edge_m) {
  RandomStream random(6, "free space");
  std::set<VoxelKey> keys;
  for (int n = 0; n < 4000; ++n) {
    keys.insert(voxel_of(Eigen::Vector3d(8 * random.uniform() - 4, 8 * random.uniform() - 4,
                                         8 * random.uniform() - 4),
                         edge_m));
  }
  std::vector<SurfaceVoxel> voxels;
  for (const VoxelKey& key : keys) voxels.push_back({key, kBackground, false});
  return {std::move(voxels), edge_m};
}

TEST(FreeSpace, AgreesWithThePlainOneInAnyOrder) {
  const Calibration calibration = small_camera();
  for (const double edge_m : {0.11, 0.25}) {
    const SurfaceTruth surface = random_surface(edge_m);
    FreeSpace forth(surface), back(surface), odd(surface), even(surface);
    std::set<VoxelKey> plain;
    for (int n = 0; n < 8; ++n) {
      const Frame frame = random_frame(calibration.depth, n);
      const Frame last = random_frame(calibration.depth, 7 - n);
      forth.add(frame, calibration, frame.T_world_base);
      back.add(last, calibration, last.T_world_base);
      (n % 2 == 0 ? even : odd).add(frame, calibration, frame.T_world_base);
      add_plainly(frame, calibration, frame.T_world_base, surface, plain);
    }
    const std::vector<VoxelKey> expected(plain.begin(), plain.end());
    ASSERT_GT(expected.size(), 1000u);
    EXPECT_EQ(forth.voxels(), expected);
    EXPECT_EQ(back.voxels(), expected);
    odd.merge(even);
    EXPECT_EQ(odd.voxels(), expected);
  }
}

TEST(FreeSpace, RefusesUnusableInput) {
  FreeSpace free(SurfaceTruth({}, 0.5));
  Frame small = flat_frame(1.0);
  small.depth = cv::Mat1w(6, 7, std::uint16_t{5000});
  EXPECT_THAT([&] { free.add(small, wide_camera(), Pose::Identity()); },
              ThrowsMessage<Error>(HasSubstr("8 x 6")));
  Pose nowhere = Pose::Identity();
  nowhere.translation().x() = std::nan("");
  EXPECT_THAT([&] { free.add(flat_frame(1.0), wide_camera(), nowhere); },
              ThrowsMessage<Error>(HasSubstr("not finite")));
  nowhere.translation().x() = 1e6;
  EXPECT_THAT([&] { free.add(flat_frame(1.0), wide_camera(), nowhere); },
              ThrowsMessage<Error>(HasSubstr("2^20")));
  EXPECT_THAT([&] { free.merge(FreeSpace(SurfaceTruth({}, 0.25))); },
              ThrowsMessage<Error>(HasSubstr("voxel_m")));
  EXPECT_TRUE(free.voxels().empty());
}

TEST(OccupancyTruth, SamplesGoBeforeFreeSpace) {
  // The wall at z = 1.3 fills the plane k = 2, whose centres at 1.25 it is seen through.
  FreeSpace free(SurfaceTruth({}, 0.5));
  SampleCounter samples(0.5);
  free.add(flat_frame(1.3), wide_camera(), Pose::Identity());
  samples.add(flat_frame(1.3), wide_camera(), test::four_classes(), Pose::Identity());
  const OccupancyTruth truth = occupancy_truth(samples, 1, free);
  for (const VoxelKey& key : truth.occupied) EXPECT_EQ(key.k, 2);
  for (const VoxelKey& key : truth.free) {
    EXPECT_FALSE(std::binary_search(truth.occupied.begin(), truth.occupied.end(), key));
  }
  EXPECT_FALSE(truth.occupied.empty());
  EXPECT_LT(truth.free.size(), free.voxels().size());
  // With more samples asked for than any voxel has, nothing is occupied.
  const OccupancyTruth none = occupancy_truth(samples, 100, free);
  EXPECT_TRUE(none.occupied.empty());
  EXPECT_EQ(none.free, free.voxels());
  EXPECT_THAT([&] { (void)occupancy_truth(samples, 0, free); },
              ThrowsMessage<Error>(HasSubstr("min_samples")));
}

TEST(OccupancyTruth, CountsSamplesOfAllClassesTogether) {
  FreeSpace free(SurfaceTruth({}, 10.0));
  SampleCounter samples(10.0);
  Frame frame = flat_frame(1.3);
  frame.depth_label.colRange(0, 4) = 1;
  samples.add(frame, wide_camera(), test::four_classes(), Pose::Identity());
  // The four voxels around the axis hold 12 samples each, the left ones of class 1.
  EXPECT_EQ(occupancy_truth(samples, 12, free).occupied.size(), 4u);
  EXPECT_EQ(occupancy_truth(samples, 13, free).occupied.size(), 0u);
}

TEST(OccupancyTruth, OfARecordingDoesNotDependOnThreads) {
  testing::TemporaryFolder folder;
  testing::write_tiny_recording(folder.path() / "tiny");
  const Recording recording = Recording::open(folder.path() / "tiny");
  const RecordingInfo& info = recording.info();
  const Pose T_map_world = map_from_world({0.013, 0.027, 0.031}, 0.3);
  const SurfaceTruth surface =
      surface_truth(recording.read_shapes(), info.table, T_map_world, {0.1, 0.0005, 1});
  FrameCache frames(recording, {false, false, true, true}, 1 << 20);
  const std::vector<int> all{0, 1, 2, 3};
  const auto made = [&](int jobs) {
    return make_occupancy_truth(frames, all, info.calibration, T_map_world, surface, 1, jobs);
  };
  const OccupancyTruth one = made(1), three = made(3);
  EXPECT_EQ(one.occupied, three.occupied);
  EXPECT_EQ(one.free, three.free);
  std::set<VoxelKey> plain;
  for (const Frame& frame : testing::tiny_frames())
    add_plainly(frame, info.calibration, T_map_world * frame.T_world_base, surface, plain);
  EXPECT_EQ(one.free, std::vector<VoxelKey>(plain.begin(), plain.end()));
  for (const VoxelKey& key : one.occupied) EXPECT_TRUE(surface.touches_any(key));
}

}  // namespace
}  // namespace mapscore::eval
