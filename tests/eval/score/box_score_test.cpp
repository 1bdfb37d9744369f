// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/box_score.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const AlignedBox3d kUnit(Vector3d(0, 0, 0), Vector3d(1, 1, 1));

TEST(BoxScore, IouByHand) {
  EXPECT_EQ(box_iou(kUnit, kUnit, 0.0), 1.0);
  const AlignedBox3d half(Vector3d(0.5, 0, 0), Vector3d(1.5, 1, 1));
  EXPECT_DOUBLE_EQ(box_iou(kUnit, half, 0.0), 0.5 / 1.5);
  EXPECT_DOUBLE_EQ(box_iou(half, kUnit, 0.25), 1.0 / 2.0);  // 1 of 1.5 + 1.5 - 1, times 1.5^2
  const AlignedBox3d inside(Vector3d(0.25, 0.25, 0.25), Vector3d(0.75, 0.75, 0.75));
  EXPECT_DOUBLE_EQ(box_iou(kUnit, inside, 0.0), 0.125);
  EXPECT_EQ(box_iou(kUnit, AlignedBox3d(Vector3d(1, 0, 0), Vector3d(2, 1, 1)), 0.0), 0.0);
  EXPECT_EQ(box_iou(kUnit, AlignedBox3d(Vector3d(3, 3, 0), Vector3d(4, 4, 1)), 0.5), 0.0);
}

TEST(BoxScore, FlatAndEmptyBoxes) {
  const AlignedBox3d picture(Vector3d(0, 0, 2), Vector3d(1, 1, 2));
  const AlignedBox3d behind(Vector3d(0, 0, 2.05), Vector3d(1, 1, 2.05));
  EXPECT_EQ(box_iou(picture, picture, 0.0), 0.0);
  EXPECT_EQ(box_iou(picture, picture, 0.025), 1.0);
  EXPECT_NEAR(box_iou(picture, behind, 0.05), 0.05 / 0.15, 1e-12);
  EXPECT_EQ(box_iou(AlignedBox3d(), kUnit, 0.1), 0.0);
  EXPECT_EQ(box_iou(kUnit, AlignedBox3d(), 0.1), 0.0);
}

TEST(BoxScore, IouIsSymmetricWithinBoundsAndOneOnlyForItself) {
  RandomStream random(1, "boxes");
  const auto box = [&random] {
    AlignedBox3d made;
    for (int n = 0; n < 2; ++n)
      made.extend(Vector3d(random.uniform(), random.uniform(), random.uniform()));
    return made;
  };
  for (int n = 0; n < 500; ++n) {
    const AlignedBox3d a = box(), b = box();
    const double iou = box_iou(a, b, 0.02);
    EXPECT_EQ(iou, box_iou(b, a, 0.02));
    EXPECT_TRUE(iou >= 0.0 && iou < 1.0);
    EXPECT_DOUBLE_EQ(box_iou(a, a, 0.02), 1.0);
  }
}

TEST(BoxScore, CountsAndPools) {
  BoxCounts counts;
  const AlignedBox3d quarter(Vector3d(0, 0, 0), Vector3d(1, 1, 0.25));
  const AlignedBox3d half(Vector3d(0, 0, 0), Vector3d(1, 1, 0.5));
  counts.add(kUnit, kUnit, 0.0);
  counts.add(half, kUnit, 0.0);
  counts.add(quarter, kUnit, 0.0);
  counts.add(AlignedBox3d(), kUnit, 0.0);           // skipped
  counts.add(kUnit, AlignedBox3d(), 0.0);           // its instance has no sample
  counts.add(AlignedBox3d(), AlignedBox3d(), 0.0);  // skipped, and no sample
  EXPECT_EQ(counts, (BoxCounts{4, 2, 1750000000, 3, 2, 1}));
  EXPECT_EQ(counts.metrics(),
            (std::vector<Metric>{
                {"box_iou", 0.4375}, {"box_25", 0.75}, {"box_50", 0.5}, {"box_75", 0.25}}));
  counts += counts;
  EXPECT_EQ(counts, (BoxCounts{8, 4, 3500000000, 6, 4, 2}));
  for (const Metric& metric : BoxCounts{0, 3, 0, 0, 0, 0}.metrics())
    EXPECT_EQ(metric.value, std::nullopt);
}

TEST(BoxScore, TruthBoxesHoldTheSamplesOfEachInstance) {
  Calibration calibration;
  calibration.depth = {4, 2, 100, 100, 1, 0};
  calibration.range_min_m = 0.5;
  calibration.range_max_m = 2.0;
  Frame frame;
  frame.depth = (cv::Mat1w(2, 4) << 2500, 5000, 10000, 10001,  //
                 0, 5000, 5000, 2499);
  frame.depth_label = (cv::Mat1w(2, 4) << 1, 2, 1, 1,  //
                       1, 0, 7, 3);
  const auto boxes = truth_boxes(frame, calibration, 5);
  ASSERT_EQ(boxes.size(), 5u);
  EXPECT_TRUE(boxes[1].isApprox(AlignedBox3d(Vector3d(-0.005, 0, 0.5), Vector3d(0.02, 0, 2))));
  EXPECT_TRUE(boxes[2].isApprox(AlignedBox3d(Vector3d(0, 0, 1), Vector3d(0, 0, 1))));
  for (const std::size_t none : {0u, 3u, 4u}) EXPECT_TRUE(boxes[none].isEmpty()) << none;
  frame.depth_label = cv::Mat1w();
  EXPECT_THAT([&] { (void)truth_boxes(frame, calibration, 5); },
              ThrowsMessage<Error>(HasSubstr("depth_label")));
}

TEST(BoxScore, AgreesWithTheSamplesOfARecording) {
  const RecordingInfo info = mapscore::testing::tiny_info();
  for (const Frame& frame : mapscore::testing::tiny_frames()) {
    std::vector<AlignedBox3d> plain(3);
    for (int v = 0; v < frame.depth.rows; ++v)
      for (int u = 0; u < frame.depth.cols; ++u) {
        const InstanceId id = frame.depth_label(v, u);
        if (id == 0 || frame.depth(v, u) == 0) continue;
        const double z = frame.depth(v, u) / kDepthUnitsPerMetre;
        plain[id].extend(info.calibration.depth.back_project(u, v, z));
      }
    const auto boxes = truth_boxes(frame, info.calibration, info.table.instances.size());
    for (std::size_t id = 1; id < 3; ++id) {
      ASSERT_FALSE(boxes[id].isEmpty());
      EXPECT_EQ(boxes[id].min(), plain[id].min());
      EXPECT_EQ(boxes[id].max(), plain[id].max());
    }
  }
}

}  // namespace
}  // namespace mapscore::eval
