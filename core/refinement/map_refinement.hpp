// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/mapping/semantic_map.hpp"
#include "core/refinement/dense_crf.hpp"

#include <span>
#include <vector>

namespace mapscore {

/// Refines the beliefs of a map's voxels by the dense CRF (docs/refinement.md); same order. The
/// CRF's labels are the classes that some voxel names, background only if named. Voxels that name
/// no class: under CrfRest::apart they take no part and do not change; under CrfRest::label the
/// label `unknown` starts with probability 1. Voxels that are alone (CrfResult) do not change. In
/// the others counts become probabilities and classes below 1e-6 are dropped. `colours` may be
/// empty if the appearance kernel is off. Throws Error as refine().
[[nodiscard]] std::vector<ClassBeliefs> refine_beliefs(std::span<const VoxelKey> keys,
                                                       double voxel_m,
                                                       std::span<const Colour> colours,
                                                       std::span<const ClassBeliefs> beliefs,
                                                       const Crf& crf, int jobs = 1);

/// Refines the beliefs of all voxels of a map that have any (refine_beliefs); occupancy and colours
/// stay. Voxels without a colour take the mean of those that have one. Throws Error, the map
/// unchanged, on parameters out of range. Same result for any number of threads.
void refine(SemanticMap& map, const Crf& crf, int jobs = 1);

}  // namespace mapscore
