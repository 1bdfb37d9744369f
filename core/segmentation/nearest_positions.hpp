// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
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

/// Where a few points lie on a lattice, worked out for all of them at once. Distances are compared
/// in Scalar (float or double), as the plain form compares them.
template <class Scalar>
class NearestPositions {
 public:
  static constexpr std::size_t kMost = 512;
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// At most kMost points, which lie at least `reach` + 1 within the box.
  void locate(std::span<const Eigen::Vector3d> points, const LatticeBox& lattice,
              Scalar radius_squared);

  /// Address of the position nearest to point n, kNone when even that is out of reach.
  [[nodiscard]] std::uint32_t nearest(std::size_t n) const { return nearest_[n]; }
  /// Whether other positions may be within reach of point n.
  [[nodiscard]] bool has_more(std::size_t n) const { return more_[n] != 0; }
  /// Where those within reach lie in a cube of 2 x 2 x 2 positions: the address of its low corner,
  /// else kNone.
  [[nodiscard]] std::uint32_t cube(std::size_t n) const { return cube_[n]; }

 private:
  std::array<std::uint32_t, kMost> nearest_, more_, cube_;
};

}  // namespace mapscore
