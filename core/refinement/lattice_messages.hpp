// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/refinement/dense_crf.hpp"
#include "core/refinement/permutohedral_lattice.hpp"

#include <optional>

namespace mapscore {

/// The CRF's messages by permutohedral lattices, one a kernel. Safe to share between threads.
class LatticeMessages {
 public:
  LatticeMessages(const CrfVoxels& voxels, const Crf& params, int jobs);

  /// As NeighbourMessages::send, without a cut-off and approximately.
  void send(const Eigen::MatrixXf& q, Eigen::MatrixXf& messages, int jobs) const;

 private:
  /// One kernel with its weight: sqrt(w / n_i), and what of a filtered value is the voxel's own.
  template <int D>
  struct Kernel {
    PermutohedralLattice<D> lattice;
    Eigen::VectorXf scale, own;
  };
  template <int D>
  static Kernel<D> kernel(const std::vector<std::array<float, D>>& features, double weight,
                          bool normalised, int jobs);
  template <int D>
  static void add(const std::optional<Kernel<D>>& kernel, const Eigen::MatrixXf& q,
                  Eigen::MatrixXf& messages, int jobs);

  std::optional<Kernel<3>> smoothness_;
  std::optional<Kernel<6>> appearance_;
};

}  // namespace mapscore
