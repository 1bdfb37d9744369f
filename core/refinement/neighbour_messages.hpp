// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/refinement/dense_crf.hpp"

#include <functional>
#include <vector>

namespace mapscore {

/// Called with q, messages and jobs: messages(l, i) = sum_m w_m sum_{j != i} k_m(i, j) q(l, j);
/// both labels x voxels. Safe to share between threads.
using Messages = std::function<void(const Eigen::MatrixXf&, Eigen::MatrixXf&, int)>;

struct NeighbourMessages {
  Messages send;
  std::vector<bool> alone;  ///< by voxel: no other within the cut-off of any kernel
};

/// The CRF's messages by a search of each voxel's neighbours. Reads keys, which lie within 0 ..
/// 2^20 - 1, voxel_m and colours. No voxel's sums depend on any but its neighbours, nor on the
/// order of voxels whose keys differ.
[[nodiscard]] NeighbourMessages neighbour_messages(const CrfVoxels& voxels, const Crf& params,
                                                   int jobs);

}  // namespace mapscore
