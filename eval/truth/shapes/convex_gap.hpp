// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/truth/shapes/convex_forms.hpp"

namespace mapscore::eval {

/// Distance in metres between a closed form and a closed box that have no point in common; 0 or
/// rounding noise when they have. Closed formulas for boxes, triangles, balls and capsules.
/// Ellipsoids and cylinders: the method of Gilbert, Johnson and Keerthi, stopped when its upper and
/// lower bound differ by at most 1e-10 m.
[[nodiscard]] double gap(const OrientedBox& form, const Box& box);
[[nodiscard]] double gap(const Triangle& form, const Box& box);
[[nodiscard]] double gap(const Ball& form, const Box& box);
[[nodiscard]] double gap(const Capsule& form, const Box& box);
[[nodiscard]] double gap(const Ellipsoid& form, const Box& box);
[[nodiscard]] double gap(const Cylinder& form, const Box& box);

}  // namespace mapscore::eval
