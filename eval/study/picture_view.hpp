// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/render/renderer.hpp"

#include <span>

namespace mapscore::eval {

/// Where pictures are drawn from: `ex ey ez tx ty tz [vfov_deg]`, eye and target in the world in
/// metres, and the vertical field of view, 45 degrees if left out. The world's z is up in the
/// picture; its y, where the view is straight up or down. Throws Error (without saying where the
/// numbers stand) when there are not 6 or 7, one is not finite or beyond 1e6 m, eye and target are
/// less than 1 mm apart, or the angle is not from 1 to 170 degrees.
[[nodiscard]] sim::View view_of_numbers(std::span<const double> numbers);

}  // namespace mapscore::eval
