// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace mapscore {

/// Gaussian filter of values at D-dimensional features, sigma 1 in each: the permutohedral lattice
/// of [Adams et al. 2010]. Values are spread onto the corners of each feature's simplex, blurred
/// along the D + 1 lattice directions and gathered again. Approximate: the kernel depends on where
/// in its simplex a feature lies. Safe to share between threads.
template <int D>
class PermutohedralLattice {
 public:
  using Feature = std::array<float, D>;

  explicit PermutohedralLattice(const std::vector<Feature>& features);

  /// out(:, i) = sum_j k(i, j) values(:, j), j = i included; both labels x features. The result
  /// does not depend on `jobs`.
  [[nodiscard]] Eigen::MatrixXf filtered(const Eigen::MatrixXf& values, int jobs) const;
  /// k(i, i), as filtered() has it where all the lattice's vertices in between are there.
  [[nodiscard]] float own_kernel(std::size_t feature) const;
  [[nodiscard]] std::size_t vertices() const { return vertices_; }

 private:
  static constexpr int kCorners = D + 1;
  /// The first D coordinates of a vertex; the last makes their sum 0.
  using Vertex = std::array<std::int32_t, D>;
  struct Corner {
    std::uint32_t vertex;
    float share;  ///< barycentric
  };
  struct Simplex {
    std::array<Vertex, kCorners> corners;  ///< by remainder
    std::array<float, kCorners> shares;
  };
  struct Sides {
    std::uint32_t before, after;  ///< along one direction; kNone where there is none
  };
  static constexpr std::uint32_t kNone = 0xffffffffu;

  [[nodiscard]] static Simplex simplex_about(const Feature& feature);
  void index_spread();
  [[nodiscard]] Eigen::MatrixXf spread(const Eigen::MatrixXf& values, int jobs) const;

  std::size_t vertices_ = 0;
  std::vector<std::array<Corner, kCorners>> corners_;  ///< by feature
  std::array<std::vector<Sides>, kCorners> sides_;     ///< by direction and vertex
  std::vector<std::uint32_t> first_of_;                ///< into spread_, by vertex
  std::vector<Corner> spread_;                         ///< of a vertex: its features and shares
};

extern template class PermutohedralLattice<3>;
extern template class PermutohedralLattice<6>;

}  // namespace mapscore
