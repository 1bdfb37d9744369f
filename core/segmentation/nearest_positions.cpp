// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/nearest_positions.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore {
namespace {

/// Coordinates x y z of points, in a row.
struct Coordinates {
  const double* values;
  std::size_t count;
};

// Without branches, so that the loops become wide vectors; each function that is called from
// outside is compiled for several widths, of which the processor's is chosen when the program
// starts. No result depends on the width: there are neither sums over points nor fused products.

template <class Scalar>
[[gnu::always_inline]] inline void find_nearest(Coordinates p, const LatticeBox& lattice,
                                                Scalar radius_squared, std::uint32_t* nearest,
                                                std::uint32_t* more) {
  const LatticeBox box = lattice;  // a copy: what is written cannot change it
  const double inverse = 1.0 / box.pitch_m, alone = 1.0 - box.reach;
  for (std::size_t n = 0; n < p.count; ++n) {
    const double x = p.values[3 * n], y = p.values[3 * n + 1], z = p.values[3 * n + 2];
    const double u = (x - box.seed[0]) * inverse - box.low[0];
    const double v = (y - box.seed[1]) * inverse - box.low[1];
    const double w = (z - box.seed[2]) * inverse - box.low[2];
    const auto i = static_cast<std::int32_t>(u + 0.5), j = static_cast<std::int32_t>(v + 0.5);
    const auto k = static_cast<std::int32_t>(w + 0.5);
    const auto position = [&](std::size_t axis, std::int32_t at) {
      return static_cast<Scalar>(box.seed[axis] + box.pitch_m * (box.low[axis] + at));
    };
    const Scalar dx = position(0, i) - static_cast<Scalar>(x);
    const Scalar dy = position(1, j) - static_cast<Scalar>(y);
    const Scalar dz = position(2, k) - static_cast<Scalar>(z);
    const std::uint32_t address = box.address(i, j, k);
    nearest[n] = dx * dx + dy * dy + dz * dz < radius_squared ? address : ~std::uint32_t{0};
    const double off_u = std::abs(u - i), off_v = std::abs(v - j), off_w = std::abs(w - k);
    double off = off_u > off_v ? off_u : off_v;
    off = off > off_w ? off : off_w;
    more[n] = off >= alone ? 1U : 0U;
  }
}

[[gnu::always_inline]] inline void find_cubes_of(Coordinates p, const LatticeBox& lattice,
                                                 std::uint32_t* cube) {
  const LatticeBox box = lattice;
  const double inverse = 1.0 / box.pitch_m, reach = box.reach;
  for (std::size_t n = 0; n < p.count; ++n) {
    const double u = (p.values[3 * n] - box.seed[0]) * inverse - box.low[0];
    const double v = (p.values[3 * n + 1] - box.seed[1]) * inverse - box.low[1];
    const double w = (p.values[3 * n + 2] - box.seed[2]) * inverse - box.low[2];
    // Those within reach lie from just above u - reach to u + reach; truncation rounds down here.
    const auto i = static_cast<std::int32_t>(u - reach), j = static_cast<std::int32_t>(v - reach);
    const auto k = static_cast<std::int32_t>(w - reach);
    const std::int32_t other = ((static_cast<std::int32_t>(u + reach) - i) ^ 2) |
                               ((static_cast<std::int32_t>(v + reach) - j) ^ 2) |
                               ((static_cast<std::int32_t>(w + reach) - k) ^ 2);
    const std::uint32_t corner = box.address(i + 1, j + 1, k + 1);
    cube[n] = other == 0 ? corner : ~std::uint32_t{0};
  }
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("default", "avx2", "avx512f")]]
#endif
void find_nearest_double(Coordinates p, const LatticeBox& box, double radius_squared,
                         std::uint32_t* nearest, std::uint32_t* more) {
  find_nearest(p, box, radius_squared, nearest, more);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("default", "avx2", "avx512f")]]
#endif
void find_nearest_float(Coordinates p, const LatticeBox& box, float radius_squared,
                        std::uint32_t* nearest, std::uint32_t* more) {
  find_nearest(p, box, radius_squared, nearest, more);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("default", "avx2", "avx512f")]]
#endif
void find_cubes(Coordinates p, const LatticeBox& box, std::uint32_t* cube) {
  find_cubes_of(p, box, cube);
}

}  // namespace

template <class Scalar>
void NearestPositions<Scalar>::locate(std::span<const Eigen::Vector3d> points,
                                      const LatticeBox& lattice, Scalar radius_squared) {
  const Coordinates p{points.data()->data(), points.size()};
  if constexpr (sizeof(Scalar) == sizeof(double))
    find_nearest_double(p, lattice, radius_squared, nearest_.data(), more_.data());
  else
    find_nearest_float(p, lattice, radius_squared, nearest_.data(), more_.data());
  // Where half a pitch is out of reach, few points have more than one position: no cubes.
  if (lattice.reach < 0.75)
    std::fill_n(cube_.begin(), points.size(), kNone);
  else
    find_cubes(p, lattice, cube_.data());
}

template class NearestPositions<float>;
template class NearestPositions<double>;

}  // namespace mapscore
