// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/pose.hpp"
#include "core/geometry/shape.hpp"
#include "eval/truth/shapes/shape_tests.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/voxelise.hpp"

#include <vector>

namespace mapscore::eval {

/// Surface truth of a scene of which some shapes move: the fixed ones are voxelised once. Whether a
/// voxel stays for a piece depends on the piece and on the solids that meet its widened cube, so
/// that fixed rows change only where a moving solid is near, before or after: there they are made
/// anew against all solids. Immutable, safe to share between threads.
class MovingSurface {
 public:
  /// Throws as surface_truth does.
  MovingSurface(const std::vector<Shape>& fixed, const ClassTable& table, const Pose& T_map_world,
                const SurfaceOptions& options);

  /// Row by row what surface_truth gives for the fixed shapes together with these. Works on one
  /// thread.
  [[nodiscard]] SurfaceTruth at(const std::vector<Shape>& moving) const;

  /// Pieces of the fixed shapes in the map frame.
  [[nodiscard]] const std::vector<PreparedShape>& fixed_pieces() const { return pieces_; }

 private:
  /// Where fixed rows are made anew.
  struct Zone {
    std::vector<VoxelBlock> blocks;
    VoxelBlock around;  ///< all of them
  };

  [[nodiscard]] Zone zone_of(const std::vector<PreparedShape>& moving) const;
  [[nodiscard]] std::vector<SurfaceVoxel> made_anew(const std::vector<PreparedShape>& moving,
                                                    const Zone& zone) const;

  ClassTable table_;
  Pose T_map_world_;
  SurfaceOptions options_;
  int fixed_shapes_;
  std::vector<PreparedShape> pieces_;
  SurfaceTruth surface_;  ///< of the fixed shapes alone
};

}  // namespace mapscore::eval
