// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/pose.hpp"
#include "core/geometry/shape.hpp"
#include "core/geometry/voxel.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mapscore::eval {

struct SurfaceOptions {
  double edge_m = 0.05;       ///< edge of a voxel
  double epsilon_m = 0.0005;  ///< how far a cube is widened on each side; the depth's resolution
  int jobs = 1;               ///< threads; the result does not depend on them
};

/// Voxel and class of a surface that it touches. `touch_only`: the open, unwidened cube misses
/// every surface of the class that put the voxel here.
struct SurfaceVoxel {
  VoxelKey key;
  ClassId class_id = kBackground;
  bool touch_only = false;
  bool operator==(const SurfaceVoxel&) const = default;
};

/// S_c(r) of every class c, background included. Immutable, safe to share between threads; copies
/// share the rows.
class SurfaceTruth {
 public:
  SurfaceTruth() = default;
  /// `voxels` sorted by key, then class, each pair once.
  SurfaceTruth(std::vector<SurfaceVoxel> voxels, double edge_m);

  [[nodiscard]] double edge_m() const { return edge_m_; }
  /// True when the voxel lies in S_c; time grows with the logarithm of a layer's rows.
  [[nodiscard]] bool contains(const VoxelKey& key, ClassId class_id) const;
  /// True when any class touches the voxel, background included.
  [[nodiscard]] bool touches_any(const VoxelKey& key) const { return !classes_at(key).empty(); }
  /// Rows of one voxel, by class; empty when no surface touches it.
  [[nodiscard]] std::span<const SurfaceVoxel> classes_at(const VoxelKey& key) const;
  /// All rows, sorted by key, then class.
  [[nodiscard]] std::span<const SurfaceVoxel> voxels() const {
    return rows_ ? std::span<const SurfaceVoxel>(*rows_) : std::span<const SurfaceVoxel>();
  }
  /// |S_c|.
  [[nodiscard]] std::size_t count(ClassId class_id) const {
    return class_id < counts_.size() ? counts_[class_id] : 0;
  }

 private:
  std::shared_ptr<const std::vector<SurfaceVoxel>> rows_;
  std::int32_t least_i_ = 0;
  std::vector<std::size_t> layers_;  ///< first row with i >= least_i_ + n; the last is their count
  std::vector<std::size_t> counts_;
  double edge_m_ = 0;
};

/// Exact surface truth of `shapes` on the map's lattice: every voxel whose closed cube, widened by
/// epsilon, meets the boundary of a shape of the class, unless that part of the boundary is buried
/// inside another solid (see voxelise.hpp). Throws Error when an option or a shape is not usable,
/// or the scene reaches beyond 2^20 voxels from the origin of the map.
[[nodiscard]] SurfaceTruth surface_truth(const std::vector<Shape>& shapes, const ClassTable& table,
                                         const Pose& T_map_world, const SurfaceOptions& options);

}  // namespace mapscore::eval
