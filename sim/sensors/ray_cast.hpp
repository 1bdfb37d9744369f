// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <mujoco/mujoco.h>

#include <array>

namespace mapscore::sim {

// Rays hit geoms of group 0 alone. Releases of MuJoCo differ in whether rays return normals;
// generic lambdas, so that only the call that fits is compiled.

inline constexpr std::array<mjtByte, mjNGROUP> kFirstGroup = {1, 0, 0, 0, 0, 0};

/// Distance along a ray to the first geom, in lengths of `along`; -1 where there is none. Geoms
/// with alpha 0 are passed through. Kinematics of `data` are done.
[[nodiscard]] inline double cast_ray(const mjModel& model, const mjData& data, const mjtNum from[3],
                                     const mjtNum along[3]) {
  const auto cast = [&](auto ray, int geom) {
    if constexpr (requires { ray(&model, &data, from, along, kFirstGroup.data(), 1, -1, &geom); })
      return ray(&model, &data, from, along, kFirstGroup.data(), 1, -1, &geom);
    else
      return ray(&model, &data, from, along, kFirstGroup.data(), 1, -1, &geom, nullptr);
  };
  return cast(&mj_ray, -1);
}

/// The same for `count` rays from one point, within `range_max_m`. `along`: count x 3, unit
/// vectors; `geoms` and `ranges_m`: count.
inline void cast_rays(const mjModel& model, mjData& data, const mjtNum from[3], const mjtNum* along,
                      int* geoms, mjtNum* ranges_m, int count, double range_max_m) {
  const auto cast = [&](auto rays, auto... last) {
    const auto* groups = kFirstGroup.data();
    if constexpr (requires {
                    rays(&model, &data, from, along, groups, 1, -1, geoms, ranges_m, last...);
                  })
      rays(&model, &data, from, along, groups, 1, -1, geoms, ranges_m, last...);
    else
      rays(&model, &data, from, along, groups, 1, -1, geoms, ranges_m, nullptr, last...);
  };
  cast(&mj_multiRay, count, range_max_m);
}

}  // namespace mapscore::sim
