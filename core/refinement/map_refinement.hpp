// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/mapping/semantic_map.hpp"
#include "core/refinement/belief_refinement.hpp"

namespace mapscore {

/// Refines the beliefs of all voxels of a map that have any (refine_beliefs); occupancy and colours
/// stay. Voxels without a colour take the mean of those that have one. Throws Error, the map
/// unchanged, on parameters out of range. Same result for any number of threads.
void refine(SemanticMap& map, const Crf& crf, int jobs = 1);

}  // namespace mapscore
