// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/shape.hpp"

namespace mapscore {

const char* name_of(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::plane:
      return "plane";
    case ShapeKind::sphere:
      return "sphere";
    case ShapeKind::capsule:
      return "capsule";
    case ShapeKind::ellipsoid:
      return "ellipsoid";
    case ShapeKind::cylinder:
      return "cylinder";
    case ShapeKind::box:
      return "box";
    case ShapeKind::mesh:
      return "mesh";
  }
  return "?";
}

int sizes_of(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::mesh:
      return 0;
    case ShapeKind::sphere:
      return 1;
    case ShapeKind::plane:
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
      return 2;
    case ShapeKind::ellipsoid:
    case ShapeKind::box:
      return 3;
  }
  return 0;
}

}  // namespace mapscore
