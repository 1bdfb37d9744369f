// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/objects/true_objects.hpp"

#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

ObjectBox box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return oriented(Eigen::AlignedBox3d(low, high));
}

MapObject object(ClassId class_id, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  MapObject object;
  object.class_id = class_id;
  object.box = box(low, high);
  return object;
}

TEST(ObjectScore, TruthAgainstItselfIsPerfect) {
  const std::vector<TrueObject> truth{{1, 1, box({0, 0, 0}, {1, 1, 1})},
                                      {2, 1, box({0.5, 0, 0}, {1.5, 1, 1})},
                                      {3, 2, box({0, 0, 0}, {1, 1, 0})}};
  std::vector<MapObject> objects;
  for (const TrueObject& real : truth) {
    objects.push_back(object(real.class_id, {0, 0, 0}, {1, 1, 1}));
    objects.back().box = real.box;
  }
  ObjectCounts all;
  for (const ObjectCounts& of_class : score_objects(objects, truth, 3)) all += of_class;
  EXPECT_EQ(all.found, 3);
  EXPECT_EQ(all.missed() + all.falsely(), 0);
  EXPECT_NEAR(*all.mean(all.iou_sum), 1.0, 1e-7);
  EXPECT_EQ(all.centre_max_m, 0.0);
  EXPECT_EQ(all.size_sum_m, Eigen::Vector3d::Zero());
  EXPECT_FALSE(ObjectCounts().mean(0.0).has_value());
}

TEST(ObjectScore, CountedByHand) {
  const std::vector<TrueObject> truth{{1, 1, box({0, 0, 0}, {1, 1, 1})},
                                      {2, 1, box({5, 0, 0}, {6, 1, 1})},
                                      {3, 2, box({9, 0, 0}, {10, 1, 1})}};
  const std::vector<MapObject> objects{
      object(1, {0.4, 0, 0}, {1.4, 1, 1}),    // overlaps truth 1 less than the next
      object(1, {0.1, 0, 0}, {1.3, 1, 1}),    // found: centre 0.2 off, 0.2 too long
      object(2, {5, 0, 0}, {6, 1, 1}),        // right place, wrong class
      object(2, {9.9, 0, 0}, {10.9, 1, 1})};  // IoU below the gate, centre 0.9 off
  const std::vector<ObjectCounts> counts = score_objects(objects, truth, 3);
  EXPECT_EQ(counts[1].truth, 2);
  EXPECT_EQ(counts[1].found, 1);
  EXPECT_EQ(counts[1].missed(), 1);
  EXPECT_EQ(counts[1].falsely(), 1);
  EXPECT_NEAR(counts[1].centre_sum_m, 0.2, 1e-12);
  EXPECT_NEAR(counts[1].size_sum_m.x(), 0.2, 1e-12);
  EXPECT_NEAR(counts[1].size_share_sum.x(), 0.2 / 1.05, 1e-12);
  EXPECT_NEAR(counts[1].iou_sum, 0.95 / 1.35, 1e-7);  // 5 cm wider: common 0.95, both 1.35 long
  EXPECT_EQ(counts[2].found, 0);
  EXPECT_EQ(counts[2].missed(), 1);
  EXPECT_EQ(counts[2].falsely(), 2);
}

TEST(TrueObjects, SeenBoxLiesInTheSurfaceBox) {
  const RecordingInfo info = mapscore::testing::tiny_info();
  const auto shapes = mapscore::testing::tiny_shapes();
  const std::size_t count = info.table.instances.size();
  SeenInstances seen(count);
  for (const Frame& frame : mapscore::testing::tiny_frames())
    seen.add(frame, info.calibration, frame.T_world_base);
  const auto surface = surface_boxes(shapes, Pose::Identity(), count);
  const std::vector<TrueObject> objects = visible_objects(surface, seen, info.table);
  ASSERT_EQ(objects.size(), 1u);  // the crate; the wall is not detected
  EXPECT_EQ(objects[0].instance, 1);
  EXPECT_EQ(objects[0].box.size_m, surface[1].sizes());
  Eigen::AlignedBox3d wide = surface[1];
  wide.extend(wide.min() - Eigen::Vector3d::Constant(0.001));
  wide.extend(wide.max() + Eigen::Vector3d::Constant(0.001));
  EXPECT_TRUE(wide.contains(seen.boxes()[1]));
  EXPECT_GT(seen.boxes()[1].sizes().maxCoeff(), 0.5 * surface[1].sizes().maxCoeff());
  EXPECT_TRUE(visible_objects(surface, SeenInstances(count), info.table).empty());
}

TEST(TrueObjects, SimulatedPerceptionOfTheTruthIsItsLabels) {
  const RecordingInfo info = mapscore::testing::tiny_info();
  const auto shapes = mapscore::testing::tiny_shapes();
  for (const bool by_surface : {false, true}) {
    const auto models = models_of(shapes, Pose::Identity(), info.table, by_surface);
    ASSERT_EQ(models.size(), 1u);
    for (const Frame& frame : mapscore::testing::tiny_frames()) {
      const Calibration& c = info.calibration;
      const PosedDepth view{c.depth, frame.T_world_base * c.T_base_depth, c.range_min_m,
                            c.range_max_m, frame.depth};
      const cv::Mat1w label = perceive(models, view, 0.001);
      for (int v = 0; v < label.rows; ++v)
        for (int u = 0; u < label.cols; ++u)
          if (frame.depth(v, u) != 0) {
            EXPECT_EQ(label(v, u) == 1, frame.depth_label(v, u) == 1) << u << ' ' << v;
          }
    }
  }
}

}  // namespace
}  // namespace mapscore::eval
