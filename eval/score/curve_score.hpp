// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/class_curve.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <cstddef>
#include <vector>

namespace mapscore::eval {

/// Curves by class id, on one lattice. Occupied voxels with a class count, whatever their
/// probability. Time is linear in the rows of map, S and V. Throws Error when the map or V has a
/// class that is not below `class_count`. Thread-safe.
[[nodiscard]] std::vector<ClassCurve> curves_of(const MapSnapshot& map, const SurfaceTruth& surface,
                                                const VisibleTruth& visible,
                                                std::size_t class_count);

}  // namespace mapscore::eval
