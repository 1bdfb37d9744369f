// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/growing/reached_corners.hpp"

#include "core/wide_vectors.hpp"

#include <cmath>
#include <cstddef>

namespace mapscore {
namespace {

/// Coordinates x y z of points, in a row.
struct Coordinates {
  const double* values;
  std::size_t count;
};

// Without branches, so that the loop becomes wide vectors in the functions that are called.

template <class Scalar>
[[gnu::always_inline]] inline void find_corners(Coordinates points, const LatticeBox& lattice,
                                                Scalar radius_squared, std::uint32_t* cubes,
                                                std::uint8_t* corners) {
  const LatticeBox box = lattice;  // a copy: what is written cannot change it
  const double inverse = 1.0 / box.pitch_m, far = box.reach - 1.0;
  for (std::size_t n = 0; n < points.count; ++n) {
    const double* p = points.values + 3 * n;
    const double u = (p[0] - box.seed[0]) * inverse - box.low[0];
    const double v = (p[1] - box.seed[1]) * inverse - box.low[1];
    const double w = (p[2] - box.seed[2]) * inverse - box.low[2];
    const auto i = static_cast<std::int32_t>(u), j = static_cast<std::int32_t>(v);
    const auto k = static_cast<std::int32_t>(w);
    const auto squared = [&](std::size_t axis, std::int32_t at) {
      const auto position =
          static_cast<Scalar>(box.seed[axis] + box.pitch_m * (box.low[axis] + at));
      const Scalar difference = position - static_cast<Scalar>(p[axis]);
      return difference * difference;
    };
    const Scalar x0 = squared(0, i), x1 = squared(0, i + 1), y0 = squared(1, j);
    const Scalar y1 = squared(1, j + 1), z0 = squared(2, k), z1 = squared(2, k + 1);
    const Scalar xy00 = x0 + y0, xy01 = x0 + y1, xy10 = x1 + y0, xy11 = x1 + y1;
    std::uint32_t reached = xy00 + z0 < radius_squared ? 1U : 0U;
    reached |= xy00 + z1 < radius_squared ? 2U : 0U;
    reached |= xy01 + z0 < radius_squared ? 4U : 0U;
    reached |= xy01 + z1 < radius_squared ? 8U : 0U;
    reached |= xy10 + z0 < radius_squared ? 16U : 0U;
    reached |= xy10 + z1 < radius_squared ? 32U : 0U;
    reached |= xy11 + z0 < radius_squared ? 64U : 0U;
    reached |= xy11 + z1 < radius_squared ? 128U : 0U;
    // How far the point lies from the middle of its cube; beyond 1.5 - reach, the next positions
    // outwards may be within reach.
    const double off_u = std::abs(u - i - 0.5), off_v = std::abs(v - j - 0.5);
    const double off_w = std::abs(w - k - 0.5);
    double off = off_u > off_v ? off_u : off_v;
    off = off > off_w ? off : off_w;
    const std::uint32_t cube = reached == 0 ? kNoCube : box.address(i, j, k);
    cubes[n] = off >= 0.5 - far ? kManyCubes : cube;
    corners[n] = static_cast<std::uint8_t>(reached);
  }
}

template <class Scalar>
[[gnu::always_inline]] inline void find_nearest(Coordinates points, const LatticeBox& lattice,
                                                Scalar radius_squared, std::uint32_t* nearest) {
  const LatticeBox box = lattice;
  const double inverse = 1.0 / box.pitch_m, alone = 1.0 - box.reach;
  for (std::size_t n = 0; n < points.count; ++n) {
    const double* p = points.values + 3 * n;
    const double u = (p[0] - box.seed[0]) * inverse - box.low[0];
    const double v = (p[1] - box.seed[1]) * inverse - box.low[1];
    const double w = (p[2] - box.seed[2]) * inverse - box.low[2];
    const auto i = static_cast<std::int32_t>(u + 0.5), j = static_cast<std::int32_t>(v + 0.5);
    const auto k = static_cast<std::int32_t>(w + 0.5);
    const auto squared = [&](std::size_t axis, std::int32_t at) {
      const auto position =
          static_cast<Scalar>(box.seed[axis] + box.pitch_m * (box.low[axis] + at));
      const Scalar difference = position - static_cast<Scalar>(p[axis]);
      return difference * difference;
    };
    const bool reached = squared(0, i) + squared(1, j) + squared(2, k) < radius_squared;
    const double off_u = std::abs(u - i), off_v = std::abs(v - j), off_w = std::abs(w - k);
    double off = off_u > off_v ? off_u : off_v;
    off = off > off_w ? off : off_w;
    const std::uint32_t position = reached ? box.address(i, j, k) : kNoCube;
    nearest[n] = off >= alone ? kManyCubes : position;
  }
}

MAPSCORE_WIDE_VECTORS
void find_nearest_double(Coordinates p, const LatticeBox& box, double radius_squared,
                         std::uint32_t* nearest) {
  find_nearest(p, box, radius_squared, nearest);
}

MAPSCORE_WIDE_VECTORS
void find_corners_double(Coordinates p, const LatticeBox& box, double radius_squared,
                         std::uint32_t* cubes, std::uint8_t* corners) {
  find_corners(p, box, radius_squared, cubes, corners);
}

MAPSCORE_WIDE_VECTORS
void find_nearest_float(Coordinates p, const LatticeBox& box, float radius_squared,
                        std::uint32_t* nearest) {
  find_nearest(p, box, radius_squared, nearest);
}

MAPSCORE_WIDE_VECTORS
void find_corners_float(Coordinates p, const LatticeBox& box, float radius_squared,
                        std::uint32_t* cubes, std::uint8_t* corners) {
  find_corners(p, box, radius_squared, cubes, corners);
}

}  // namespace

void find_nearest_positions(std::span<const Eigen::Vector3d> points, const LatticeBox& lattice,
                            double radius_squared, std::uint32_t* nearest) {
  find_nearest_double({points.data()->data(), points.size()}, lattice, radius_squared, nearest);
}

void find_reached_corners(std::span<const Eigen::Vector3d> points, const LatticeBox& lattice,
                          double radius_squared, std::uint32_t* cubes, std::uint8_t* corners) {
  find_corners_double({points.data()->data(), points.size()}, lattice, radius_squared, cubes,
                      corners);
}

void find_nearest_positions(std::span<const Eigen::Vector3d> points, const LatticeBox& lattice,
                            float radius_squared, std::uint32_t* nearest) {
  find_nearest_float({points.data()->data(), points.size()}, lattice, radius_squared, nearest);
}

void find_reached_corners(std::span<const Eigen::Vector3d> points, const LatticeBox& lattice,
                          float radius_squared, std::uint32_t* cubes, std::uint8_t* corners) {
  find_corners_float({points.data()->data(), points.size()}, lattice, radius_squared, cubes,
                     corners);
}

}  // namespace mapscore
