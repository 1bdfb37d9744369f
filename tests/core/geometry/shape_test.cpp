// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/shape.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace mapscore {
namespace {

struct Expected {
  ShapeKind kind;
  const char* name;
  int sizes;
  bool solid;
};

TEST(ShapeKinds, HaveTheirNamesSizesAndInsides) {
  std::set<std::string> names;
  for (const Expected& e :
       {Expected{ShapeKind::plane, "plane", 2, false},
        Expected{ShapeKind::sphere, "sphere", 1, true},
        Expected{ShapeKind::capsule, "capsule", 2, true},
        Expected{ShapeKind::ellipsoid, "ellipsoid", 3, true},
        Expected{ShapeKind::cylinder, "cylinder", 2, true},
        Expected{ShapeKind::box, "box", 3, true}, Expected{ShapeKind::mesh, "mesh", 0, false}}) {
    SCOPED_TRACE(e.name);
    EXPECT_STREQ(name_of(e.kind), e.name);
    EXPECT_EQ(sizes_of(e.kind), e.sizes);
    Shape shape;
    shape.kind = e.kind;
    EXPECT_EQ(shape.solid(), e.solid);
    names.insert(name_of(e.kind));
  }
  EXPECT_EQ(names.size(), 7u);
}

}  // namespace
}  // namespace mapscore
