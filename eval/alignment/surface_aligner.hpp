// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "eval/alignment/point_to_plane.hpp"
#include "eval/alignment/shift_search.hpp"

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mapscore::eval {

/// A placement of a map and the share of it that then lies at surfaces, floors
/// counting no more than other faces.
struct Placement {
  Pose motion = Pose::Identity();
  double share = 0.0;
};

/// What a search for the placement of a map found.
struct Alignment {
  Placement before, best,
      next;             ///< `next`: the best that clearly differs from `best`
  std::string refusal;  ///< why `best` is not to be trusted; empty where it is
};

/// Finds the rigid motion that brings a map's points onto surfaces, from
/// geometry alone: any shift, any yaw, tilts of up to some 15 degrees. The same
/// result for any number of jobs. Immutable, safe to share between threads.
class SurfaceAligner {
 public:
  /// `pieces`: the surfaces, frame map. `seen`: points that cameras measured there; surfaces far
  /// from all of them, as the underside of a floor, are left out. Without any, all count.
  SurfaceAligner(std::span<const PreparedShape> pieces, int jobs,
                 std::span<const Eigen::Vector3d> seen = {});

  /// `points`: frame map, where they are believed to lie.
  [[nodiscard]] Alignment align(std::span<const Eigen::Vector3d> points) const;

 private:
  SurfaceIndex surface_;
  int jobs_;
};

}  // namespace mapscore::eval
