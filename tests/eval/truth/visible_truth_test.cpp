// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/visible_truth.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"
#include "tests/eval/truth/truth_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

using test::kEdge;

/// A camera of `width` x `height` pixels whose optical frame is the base's.
Calibration tiny_camera(int width, int height) {
  Calibration calibration;
  calibration.depth = {width, height, 100, 100, 0, 0};
  calibration.range_min_m = 0.5;
  calibration.range_max_m = 4;
  return calibration;
}

Frame frame_of(const cv::Mat1w& depth, const cv::Mat1w& label) {
  Frame frame;
  frame.depth = depth;
  frame.depth_label = label;
  return frame;
}

SampleCounter counted(const cv::Mat1w& depth, const cv::Mat1w& label) {
  SampleCounter counter(kEdge);
  counter.add(frame_of(depth, label), tiny_camera(depth.cols, depth.rows), test::four_classes(),
              Pose::Identity());
  return counter;
}

TEST(SampleCounter, TakesTheRangeWithItsLimits) {
  // 0.5 m is 2500, 4 m is 20000.
  const cv::Mat1w depth = (cv::Mat1w(1, 6) << 0, 2499, 2500, 20000, 20001, 65535);
  const cv::Mat1w label(1, 6, std::uint16_t{1});
  const auto counts = counted(depth, label).counts();
  ASSERT_EQ(counts.size(), 2u);
  EXPECT_EQ(counts[0], (SampleCount{{0, 0, 5}, 1, 1}));   // u = 2: x = 0.01
  EXPECT_EQ(counts[1], (SampleCount{{1, 0, 40}, 1, 1}));  // u = 3: x = 0.12; 4 / 0.1 is 40
}

TEST(SampleCounter, CountsByVoxelAndClassAndTakesUnknownIdsAsBackground) {
  // z = 1: pixels 10 apart are 0.1 m apart.
  const cv::Mat1w depth(1, 12, std::uint16_t{5100});
  const cv::Mat1w label = (cv::Mat1w(1, 12) << 1, 1, 2, 2, 2, 1, 77, 1, 1, 1, 3, 3);
  const SampleCounter counter = counted(depth, label);
  const std::vector<SampleCount> expected{
      {{0, 0, 10}, 0, 1}, {{0, 0, 10}, 1, 6}, {{0, 0, 10}, 2, 3}, {{1, 0, 10}, 3, 2}};
  EXPECT_EQ(counter.counts(), expected);
}

Pose some_pose(int n) {
  Pose pose = planar_pose(0.37 * n, -0.21 * n, 0.5 * n);
  pose.rotate(Eigen::AngleAxisd(0.1 * n, Eigen::Vector3d(1, 2, 3).normalized()));
  return pose;
}

Frame random_frame(int n) {
  RandomStream random(4, "frame", {static_cast<std::uint64_t>(n)});
  cv::Mat1w depth(48, 64), label(48, 64);
  for (auto& value : depth) {
    value = static_cast<std::uint16_t>(
        random.uniform() < 0.1 ? 0 : 2000 + 600 * n + 40 * random.normal());
  }
  for (auto& value : label) value = static_cast<std::uint16_t>(6 * random.uniform());
  return frame_of(depth, label);
}

Calibration tilted_camera() {
  Calibration calibration = tiny_camera(64, 48);
  calibration.depth = CameraModel::from_hfov(64, 48, 1.0);
  calibration.T_base_depth = some_pose(5);
  return calibration;
}

TEST(SampleCounter, AgreesWithTheDocumentedFormulaPixelByPixel) {
  const Calibration calibration = tilted_camera();
  const ClassTable table = test::four_classes();
  SampleCounter counter(0.05);
  std::map<std::pair<VoxelKey, ClassId>, std::uint32_t> plain;
  for (int n = 0; n < 4; ++n) {
    const Frame frame = random_frame(n);
    counter.add(frame, calibration, table, some_pose(n));
    const Pose T_map_depth = some_pose(n) * calibration.T_base_depth;
    for (int v = 0; v < 48; ++v) {
      for (int u = 0; u < 64; ++u) {
        const double z = frame.depth(v, u) / 5000.0;
        if (frame.depth(v, u) == 0 || z < calibration.range_min_m || z > calibration.range_max_m) {
          continue;
        }
        const Eigen::Vector3d p = T_map_depth * calibration.depth.back_project(u, v, z);
        ++plain[{voxel_of(p, 0.05), table.class_of(frame.depth_label(v, u))}];
      }
    }
  }
  const auto counts = counter.counts();
  ASSERT_EQ(counts.size(), plain.size());
  EXPECT_GT(counts.size(), 1000u);
  auto expected = plain.begin();
  for (const SampleCount& count : counts) {
    EXPECT_EQ(count,
              (SampleCount{expected->first.first, expected->first.second, expected->second}));
    ++expected;
  }
}

TEST(SampleCounter, MergesInAnyOrder) {
  const Calibration calibration = tilted_camera();
  const ClassTable table = test::four_classes();
  SampleCounter all(0.05), forwards(0.05), backwards(0.05);
  std::vector<SampleCounter> parts;
  for (int n = 0; n < 6; ++n) {
    all.add(random_frame(n), calibration, table, some_pose(n % 2));
    parts.emplace_back(0.05).add(random_frame(n), calibration, table, some_pose(n % 2));
  }
  for (int n = 0; n < 6; ++n) {
    forwards.merge(parts[n]);
    backwards.merge(parts[5 - n]);
  }
  EXPECT_EQ(all.counts(), forwards.counts());
  EXPECT_EQ(all.counts(), backwards.counts());
  EXPECT_THROW(all.merge(SampleCounter(0.1)), Error);
}

TEST(SampleCounter, RefusesFramesThatDoNotFit) {
  const cv::Mat1w image(4, 4, std::uint16_t{5000});
  SampleCounter counter(kEdge);
  const ClassTable table = test::four_classes();
  EXPECT_THROW(counter.add(frame_of(image, image), tiny_camera(5, 4), table, Pose::Identity()),
               Error);
  EXPECT_THROW(counter.add(frame_of(image, {}), tiny_camera(4, 4), table, Pose::Identity()), Error);
  Pose lost = Pose::Identity();
  lost.translation().x() = std::nan("");
  EXPECT_THROW(counter.add(frame_of(image, image), tiny_camera(4, 4), table, lost), Error);
  lost.translation().x() = 1e6;
  EXPECT_THROW(counter.add(frame_of(image, image), tiny_camera(4, 4), table, lost), Error);
  EXPECT_THROW(SampleCounter(0), Error);
  EXPECT_TRUE(counter.counts().empty());
}

/// Voxels (0,0,10) and (1,0,10) hold red and green, (2,0,10) green only, (3,0,10) background only.
SurfaceTruth hand_surface() {
  return {{{{0, 0, 10}, 1},
           {{0, 0, 10}, 2},
           {{1, 0, 10}, 1},
           {{1, 0, 10}, 2},
           {{2, 0, 10}, 2},
           {{3, 0, 10}, 0}},
          kEdge};
}

TEST(VisibleTruth, OwnersByHand) {
  cv::Mat1w depth(1, 40, std::uint16_t{5100});
  cv::Mat1w label(1, 40, std::uint16_t{0});
  const int width = 10;  // columns 0-9 are x in [0, 0.1), but at z = 1.02 column 39 is x = 0.3978
  label(cv::Rect(0, 0, 4, 1)) = 2;  // voxel 0: green 4, red 4, background 2 -> tie, red
  label(cv::Rect(4, 0, 4, 1)) = 1;
  label(cv::Rect(width, 0, 4, 1)) = 1;  // voxel 1: green more than red
  label(cv::Rect(width + 4, 0, 6, 1)) = 2;
  label(cv::Rect(2 * width, 0, 10, 1)) = 1;  // voxel 2: mostly red, whose surface is not there
  const SampleCounter counter = counted(depth, label);
  const VisibleTruth visible = visible_truth(counter, hand_surface(), 1);

  EXPECT_EQ(visible.owner_of({0, 0, 10}), ClassId{1});
  EXPECT_EQ(visible.owner_of({1, 0, 10}), ClassId{2});
  EXPECT_EQ(visible.owner_of({2, 0, 10}), std::nullopt);
  EXPECT_EQ(visible.owner_of({3, 0, 10}), std::nullopt);  // background owns nothing
  EXPECT_EQ(visible.owner_of({9, 9, 9}), std::nullopt);
  ASSERT_EQ(visible.count(1), 1u);
  ASSERT_EQ(visible.count(2), 1u);
  EXPECT_EQ(visible.count(0), 0u);
  EXPECT_EQ(visible.count(3), 0u);
  EXPECT_EQ(visible.of(1)[0], (VisibleVoxel{{0, 0, 10}, 1, 10}));
  EXPECT_EQ(visible.voxels().size(), 2u);
}

TEST(VisibleTruth, BackgroundTakesPartInTheTie) {
  const cv::Mat1w depth(1, 4, std::uint16_t{5100});
  const cv::Mat1w label = (cv::Mat1w(1, 4) << 1, 1, 0, 0);
  EXPECT_TRUE(visible_truth(counted(depth, label), hand_surface(), 1).voxels().empty());
}

TEST(VisibleTruth, MinSamplesCountsAllClasses) {
  const cv::Mat1w depth(1, 4, std::uint16_t{5100});
  const cv::Mat1w label = (cv::Mat1w(1, 4) << 1, 1, 0, 3);
  const SampleCounter counter = counted(depth, label);
  const auto enough = visible_truth(counter, hand_surface(), 4);
  ASSERT_EQ(enough.voxels().size(), 1u);
  EXPECT_EQ(enough.voxels()[0], (VisibleVoxel{{0, 0, 10}, 1, 4}));
  EXPECT_TRUE(visible_truth(counter, hand_surface(), 5).voxels().empty());
}

TEST(VisibleTruth, IsASubsetOfTheSurface) {
  const cv::Mat1w depth(1, 4, std::uint16_t{7777});
  const cv::Mat1w label(1, 4, std::uint16_t{1});
  EXPECT_TRUE(visible_truth(counted(depth, label), hand_surface(), 1).voxels().empty());
}

TEST(VisibleTruth, RefusesMixedSizesAndNoSamples) {
  const SampleCounter counter(kEdge);
  EXPECT_THROW((void)visible_truth(counter, SurfaceTruth({}, 0.05), 1), Error);
  EXPECT_THROW((void)visible_truth(counter, hand_surface(), 0), Error);
  EXPECT_TRUE(visible_truth(counter, hand_surface(), 1).voxels().empty());
}

using PlainCounts = std::map<VoxelKey, std::map<ClassId, std::uint32_t>>;

void count_plainly(int n, const Calibration& calibration, const Pose& T_map_base, double edge_m,
                   PlainCounts& counts) {
  const Frame frame = random_frame(n);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      const double z = frame.depth(v, u) / 5000.0;
      if (frame.depth(v, u) == 0 || z < calibration.range_min_m || z > calibration.range_max_m) {
        continue;
      }
      const Eigen::Vector3d p =
          T_map_base * calibration.T_base_depth * calibration.depth.back_project(u, v, z);
      const ClassId class_id = test::four_classes().class_of(frame.depth_label(v, u));
      ++counts[voxel_of(p, edge_m)][class_id];
    }
  }
}

/// V by the words of its definition.
std::map<VoxelKey, std::pair<ClassId, std::uint32_t>> plain_truth(const PlainCounts& counts,
                                                                  const SurfaceTruth& surface,
                                                                  std::uint32_t min_samples) {
  std::map<VoxelKey, std::pair<ClassId, std::uint32_t>> truth;
  for (const auto& [key, by_class] : counts) {
    std::uint32_t total = 0, most = 0;
    ClassId owner = kBackground;
    for (const auto& [class_id, samples] : by_class) {
      total += samples;
      if (samples > most) owner = class_id;
      most = std::max(most, samples);
    }
    if (total < min_samples || owner == kBackground || !surface.contains(key, owner)) continue;
    truth[key] = {owner, total};
  }
  return truth;
}

TEST(VisibleTruth, OfAnySubsetEqualsAPlainRecountAtOddLattices) {
  const Calibration calibration = tilted_camera();
  const ClassTable table = test::four_classes();
  const struct {
    double edge_m;
    Eigen::Vector3d origin_m;
    double yaw_rad;
  } lattices[] = {
      {0.0437, {0.0137, -3.77, 12.3}, 0.7}, {0.1, {0, 0, 0}, 0}, {0.1531, {-7, 2, 1e-3}, -3}};
  std::size_t compared = 0;
  for (const auto& lattice : lattices) {
    const Pose T_map_world = map_from_world(lattice.origin_m, lattice.yaw_rad);
    for (const std::vector<int>& subset : {std::vector{1}, {1, 3}, {0, 1, 2, 3, 4}}) {
      SampleCounter counter(lattice.edge_m);
      PlainCounts plain;
      std::vector<SurfaceVoxel> rows;
      for (const int n : subset) {
        counter.add(random_frame(n), calibration, table, T_map_world * some_pose(n));
        count_plainly(n, calibration, T_map_world * some_pose(n), lattice.edge_m, plain);
      }
      for (const auto& [key, by_class] : plain) {
        rows.push_back({key, static_cast<ClassId>(1 + ((key.i + key.j) & 1)), false});  // by turns
      }
      const SurfaceTruth surface(std::move(rows), lattice.edge_m);
      for (const int min_samples : {1, 2, 4}) {
        const auto expected = plain_truth(plain, surface, static_cast<std::uint32_t>(min_samples));
        const VisibleTruth truth = visible_truth(counter, surface, min_samples);
        ASSERT_EQ(truth.voxels().size(), expected.size());
        compared += expected.size();
        for (const VisibleVoxel& voxel : truth.voxels()) {
          EXPECT_EQ(std::pair(voxel.owner, voxel.samples), expected.at(voxel.key));
        }
      }
    }
  }
  EXPECT_GT(compared, 400u);
}

}  // namespace
}  // namespace mapscore::eval
