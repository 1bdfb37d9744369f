// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/refinement/dense_crf.hpp"

#include <cstdint>
#include <vector>

namespace mapscore {

/// exp(-x / 2) for x in [0, limit], 0 above; from a table, within 2e-6 of the truth.
class TruncatedGaussian {
 public:
  explicit TruncatedGaussian(float limit);
  [[nodiscard]] float operator()(float squared) const {
    if (squared > limit_) return 0.0f;
    const float place = squared * steps_per_unit_;
    const auto step = static_cast<std::size_t>(place);
    const float rest = place - static_cast<float>(step);
    return table_[step] + rest * (table_[step + 1] - table_[step]);
  }

 private:
  float limit_, steps_per_unit_;
  std::vector<float> table_;
};

/// The CRF's messages by a search of each voxel's neighbours, in cells of half the cut-off. Holds
/// positions, not pairs: memory grows with the voxels alone. Safe to share between threads.
class NeighbourMessages {
 public:
  /// Throws Error where the cells would be more than 2^20 on an axis.
  NeighbourMessages(const CrfVoxels& voxels, const Crf& params, int jobs);

  /// messages(l, i) = sum_m w_m sum_{j != i} k_m(i, j) q(l, j); both labels x voxels.
  void send(const Eigen::MatrixXf& q, Eigen::MatrixXf& messages, int jobs) const;

 private:
  /// A voxel, by cell and then by index. Positions in metres from the map's first corner.
  struct Site {
    float x, y, z, r, g, b;
    float smoothness_scale = 1.0f, appearance_scale = 1.0f;  ///< 1 / sqrt(n), or 1
  };
  struct Cell {
    std::uint64_t key;
    std::uint32_t first, last;  ///< of the sites, without `last`
  };
  /// Sites that may lie within the cut-off of a cell's: whole cells, in order.
  struct Span {
    std::uint32_t first, last;
  };
  struct Kernels {
    float smoothness, appearance;
  };

  void sort_into_cells(const CrfVoxels& voxels);
  void normalise(int jobs);
  [[nodiscard]] std::vector<Span> spans_about(const Cell& cell) const;
  /// Both kernels, without weights and norms.
  [[nodiscard]] Kernels kernels(const Site& a, const Site& b, float squared_m2) const;
  /// Calls `use(i, j, kernels)` for each i of the cell and each j != i within the cut-off, j
  /// ascending for each i.
  template <class Use>
  void for_each_pair(const Cell& cell, const Use& use) const;

  float smoothness_weight_, appearance_weight_;
  float per_smoothness_m2_, per_appearance_m2_, per_colour2_;  ///< 1 / sigma^2
  float reach_m_;
  double cell_m_;
  TruncatedGaussian gaussian_;
  std::vector<Site> sites_;
  std::vector<std::uint32_t> voxel_of_;  ///< by site
  std::vector<Cell> cells_;              ///< ascending by key
};

}  // namespace mapscore
