// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/surface_truth.hpp"

#include "core/error.hpp"
#include "tests/eval/truth/surface_patches.hpp"
#include "tests/eval/truth/truth_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;
using test::truth_of;

Shape cube_shape(double low, double high) {
  return test::box_shape(Vector3d::Constant(low), Vector3d::Constant(high), 1);
}

TEST(SurfaceTruth, FacesOnTheLatticeTouchBothSides) {
  for (const double epsilon_m : {0.0, 0.0005}) {
    const auto truth = truth_of({cube_shape(0, 0.2)}, 0.05, epsilon_m);
    EXPECT_EQ(truth.count(1), 208u);  // 6^3 - 2^3
    EXPECT_EQ(test::touch_only_count(truth), 208u);
    EXPECT_TRUE(truth.contains({-1, -1, -1}, 1));
    EXPECT_TRUE(truth.contains({0, 0, 0}, 1));
    EXPECT_FALSE(truth.contains({1, 1, 1}, 1));
    EXPECT_FALSE(truth.contains({0, 0, 0}, 2));
  }
}

TEST(SurfaceTruth, FacesOnTheLatticeDoSoAtAnyDecimalPlace) {
  // 3 * 0.05 is not the double 0.15: contact must not hang on the last bit.
  for (int n = -40; n < 40; ++n) {
    const double low = n / 20.0;
    EXPECT_EQ(truth_of({cube_shape(low, low + 0.2)}, 0.05).count(1), 208u) << n;
  }
}

TEST(SurfaceTruth, FacesAcrossTheLatticeTouchOneLayer) {
  for (const double epsilon_m : {0.0, 0.0005}) {
    const auto truth = truth_of({cube_shape(0.025, 0.225)}, 0.05, epsilon_m);
    EXPECT_EQ(truth.count(1), 98u);  // 5^3 - 3^3
    EXPECT_EQ(test::touch_only_count(truth), 0u);
  }
}

TEST(SurfaceTruth, FacesWithinEpsilonOfTheLatticeTouchBothSides) {
  EXPECT_EQ(truth_of({cube_shape(0.0003, 0.1997)}, 0.05, 0).count(1), 56u);  // 4^3 - 2^3
  const auto truth = truth_of({cube_shape(0.0003, 0.1997)}, 0.05, 0.0005);
  EXPECT_EQ(truth.count(1), 208u);
  EXPECT_EQ(test::touch_only_count(truth), 152u);  // all but the 56
}

TEST(SurfaceTruth, FloorsOnAndBesideTheLattice) {
  struct Case {
    double z, epsilon_m;
    std::size_t voxels, touch_only;
    int low, high;
  };
  // A floor of 4 x 4 voxels touches 6 x 6 columns; the 20 outer ones only by contact.
  for (const Case& c : {Case{0, 0, 72, 72, -1, 0}, Case{1e-9, 0, 36, 20, 0, 0},
                        Case{-1e-9, 0, 36, 20, -1, -1}, Case{1e-4, 0, 36, 20, 0, 0},
                        Case{1e-4, 0.0005, 72, 56, -1, 0}, Case{-1e-9, 0.0005, 72, 56, -1, 0}}) {
    SCOPED_TRACE(::testing::Message() << "z " << c.z << " epsilon " << c.epsilon_m);
    Shape floor;
    floor.kind = ShapeKind::plane;
    floor.size = {0.1, 0.1, 0};
    floor.T_world_shape.translation() = Vector3d(0.1, 0.1, c.z);
    const auto truth = truth_of({floor}, 0.05, c.epsilon_m);
    EXPECT_EQ(truth.count(kBackground), c.voxels);
    EXPECT_EQ(test::touch_only_count(truth), c.touch_only);
    EXPECT_EQ(truth.contains({1, 1, -1}, 0), c.low == -1);
    EXPECT_EQ(truth.contains({1, 1, 0}, 0), c.high == 0);
    EXPECT_FALSE(truth.contains({1, 1, 1}, 0));
  }
}

TEST(SurfaceTruth, VoxelsOfTwoClassesBelongToBoth) {
  const auto truth = truth_of({test::box_shape({0, 0, 0}, {0.2, 0.2, 0.2}, 2),
                               test::box_shape({0, 0, 0.2}, {0.2, 0.2, 0.4}, 1)},
                              0.05);
  EXPECT_EQ(truth.count(1), 208u);  // contact faces stay
  EXPECT_EQ(truth.count(2), 208u);
  const auto both = truth.classes_at({1, 1, 3});
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].class_id, 1);
  EXPECT_EQ(both[1].class_id, 2);
  EXPECT_EQ(truth.classes_at({1, 1, 0}).size(), 1u);
  EXPECT_TRUE(truth.classes_at({1, 1, 20}).empty());
  EXPECT_TRUE(truth.touches_any({1, 1, 0}));
  EXPECT_FALSE(truth.touches_any({1, 1, 20}));
}

TEST(SurfaceTruth, TouchOnlyNeedsEveryShapeOfTheClass) {
  const Shape on = test::box_shape({0, 0, 0}, {0.2, 0.2, 0.2}, 1);
  const Shape across = test::box_shape({0.5, 0, -0.02}, {0.7, 0.2, 0.18}, 1);
  Shape into = test::box_shape({0, 0, 0.22}, {0.04, 0.04, 0.24}, 1);
  const auto truth = truth_of({on, across, into}, 0.05);
  ASSERT_EQ(truth.classes_at({0, 0, 4}).size(), 1u);
  EXPECT_FALSE(truth.classes_at({0, 0, 4})[0].touch_only);
  EXPECT_TRUE(truth.classes_at({2, 2, 4})[0].touch_only);
  into.instance = 2;
  const auto apart = truth_of({on, across, into}, 0.05);
  ASSERT_EQ(apart.classes_at({0, 0, 4}).size(), 2u);
  EXPECT_TRUE(apart.classes_at({0, 0, 4})[0].touch_only);
  EXPECT_FALSE(apart.classes_at({0, 0, 4})[1].touch_only);
}

// Every sample of the surface lies in a voxel of the truth; every voxel of the truth has a point of
// the surface within 1e-8; none of its neighbours outside the truth has one.
TEST(SurfaceTruth, IsTheSetThatDenseSamplingFinds) {
  constexpr double kPatchEdge = 0.06;
  for (const ShapeKind kind : test::kAllKinds) {
    SCOPED_TRACE(name_of(kind));
    RandomStream random(2, name_of(kind));
    for (int round = 0; round < 3; ++round) {
      Shape shape = test::random_shape(kind, random);
      shape.instance = 1;
      const Pose T_map_world = map_from_world({0.011, -0.023, 0.017}, 0.4);
      const auto truth =
          surface_truth({shape}, test::four_classes(), T_map_world, {kPatchEdge, 0, 1});
      const auto patches = test::patches_of(shape, T_map_world);
      for (const auto& patch : patches) {
        for (int i = 0; i <= 150; ++i) {
          for (int j = 0; j <= 150; ++j) {
            ASSERT_TRUE(truth.contains(voxel_of(patch(i / 150.0, j / 150.0), kPatchEdge), 1));
          }
        }
      }
      std::set<VoxelKey> around;
      for (const SurfaceVoxel& voxel : truth.voxels()) {
        for (int n = 0; n < 27; ++n) {
          around.insert(
              {voxel.key.i + n % 3 - 1, voxel.key.j + n / 3 % 3 - 1, voxel.key.k + n / 9 - 1});
        }
      }
      for (const VoxelKey& key : around) {
        const Vector3d low = low_corner_of(key, kPatchEdge);
        const double d = test::sampled_distance(
            patches, Eigen::AlignedBox3d(low, (low.array() + kPatchEdge).matrix()), 12);
        if (truth.contains(key, 1)) {
          EXPECT_LT(d, 1e-8);
        } else {
          EXPECT_GT(d, 0);
        }
      }
    }
  }
}

std::vector<Shape> random_scene(int count) {
  RandomStream random(9, "scene");
  std::vector<Shape> shapes;
  for (int i = 0; i < count; ++i) {
    shapes.push_back(test::random_shape(test::kAllKinds[i % 7], random, 0.4));
    shapes.back().instance = static_cast<InstanceId>(i % 4);
  }
  return shapes;
}

std::vector<SurfaceVoxel> rows_of(const SurfaceTruth& truth) {
  return {truth.voxels().begin(), truth.voxels().end()};
}

TEST(SurfaceTruth, DependsNeitherOnTheOrderOfShapesNorOnThreads) {
  std::vector<Shape> shapes = random_scene(40);
  const ClassTable table = test::four_classes();
  const auto rows = rows_of(surface_truth(shapes, table, Pose::Identity(), {0.02, 0.0005, 1}));
  ASSERT_GT(rows.size(), 1000u);
  EXPECT_EQ(rows, rows_of(surface_truth(shapes, table, Pose::Identity(), {0.02, 0.0005, 3})));
  std::reverse(shapes.begin(), shapes.end());
  EXPECT_EQ(rows, rows_of(surface_truth(shapes, table, Pose::Identity(), {0.02, 0.0005, 2})));
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return std::pair(a.key, a.class_id) < std::pair(b.key, b.class_id);
  }));
}

TEST(SurfaceTruth, MovesWithTheSceneByWholeVoxels) {
  const std::vector<Shape> shapes = random_scene(28);
  const ClassTable table = test::four_classes();
  constexpr double kMovedEdge = 0.04;
  auto rows = rows_of(surface_truth(shapes, table, Pose::Identity(), {kMovedEdge, 0.0005, 1}));
  const Pose T_map_world = map_from_world({-7 * kMovedEdge, 130 * kMovedEdge, 3 * kMovedEdge}, 0);
  const auto moved = rows_of(surface_truth(shapes, table, T_map_world, {kMovedEdge, 0.0005, 1}));
  for (SurfaceVoxel& row : rows) {
    row.key = {row.key.i + 7, row.key.j - 130, row.key.k - 3};
  }
  EXPECT_EQ(rows, moved);
}

TEST(SurfaceTruth, FindsItsRowsAndNothingElse) {
  // Layers of i far apart, below and above 0, and lists of one and of several classes.
  RandomStream random(17, "rows");
  std::vector<SurfaceVoxel> rows;
  for (const int i : {-1000, -999, -9, -8, -1, 0, 1, 7, 8, 700}) {
    for (int n = 0; n < 20; ++n) {
      const VoxelKey key{i, static_cast<int>(9 * random.uniform()) - 4,
                         static_cast<int>(9 * random.uniform()) - 4};
      for (ClassId c = 0; c < 3; ++c) {
        if (random.uniform() < 0.5) rows.push_back({key, c, random.uniform() < 0.5});
      }
    }
  }
  const auto before = [](const SurfaceVoxel& a, const SurfaceVoxel& b) {
    return std::pair(a.key, a.class_id) < std::pair(b.key, b.class_id);
  };
  std::stable_sort(rows.begin(), rows.end(), before);
  rows.erase(std::unique(rows.begin(), rows.end(),
                         [&](const auto& a, const auto& b) { return !before(a, b); }),
             rows.end());
  const SurfaceTruth truth(rows, 0.05);
  for (const int i : {-2147483647, -1001, -1000, -999, -998, -9, -8, -7, -1, 0, 1, 2, 7, 8, 9, 699,
                      700, 701, 2147483647}) {
    for (int j = -5; j <= 5; ++j) {
      for (int k = -5; k <= 5; ++k) {
        std::vector<SurfaceVoxel> here;
        std::copy_if(rows.begin(), rows.end(), std::back_inserter(here),
                     [&](const SurfaceVoxel& row) {
                       return row.key == VoxelKey{i, j, k};
                     });
        const auto found = truth.classes_at({i, j, k});
        ASSERT_TRUE(std::equal(found.begin(), found.end(), here.begin(), here.end()));
        ASSERT_EQ(truth.touches_any({i, j, k}), !here.empty());
      }
    }
  }
  EXPECT_FALSE(SurfaceTruth().touches_any({0, 0, 0}));
  EXPECT_FALSE(SurfaceTruth({}, 0.05).touches_any({0, 0, 0}));
}

TEST(SurfaceTruth, RefusesOptionsThatMakeNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto with = [](SurfaceOptions options) {
    return surface_truth({cube_shape(0, 0.2)}, test::four_classes(), Pose::Identity(), options);
  };
  EXPECT_THROW((void)with({0, 0, 1}), Error);
  EXPECT_THROW((void)with({nan, 0, 1}), Error);
  EXPECT_THROW((void)with({0.05, -0.001, 1}), Error);
  EXPECT_THROW((void)with({0.05, 0, 0}), Error);
  EXPECT_THROW((void)with({1e-9, 0, 2}), Error);  // beyond 2^20 voxels
  EXPECT_EQ(truth_of({}, 0.05).voxels().size(), 0u);
}

}  // namespace
}  // namespace mapscore::eval
