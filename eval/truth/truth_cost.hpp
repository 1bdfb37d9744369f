// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/geometry/shape.hpp"
#include "eval/truth/surface_truth.hpp"

#include <vector>

namespace mapscore::eval {

/// What a surface truth will take, known before it is made.
struct TruthCost {
  double voxels = 0;      ///< rows: pairs of voxel and class
  double bytes = 0;       ///< of the rows; what it takes besides is small
  double whole_view = 0;  ///< bytes of a view of all of it (see whole_surface)
  double seconds = 0;     ///< on one thread
};

/// Estimate from the shapes' sizes alone. A convex piece meets as many cubes of edge w, on a
/// lattice of edge h, as the volume that it sweeps out with the cube holds cells, which is (V + w
/// (P_x + P_y + P_z) + w^2 (L_x + L_y + L_z) + w^3) / h^3 on the mean of all positions, with its
/// volume V, its shadows P and its extents L along the lattice's axes; those inside a solid are
/// taken off. A mesh counts by its shadows alone. What pieces share, or bury of each other, counts
/// for each. Of apartment, home and cottage at 5 cm to 5 mm: within 8 % of the voxels. Throws Error
/// as prepare.
[[nodiscard]] TruthCost truth_cost(const std::vector<Shape>& shapes, const Pose& T_map_world,
                                   const SurfaceOptions& options);

/// Throws Error that says the cost and the flag --yes when the truth takes more than 4 GB, or 256
/// MB and half of `available_bytes`.
void refuse_too_large(const TruthCost& cost, double edge_m, double available_bytes);

}  // namespace mapscore::eval
