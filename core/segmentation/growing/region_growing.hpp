// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"
#include "core/parameters.hpp"
#include "core/segmentation/detection.hpp"
#include "core/segmentation/growing/seed_point.hpp"
#include "core/segmentation/registered_cloud.hpp"
#include "core/segmentation/segment.hpp"

#include <Eigen/Core>
#include <span>
#include <vector>

namespace mapscore {

/// Region growing [M, algorithm 1] from a seed point, over a lattice anchored there. The search
/// radius k_r is `radius_factor` voxel edges: 1 in the paper, 0.5 in the authors' released code,
/// which also compares distances in single precision (`released`).
struct RegionGrowing {
  static constexpr std::string_view kKind = "region_growing";
  static constexpr std::string_view kMeaning =
      "grow voxels from a seed point (algorithm 1 of the paper)";
  double radius_factor = 1;
  bool released = false;
  SeedRule seed = SeedRule::box_centre;
  bool kd_tree = false;

  static void fields(auto& s, auto&& visit) {
    visit(s.radius_factor,
          Field{"radius_factor",
                "search radius over voxel edge: 1 in the paper, 0.5 in its released code",
                above(0, 10)});
    visit(s.released,
          Field{"released", "compare distances in single precision, as the released code does"});
    visit(s.seed, Field{"seed", "pixel whose point the growing starts from"});
    visit(s.kd_tree,
          Field{.key = "kd_tree",
                .meaning = "search by a KD-tree, as the paper does: the same result, more slowly",
                .later = true});
  }
  /// As `segment` of segmentation.hpp, which fills in class, instance, score and box.
  [[nodiscard]] Segment segment(const Detection& detection, const RegisteredCloud& cloud,
                                double voxel_m, bool with_voxels) const;
  bool operator==(const RegionGrowing&) const = default;
};

/// What region growing accepted.
struct Region {
  /// Accepted lattice positions, as multiples of the pitch; ascending.
  std::vector<VoxelKey> positions;
  std::vector<int> points;  ///< indices of the kept points, ascending
};

/// Region growing over a lattice of pitch r anchored at `seed` [M, algorithm 1]: position (i, j, k)
/// lies at seed + r (i, j, k) and is accepted when some point p has |p - position|^2 < k_r^2,
/// strictly, with k_r = factor * r; from the seed's own position on, the 26 neighbours of
/// every accepted position are tried in turn. Kept are the points that pass the same test at some
/// accepted position. Points that are not finite are ignored. In doubles; with `released`, points
/// and positions are rounded to single precision first and the squares summed in it.
///
/// The fast form: points are binned by lattice cell, so that only the few positions around each are
/// ever tested. Same result as grow_region_reference on every input. Throws Error unless pitch and
/// factor are positive and finite. Thread-safe: each thread keeps a workspace of its own.
[[nodiscard]] Region grow_region(std::span<const Eigen::Vector3d> points,
                                 const Eigen::Vector3d& seed, double pitch_m, double factor,
                                 bool released);

/// The plain form: a KD-tree (nanoflann) and a queue. Thread-safe.
[[nodiscard]] Region grow_region_reference(std::span<const Eigen::Vector3d> points,
                                           const Eigen::Vector3d& seed, double pitch_m,
                                           double factor, bool released);

/// Coordinates of a lattice position.
[[nodiscard]] inline Eigen::Vector3d lattice_position(const Eigen::Vector3d& seed, double pitch_m,
                                                      const VoxelKey& key) {
  return {seed.x() + pitch_m * key.i, seed.y() + pitch_m * key.j, seed.z() + pitch_m * key.k};
}

}  // namespace mapscore
