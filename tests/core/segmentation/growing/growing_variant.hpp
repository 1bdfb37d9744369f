// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <ostream>

namespace mapscore::testing {

/// How a region is grown: the factor on the radius, and whether as the method was released.
struct GrowingVariant {
  double factor;
  bool released;
};
inline void PrintTo(const GrowingVariant& variant, std::ostream* out) {
  *out << "factor " << variant.factor << (variant.released ? ", as released" : "");
}

}  // namespace mapscore::testing
