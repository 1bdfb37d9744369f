// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/sights.hpp"
#include "tests/core/segmentation/edge_aligned/plate_scene.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace mapscore::eval {
namespace {

using mapscore::testing::PlateScene;

const PlateScene kScene({{-0.6, -0.1, -0.4, 0.3, 1.4, 1}, {0.2, 0.7, -0.3, 0.4, 2.0, 2}});

/// A recording of which frames of an even number show two plates, elsewhere each time.
struct Frames {
  Frames() : all(64) { std::iota(all.begin(), all.end(), 0); }

  [[nodiscard]] CalibrationEvidence look(const Segmentation& segmentation) {
    return first_look(segmentation, kScene.truth(), all, [&](int frame) -> Sight {
      if (frame % 2 == 1) return {kScene.truth(), kScene.depth(), {}};
      asked.insert(frame);
      const double aside_m = 0.002 * frame;
      const PlateScene scene({{-0.6 + aside_m, -0.1 + aside_m, -0.4, 0.3, 1.4, 1},
                              {0.2 + aside_m, 0.7 + aside_m, -0.3, 0.4, 2.0, 2}});
      return {kScene.truth(), scene.depth(), scene.detections()};
    });
  }

  std::vector<int> all;
  std::set<int> asked = {};
};

TEST(FirstLook, FitsSomeFramesWithObjectsSpreadOverAll) {
  Frames frames;
  static_cast<void>(frames.look(EdgeAligned()));
  EXPECT_EQ(frames.asked, (std::set<int>{0, 8, 16, 24, 32, 40, 48, 56}));
}

TEST(FirstLook, ReadsNothingWhereTheCalibrationIsTakenAsItIs) {
  Frames frames;
  static_cast<void>(frames.look(Direct()));
  static_cast<void>(frames.look(EdgeAligned{.fit = OutlineFit::masks}));
  EXPECT_TRUE(frames.asked.empty());
}

/// The masks of plates that the depth image has elsewhere, by 11 px.
TEST(FirstLook, TellsTheFirstFrameOfAMapThatTheCalibrationStands) {
  const PlateScene moved({{-0.54, -0.04, -0.4, 0.3, 1.4, 1}, {0.29, 0.79, -0.3, 0.4, 2.0, 2}});
  const Sight first(kScene.truth(), moved.depth(), kScene.detections());
  EXPECT_FALSE(label_surfaces(first, {}).is_as_believed);
  Frames frames;
  EXPECT_TRUE(label_surfaces(first.after(frames.look(EdgeAligned())), {}).is_as_believed);
}

}  // namespace
}  // namespace mapscore::eval
