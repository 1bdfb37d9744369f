// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/refinement/dense_crf.hpp"

#include <functional>

namespace mapscore {

/// Called with q, messages and jobs: messages(l, i) = sum_m w_m sum_{j != i} k_m(i, j) q(l, j);
/// both labels x voxels. Safe to share between threads.
using Messages = std::function<void(const Eigen::MatrixXf&, Eigen::MatrixXf&, int)>;

/// The CRF's messages by a search of each voxel's neighbours, in cells of half the cut-off. Throws
/// Error where the cells would be more than 2^20 on an axis.
[[nodiscard]] Messages neighbour_messages(const CrfVoxels& voxels, const Crf& params, int jobs);

}  // namespace mapscore
