// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/mapper.hpp"

#include "tests/core/segmentation/edge_aligned/plate_scene.hpp"

#include <gtest/gtest.h>

namespace mapscore {
namespace {

using testing::PlateScene;

/// A frame shows that the calibration stands. The next, of plates elsewhere by 11 px, is then not
/// mended; first of another map it is, unless that map was told before.
TEST(Mapper, FramesLearnFromThoseBeforeThemOrFromAFirstLook) {
  const PlateScene scene({{-0.6, -0.1, -0.4, 0.3, 1.4, 1}, {0.2, 0.7, -0.3, 0.4, 2.0, 2}});
  const PlateScene moved({{-0.54, -0.04, -0.4, 0.3, 1.4, 1}, {0.29, 0.79, -0.3, 0.4, 2.0, 2}});
  const auto sight = [&](const PlateScene& depth) {
    return Sight(scene.truth(), depth.depth(), scene.detections());
  };
  const auto points_of = [&](Mapper& mapper, const PlateScene& depth) {
    RandomStream draws(0, "belief");
    const std::vector<Segment> segments = mapper.integrate(sight(depth), {}, draws);
    return segments.at(0).points.size() + segments.at(1).points.size();
  };
  const Mapping mapping{.segmentation = EdgeAligned{}};
  Mapper mapper(mapping, 2), fresh(mapping, 2);
  static_cast<void>(points_of(mapper, scene));
  const std::size_t alone = points_of(fresh, moved), after = points_of(mapper, moved);
  EXPECT_LT(after + 500, alone);
  mapper = Mapper(mapping, 2);
  EXPECT_EQ(points_of(mapper, moved), alone);

  CalibrationEvidence told;
  told.add(fitted(sight(scene), mapping.segmentation));
  told.close();
  mapper = Mapper(mapping, 2, told);
  EXPECT_EQ(points_of(mapper, moved), after);
}

}  // namespace
}  // namespace mapscore
