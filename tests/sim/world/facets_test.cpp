// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/facets.hpp"

#include "tests/sim/world/shape_distance.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace mapscore::sim {
namespace {

struct RoundShape {
  ShapeKind kind;
  Eigen::Vector3d size;
};
void PrintTo(const RoundShape& shape, std::ostream* out) {
  *out << name_of(shape.kind) << " " << shape.size.transpose();
}

class FacetsTest : public ::testing::TestWithParam<RoundShape> {
 protected:
  Facets facets = facets_of(GetParam().kind, GetParam().size, kFacetToleranceM);

  /// Points spread over each face, corners and middle among them.
  template <typename Visit>
  void visit_points(Visit visit) const {
    constexpr int kSteps = 6;
    for (const auto& face : facets.faces) {
      for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; i + j <= kSteps; ++j) {
          const double a = static_cast<double>(i) / kSteps, b = static_cast<double>(j) / kSteps;
          visit(a * facets.vertices[face[0]] + b * facets.vertices[face[1]] +
                (1 - a - b) * facets.vertices[face[2]]);
        }
      }
    }
  }
};

TEST_P(FacetsTest, StayWithinTolerance) {
  Shape exact;
  exact.kind = GetParam().kind;
  exact.size = GetParam().size;
  double worst = 0;
  visit_points([&](const Eigen::Vector3d& p) {
    worst = std::max(worst, testing::distance_to_surface(exact, p));
  });
  EXPECT_LE(worst, 1.001 * kFacetToleranceM);
}

TEST_P(FacetsTest, CloseAndFaceOutwards) {
  // The divergence theorem: the signed volume of a closed, outward surface is just below the exact
  // one.
  double volume = 0;
  for (const auto& [a, b, c] : facets.faces) {
    volume += facets.vertices[a].dot(facets.vertices[b].cross(facets.vertices[c])) / 6;
  }
  const auto& [kind, s] = GetParam();
  const double ball = 4.0 / 3.0 * M_PI;
  const double exact = kind == ShapeKind::sphere      ? ball * std::pow(s.x(), 3)
                       : kind == ShapeKind::ellipsoid ? ball * s.prod()
                       : kind == ShapeKind::cylinder
                           ? M_PI * s.x() * s.x() * 2 * s.y()
                           : M_PI * s.x() * s.x() * 2 * s.y() + ball * std::pow(s.x(), 3);
  EXPECT_LT(volume, exact);
  EXPECT_GT(volume, 0.85 * exact);
}

TEST_P(FacetsTest, NormalsPointOutwards) {
  for (const auto& [a, b, c] : facets.faces) {
    const Eigen::Vector3d flat = (facets.vertices[b] - facets.vertices[a])
                                     .cross(facets.vertices[c] - facets.vertices[a])
                                     .normalized();
    for (const int corner : {a, b, c}) EXPECT_GT(flat.dot(facets.normals[corner]), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(RoundShapes, FacetsTest,
                         ::testing::Values(RoundShape{ShapeKind::sphere, {0.01, 0, 0}},
                                           RoundShape{ShapeKind::sphere, {0.5, 0, 0}},
                                           RoundShape{ShapeKind::ellipsoid, {0.08, 0.2, 0.05}},
                                           RoundShape{ShapeKind::ellipsoid, {0.2, 0.09, 0.008}},
                                           RoundShape{ShapeKind::cylinder, {0.04, 0.05, 0}},
                                           RoundShape{ShapeKind::cylinder, {0.6, 1.2, 0}},
                                           RoundShape{ShapeKind::capsule, {0.015, 0.3, 0}},
                                           RoundShape{ShapeKind::capsule, {0.3, 0.1, 0}}));

TEST(Facets, SmallShapesTakeFewer) {
  const auto faces = [](double radius) {
    return facets_of(ShapeKind::sphere, {radius, 0, 0}, kFacetToleranceM).faces.size();
  };
  EXPECT_LT(4 * faces(0.02), faces(0.2));
}

TEST(Facets, FlatShapesHaveNone) {
  EXPECT_FALSE(is_round(ShapeKind::box));
  EXPECT_TRUE(facets_of(ShapeKind::box, {1, 1, 1}, kFacetToleranceM).faces.empty());
}

}  // namespace
}  // namespace mapscore::sim
