// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/shape.hpp"
#include "eval/score/counts.hpp"
#include "eval/score/distances/distance_score.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <vector>

namespace mapscore::eval {

/// Thin geoms measure less than this across in two directions: legs, rails, handles.
inline constexpr double kThin_m = 0.06;

/// True when two of the three extents of a geom, in its own frame, are below kThin_m.
[[nodiscard]] bool is_thin(const Shape& shape);

/// As cube_distance, to the thin geoms of a class alone.
[[nodiscard]] CubeDistance distance_to_thin(const std::vector<Shape>& shapes,
                                            const ClassTable& table, const Pose& T_map_world,
                                            double edge_m);

/// Distances from a voxel's cube to the geoms of a class: to all of them, and to the thin ones.
struct ThinDistances {
  const CubeDistance& to_class;
  const CubeDistance& to_thin;
};

/// Fills `thin` of every class of `counts`. A voxel of P_c or V_c belongs to a thin part when no
/// other geom of c is nearer to its cube than a thin one.
void score_thin(const MapSnapshot& map, double threshold, const SurfaceTruth& surface,
                const VisibleTruth& visible, const ThinDistances& distances, Counts& counts);

}  // namespace mapscore::eval
