// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/growing/region_growing.hpp"
#include "core/segmentation/segmentation.hpp"
#include "eval/recording/recording.hpp"
#include "tests/end_to_end/program.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

namespace mapscore::testing {
namespace {

/// The fast form of region growing against the plain one, on every detection of every frame.
void expect_equal_forms(const Frame& frame, const eval::RecordingInfo& info, double voxel_m) {
  const std::vector<Detection> detections = detections_of(frame.label, info.table);
  const RegisteredCloud cloud = register_depth(
      frame.depth, info.calibration, pixels_wanted(detections, frame.label.cols, frame.label.rows));
  for (const Detection& detection : detections) {
    const auto points = segment(detection, cloud, voxel_m, Direct{}, false).points;
    const auto seed = seed_point(detection, cloud, SeedRule::mask_centroid);
    if (!seed) continue;
    for (const double factor : {1.0, 0.5}) {
      for (const bool released : {false, true}) {
        const Region fast = grow_region(points, *seed, voxel_m, factor, released);
        const Region plain = grow_region_reference(points, *seed, voxel_m, factor, released);
        EXPECT_TRUE(fast.positions == plain.positions && fast.points == plain.points)
            << "frame " << frame.index << ", instance " << detection.instance << ", factor "
            << factor;
      }
    }
  }
}

TEST(DemoGrowing, FastFormEqualsThePlainOneOnEveryFrameOfTheDemo) {
  const TemporaryFolder folder;
  const std::string recorded = folder.path() / "demo";
  expect_done(mapscore({"record", MAPSCORE_SOURCE_DIR "/configs/demo.yaml", "-o", recorded, "-q"}));
  const eval::Recording recording = eval::Recording::open(recorded);
  ASSERT_GT(recording.frame_count(), 50);
  for (int frame = 0; frame < recording.frame_count(); ++frame)
    expect_equal_forms(
        recording.read(frame, {.color = false, .label = true, .depth = true, .depth_label = false}),
        recording.info(), frame % 4 == 0 ? 0.02 : 0.05);
}

}  // namespace
}  // namespace mapscore::testing
