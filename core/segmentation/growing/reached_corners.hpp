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

/// Finds, for each point, the cube of 2 x 2 x 2 positions around it, and the corners of the cube
/// that it reaches: |p - corner|^2 < radius_squared, compared in the type of radius_squared as in
/// grow_region_reference. `cubes`: address of the cube's low corner, kNoCube if it reaches none,
/// kManyCubes if it may reach positions beyond the cube. `corners`: bit 4 di + 2 dj + dk is corner
/// (di, dj, dk). Both lists are as long as the points, which lie at least reach + 1 inside the box.
void find_reached_corners(std::span<const Eigen::Vector3d> points, const LatticeBox& lattice,
                          double radius_squared, std::uint32_t* cubes, std::uint8_t* corners);
void find_reached_corners(std::span<const Eigen::Vector3d> points, const LatticeBox& lattice,
                          float radius_squared, std::uint32_t* cubes, std::uint8_t* corners);

/// Below this reach (in pitches) few points reach more than their nearest position.
constexpr double kNearestAlone = 0.75;
/// Finds, for a reach below kNearestAlone, each point's nearest position if the point reaches it:
/// its address, else kNoCube, or kManyCubes if the point may reach others too.
void find_nearest_positions(std::span<const Eigen::Vector3d> points, const LatticeBox& lattice,
                            double radius_squared, std::uint32_t* nearest);
void find_nearest_positions(std::span<const Eigen::Vector3d> points, const LatticeBox& lattice,
                            float radius_squared, std::uint32_t* nearest);

}  // namespace mapscore
