// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <type_traits>

namespace mapscore::sim {

/// The groups of geoms that a ray can hit.
using RayGroups = std::array<mjtByte, mjNGROUP>;

/// Group 0 alone.
inline constexpr RayGroups kFirstGroup = {1, 0, 0, 0, 0, 0};

namespace ray_detail {

// Releases of MuJoCo differ in whether rays return normals; templates, so that only the call that
// fits is compiled.
template <class Ray>
double cast_one(Ray ray, const mjModel& model, const mjData& data, const mjtNum* from,
                const mjtNum* along, const RayGroups& groups, int* geom) {
  if constexpr (std::is_invocable_v<Ray, const mjModel*, const mjData*, const mjtNum*,
                                    const mjtNum*, const mjtByte*, int, int, int*, mjtNum*>) {
    return ray(&model, &data, from, along, groups.data(), 1, -1, geom, nullptr);
  } else {
    return ray(&model, &data, from, along, groups.data(), 1, -1, geom);
  }
}

template <class Rays>
void cast_many(Rays rays, const mjModel& model, mjData& data, const mjtNum* from,
               const mjtNum* along, const RayGroups& groups, int* geoms, mjtNum* ranges_m,
               int count, double range_max_m) {
  if constexpr (std::is_invocable_v<Rays, const mjModel*, mjData*, const mjtNum*, const mjtNum*,
                                    const mjtByte*, int, int, int*, mjtNum*, mjtNum*, int,
                                    mjtNum>) {
    rays(&model, &data, from, along, groups.data(), 1, -1, geoms, ranges_m, nullptr, count,
         range_max_m);
  } else {
    rays(&model, &data, from, along, groups.data(), 1, -1, geoms, ranges_m, count, range_max_m);
  }
}

}  // namespace ray_detail

/// Distance along a ray to the first geom of `groups`, in lengths of `along`; -1 where there is
/// none. Geoms with alpha 0 are passed through. Kinematics of `data` are done.
[[nodiscard]] inline double cast_ray(const mjModel& model, const mjData& data, const mjtNum from[3],
                                     const mjtNum along[3], const RayGroups& groups) {
  int geom = -1;
  return ray_detail::cast_one(&mj_ray, model, data, from, along, groups, &geom);
}

/// The same for `count` rays from one point, within `range_max_m`. `along`: count x 3, unit
/// vectors; `geoms` and `ranges_m`: count.
inline void cast_rays(const mjModel& model, mjData& data, const mjtNum from[3], const mjtNum* along,
                      const RayGroups& groups, int* geoms, mjtNum* ranges_m, int count,
                      double range_max_m) {
  ray_detail::cast_many(&mj_multiRay, model, data, from, along, groups, geoms, ranges_m, count,
                        range_max_m);
}

}  // namespace mapscore::sim
