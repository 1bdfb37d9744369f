// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/mapper.hpp"

#include "tests/core/segmentation/edge_aligned/plate_scene.hpp"

#include <gtest/gtest.h>

namespace mapscore {
namespace {

using testing::PlateScene;

/// Nine frames show that the calibration stands. The tenth, of plates elsewhere by 11 px, is then
/// not mended; first of another map it is.
TEST(Mapper, FramesLearnFromThoseBeforeThemInTheSameMap) {
  const PlateScene scene({{-0.6, -0.1, -0.4, 0.3, 1.4, 1}, {0.2, 0.7, -0.3, 0.4, 2.0, 2}});
  const PlateScene moved({{-0.54, -0.04, -0.4, 0.3, 1.4, 1}, {0.29, 0.79, -0.3, 0.4, 2.0, 2}});
  const Calibration& believed = scene.truth();
  const auto points_of = [&](Mapper& mapper, const PlateScene& depth) {
    RandomStream draws(0, "belief");
    const std::vector<Segment> segments =
        mapper.integrate({believed, depth.depth(), scene.detections()}, {}, draws);
    return segments.at(0).points.size() + segments.at(1).points.size();
  };
  const Mapping mapping{.segmentation = EdgeAligned{}};
  Mapper mapper(mapping, 2), fresh(mapping, 2);
  const std::size_t whole = points_of(mapper, scene);
  for (int n = 1; n < 9; ++n) EXPECT_EQ(points_of(mapper, scene), whole);
  const std::size_t alone = points_of(fresh, moved);
  EXPECT_LT(points_of(mapper, moved) + 500, alone);
  mapper = Mapper(mapping, 2);
  EXPECT_EQ(points_of(mapper, moved), alone);
}

}  // namespace
}  // namespace mapscore
