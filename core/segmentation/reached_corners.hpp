// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

namespace mapscore {

/// A lattice seed + pitch (i, j, k) and a box of its positions that starts at `low`; positions are
/// given relative to `low`, and are addressed as LatticeBits does.
struct LatticeBox {
  std::array<double, 3> seed, low;
  double pitch_m = 0.0, reach = 0.0;    ///< reach: search radius in pitches, with slack
  std::array<std::uint32_t, 2> stride;  ///< of an address along i and j

  [[nodiscard]] std::uint32_t address(std::int32_t i, std::int32_t j, std::int32_t k) const {
    return static_cast<std::uint32_t>(i + 1) * stride[0] +
           static_cast<std::uint32_t>(j + 1) * stride[1] + static_cast<std::uint32_t>(k + 1);
  }
};

constexpr std::uint32_t kNoCube = 0;            ///< no position is within reach of the point
constexpr std::uint32_t kManyCubes = ~kNoCube;  ///< positions beyond the cube may be

/// For each point a cube of 2 x 2 x 2 positions around it that holds all within its reach, and
/// which of its corners the point reaches, |p - corner|^2 < radius_squared in Scalar (float or
/// double), as the plain form compares them. `cubes`: address of the cube's low corner, or kNoCube,
/// or kManyCubes; `corners`: bit 4 di
/// + 2 dj + dk for the corner (di, dj, dk) above it, 0 for kNoCube. Points lie at least reach + 1
/// within the box; both lists are as long as the points.
void find_reached_corners(std::span<const Eigen::Vector3d> points, const LatticeBox& lattice,
                          double radius_squared, std::uint32_t* cubes, std::uint8_t* corners);
void find_reached_corners(std::span<const Eigen::Vector3d> points, const LatticeBox& lattice,
                          float radius_squared, std::uint32_t* cubes, std::uint8_t* corners);

/// For a reach below kNearestAlone, where few points have more than their nearest position: that
/// one's address, or kNoCube, or kManyCubes.
constexpr double kNearestAlone = 0.75;
void find_nearest_positions(std::span<const Eigen::Vector3d> points, const LatticeBox& lattice,
                            double radius_squared, std::uint32_t* nearest);
void find_nearest_positions(std::span<const Eigen::Vector3d> points, const LatticeBox& lattice,
                            float radius_squared, std::uint32_t* nearest);

}  // namespace mapscore
