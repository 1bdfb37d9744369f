// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/refinement/dense_crf.hpp"

namespace mapscore::testing {

/// The plain twin of refine(): every pair of voxels, in doubles. Kernels end at `cutoff_sigmas`,
/// and a voxel alone within it keeps its column.
[[nodiscard]] Eigen::MatrixXd plain_refine(const CrfVoxels& voxels, const Crf& params,
                                           double cutoff_sigmas);

/// Two walls at a right angle, `side` voxels of 5 cm wide and high, in two colours with noise, and
/// `labels` labels with a share `wrong` of wrong ones.
[[nodiscard]] CrfVoxels noisy_corner(int side, int labels, double wrong);

}  // namespace mapscore::testing
