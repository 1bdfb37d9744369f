// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/eval/truth/brute_force_shapes.hpp"
#include "tests/eval/truth/truth_scenes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <vector>

// Homes stand on the lattice: a floor, or the top of a box, beside the plane z = 0 between the
// layers -1 and 0. A closed cube touches what lies within 1e-10 m of it, an open one what lies
// deeper in it than that; epsilon widens the closed cube only.

namespace mapscore::eval {
namespace {

enum class Layer { absent, touch_only, meets };

struct FloorCase {
  double height_m, epsilon_m;
  Layer below, above;  ///< what the layers -1 and 0 hold of it
};

std::ostream& operator<<(std::ostream& out, const FloorCase& c) {
  return out << "height " << c.height_m << " epsilon " << c.epsilon_m;
}

constexpr Layer kNone = Layer::absent, kTouch = Layer::touch_only, kMeets = Layer::meets;

constexpr std::array kCases{
    // Without epsilon, a surface on the plane touches both layers and meets none.
    FloorCase{0, 0, kTouch, kTouch},
    FloorCase{1e-9, 0, kNone, kMeets},
    FloorCase{-1e-9, 0, kMeets, kNone},
    FloorCase{1e-4, 0, kNone, kMeets},
    FloorCase{-1e-4, 0, kMeets, kNone},
    // With it, one beside the plane also reaches the layer that it is not in.
    FloorCase{0, 0.0005, kTouch, kTouch},
    FloorCase{1e-9, 0.0005, kTouch, kMeets},
    FloorCase{-1e-9, 0.0005, kMeets, kTouch},
    FloorCase{1e-4, 0.0005, kTouch, kMeets},
    FloorCase{-1e-4, 0.0005, kMeets, kTouch},
    // The contact: within it a surface lies on the plane.
    FloorCase{5e-11, 0, kTouch, kTouch},
    FloorCase{-5e-11, 0, kTouch, kTouch},
    FloorCase{2e-10, 0, kNone, kMeets},
    FloorCase{-2e-10, 0, kMeets, kNone},
    // The end of epsilon's reach, contact included.
    FloorCase{0.000499, 0.0005, kTouch, kMeets},
    FloorCase{0.0005, 0.0005, kTouch, kMeets},
    FloorCase{0.000501, 0.0005, kNone, kMeets},
    FloorCase{-0.0005, 0.0005, kMeets, kTouch},
    FloorCase{-0.000501, 0.0005, kMeets, kNone},
};

/// A floor at z, as a plane or as two triangles, or a box of a metre with its top there; all far
/// wider than the column looked at.
Shape floor_at(double z) {
  return test::placed(ShapeKind::plane, {0.5, 0.5, 0}, {0, 0, z});
}
Shape triangles_at(double z) {
  const Eigen::Vector3d a(-0.5, -0.5, 0), b(0.5, -0.5, 0), c(0.5, 0.5, 0), d(-0.5, 0.5, 0);
  return test::placed(ShapeKind::mesh, {0, 0, 0}, {0, 0, z}, {{a, b, c}, {a, c, d}});
}
Shape box_below(double z) {
  return test::placed(ShapeKind::box, {0.5, 0.5, 0.5}, {0, 0, z - 0.5});
}

Layer layer_of(const SurfaceTruth& truth, int k) {
  const auto rows = truth.classes_at({1, -2, k});
  if (rows.empty()) return Layer::absent;
  EXPECT_EQ(rows.size(), 1u);
  return rows[0].touch_only ? Layer::touch_only : Layer::meets;
}

void expect_layers(const SurfaceTruth& truth, int plane, const FloorCase& c) {
  EXPECT_EQ(layer_of(truth, plane - 2), Layer::absent);
  EXPECT_EQ(layer_of(truth, plane - 1), c.below);
  EXPECT_EQ(layer_of(truth, plane), c.above);
  EXPECT_EQ(layer_of(truth, plane + 1), Layer::absent);
}

using MakeShape = Shape (*)(double);
constexpr std::array<MakeShape, 3> kMakers{floor_at, triangles_at, box_below};

TEST(LatticeFloor, LayersBesideThePlane) {
  for (const MakeShape make : kMakers) {
    for (const FloorCase& c : kCases) {
      for (const double edge_m : {0.01, 0.02, 0.05, 0.1}) {
        SCOPED_TRACE(::testing::Message() << c << " edge " << edge_m);
        expect_layers(test::truth_of({make(c.height_m)}, edge_m, c.epsilon_m), 0, c);
      }
    }
  }
}

TEST(LatticeFloor, EveryPlaneOfTheLatticeIsLikeZero) {
  // n / 20 is not the double n * 0.05: contact must not hang on the last bit.
  for (const MakeShape make : kMakers) {
    for (const FloorCase& c : kCases) {
      for (const int n : {-47, -3, 3, 7, 19, 46}) {
        SCOPED_TRACE(::testing::Message() << c << " plane " << n);
        expect_layers(test::truth_of({make(n / 20.0 + c.height_m)}, 0.05, c.epsilon_m), n, c);
      }
    }
  }
}

TEST(LatticeFloor, OriginOfTheMapAtTheFloor) {
  // A floor at 0.37 under a map that begins there, turned by a quarter.
  const Pose T_map_world = map_from_world({0, 0, 0.37}, std::numbers::pi / 2);
  for (const FloorCase& c : kCases) {
    SCOPED_TRACE(::testing::Message() << c);
    const auto truth = surface_truth({floor_at(0.37 + c.height_m)}, test::four_classes(),
                                     T_map_world, {0.05, c.epsilon_m, 1});
    expect_layers(truth, 0, c);
  }
}

TEST(LatticeFloor, WholeFloorsByCount) {
  // 1 m x 1 m at 10 cm: 12 x 12 columns, the 44 outer ones by contact, in each layer that it is in.
  for (const FloorCase& c : kCases) {
    SCOPED_TRACE(::testing::Message() << c);
    std::size_t voxels = 0, touch_only = 0;
    for (const Layer layer : {c.below, c.above}) {
      if (layer != Layer::absent) voxels += 144;
      if (layer == Layer::touch_only) touch_only += 144;
      if (layer == Layer::meets) touch_only += 44;
    }
    const auto truth = test::truth_of({floor_at(c.height_m)}, 0.1, c.epsilon_m);
    EXPECT_EQ(truth.count(1), voxels);
    EXPECT_EQ(test::touch_only_count(truth), touch_only);
  }
}

TEST(LatticeFloor, BoxOnTheFloorSharesBothLayersWithIt) {
  // Floor and underside touch without burying each other: both classes keep both layers.
  Shape floor = floor_at(0);
  floor.instance = 0;
  const Shape box = test::box_shape({-0.3, -0.3, 0}, {0.3, 0.3, 0.4}, 2);
  for (const double epsilon_m : {0.0, 0.0005}) {
    const auto truth = test::truth_of({floor, box}, 0.05, epsilon_m);
    for (const int k : {-1, 0}) {
      const auto rows = truth.classes_at({1, -2, k});
      ASSERT_EQ(rows.size(), 2u);
      EXPECT_EQ(rows[0], (SurfaceVoxel{{1, -2, k}, kBackground, true}));
      EXPECT_EQ(rows[1], (SurfaceVoxel{{1, -2, k}, 2, true}));
    }
    EXPECT_TRUE(truth.classes_at({1, -2, 1}).empty());
  }
}

}  // namespace
}  // namespace mapscore::eval
