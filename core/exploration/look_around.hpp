// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/surroundings.hpp"

#include <numbers>

namespace mapscore {

/// A whole turn on the spot: how planners begin that choose places by what is known of the floor.
[[nodiscard]] inline NextView look_around(const Surroundings& now) {
  const PlanarPose& here = now.floor.T_map_base();
  NextView view;
  for (int third = 0; third <= 3; ++third)
    view.way.push_back(
        {here.x_m, here.y_m, wrapped_angle(here.yaw_rad + third * 2.0 / 3.0 * std::numbers::pi)});
  return view;
}

}  // namespace mapscore
