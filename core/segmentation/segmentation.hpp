// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/segmentation/detection.hpp"
#include "core/segmentation/registered_cloud.hpp"
#include "core/segmentation/seed_point.hpp"

#include <Eigen/Geometry>
#include <variant>
#include <vector>

namespace mapscore {

/// Every point of the mask.
struct DirectParams {};

/// The mask eroded by the disc dx^2 + dy^2 <= radius^2, then direct.
struct ErosionParams {
  int radius_px = 5;
};

/// Region growing [M, algorithm 1]. Search radius k_r = radius_factor * voxel edge: 1 in the paper,
/// 0.5 in the authors' released code, which also compares distances in single precision
/// (`released`). `kd_tree` searches as the paper does, for the same points and voxels, more slowly.
struct RegionGrowingParams {
  double radius_factor = 1.0;
  bool released = false;
  SeedRule seed = SeedRule::box_centre;
  bool kd_tree = false;
};

/// Outlines of a frame fitted to its depth edges, then votes on the depth surface; of a whole frame
/// (edge_aligned.hpp).
struct EdgeAlignedParams {
  double search_px = 40;  ///< largest displacement of the masks that is looked for
  double reach_px = 3;    ///< how far votes spread over a depth surface
};

using SegmentationParams =
    std::variant<DirectParams, ErosionParams, RegionGrowingParams, EdgeAlignedParams>;

/// Why a detection yielded nothing.
enum class SkipReason { none, no_points, eroded_away, no_seed_point, seed_off_object };

/// 3D segmentation of one detection; frame depth_optical, metres. Nothing but `skipped` when it
/// failed.
struct Segment {
  ClassId class_id = kBackground;
  InstanceId instance = 0;
  double score = 1.0;
  std::vector<Eigen::Vector3d> points;  ///< kept, in row-major order of their colour pixels
  Eigen::AlignedBox3d box;              ///< of the kept points
  /// Centres of the occupied voxels, ascending: of the lattice anchored at the sensor frame's
  /// origin, for region growing of its own lattice anchored at the seed point. Empty unless asked
  /// for.
  std::vector<Eigen::Vector3d> voxel_centres;
  SkipReason skipped = SkipReason::none;
};

/// From a detection and a registered cloud to the points, box and voxels of the object
/// (docs/methods.md). `voxel_m`: voxel edge. `with_voxels`: fill `voxel_centres`. An oriented box:
/// upright_box of the points. Throws Error on a radius or edge that is not positive (an erosion
/// radius of 0 is direct), on a detection that does not fit the cloud's colour image (check), and
/// for what segments a whole frame (frame_segmentation.hpp). Thread-safe.
[[nodiscard]] Segment segment(const Detection& detection, const RegisteredCloud& cloud,
                              double voxel_m, const SegmentationParams& params, bool with_voxels);

}  // namespace mapscore
