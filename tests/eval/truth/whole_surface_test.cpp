// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/visible_truth.hpp"
#include "tests/eval/truth/truth_scenes.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using test::kEdge;

TEST(WholeSurface, BelongsToTheLowestClassThatTrulyMeetsTheVoxel) {
  const SurfaceTruth surface({{{0, 0, 0}, 0, false},
                              {{0, 0, 1}, 0, false},  // background gives way to a class
                              {{0, 0, 1}, 2, false},
                              {{0, 0, 1}, 3, false},
                              {{0, 0, 2}, 1, true},  // contact alone gives way to meeting
                              {{0, 0, 2}, 2, false},
                              {{0, 0, 2}, 3, false},
                              {{0, 0, 3}, 0, false},
                              {{0, 0, 3}, 1, true},  // contact alone, but nobody else's
                              {{0, 0, 3}, 2, true},
                              {{0, 0, 4}, 3, false}},
                             kEdge);
  const VisibleTruth whole = whole_surface(surface);
  EXPECT_EQ(whole.edge_m(), kEdge);
  EXPECT_EQ(whole.owner_of({0, 0, 0}), std::nullopt);
  EXPECT_EQ(whole.owner_of({0, 0, 1}), ClassId{2});
  EXPECT_EQ(whole.owner_of({0, 0, 2}), ClassId{2});
  EXPECT_EQ(whole.owner_of({0, 0, 3}), ClassId{1});
  EXPECT_EQ(whole.owner_of({0, 0, 4}), ClassId{3});
  ASSERT_EQ(whole.voxels().size(), 4u);
  for (const VisibleVoxel& voxel : whole.voxels()) EXPECT_EQ(voxel.samples, 0u);
}

TEST(WholeSurface, OfAFaceBetweenTwoVoxelsIsBothVoxels) {
  // A red sheet of 2 x 2 voxels on z = 0, which green closes from below.
  const SurfaceTruth surface = test::truth_of({test::box_shape({0, 0, 0}, {0.2, 0.2, 0.1}, 1),
                                               test::box_shape({0, 0, -0.1}, {0.2, 0.2, 0}, 2)},
                                              kEdge);
  const VisibleTruth whole = whole_surface(surface);
  EXPECT_EQ(whole.count(1) + whole.count(2), whole.voxels().size());
  // All 4 voxels of either box touch its own faces only by contact, as their neighbours do.
  EXPECT_EQ(whole.owner_of({0, 0, 0}), ClassId{1});
  EXPECT_EQ(whole.owner_of({0, 0, -1}), ClassId{1});
  EXPECT_EQ(whole.owner_of({0, 0, -2}), ClassId{2});
}

}  // namespace
}  // namespace mapscore::eval
