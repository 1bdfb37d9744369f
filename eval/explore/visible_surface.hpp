// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/frame.hpp"
#include "core/mapping/semantic_map.hpp"
#include "eval/explore/exploration_curve.hpp"
#include "eval/explore/visible_cloud.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace mapscore::eval {

/// The visible surface of a scene on the lattice of a map: the surface voxels (S of any class,
/// background included) in which the cloud of a dense set of views has a point. Its voxels of the
/// detected classes are visible truth V as docs/metrics.md has it, the cloud's points in place of
/// depth samples. Immutable, safe to share between threads.
class VisibleSurface {
 public:
  /// `table` has the detected classes.
  VisibleSurface(const std::vector<SurfacePoint>& cloud, SurfaceTruth surface,
                 const ClassTable& table, const Pose& T_map_world);

  [[nodiscard]] double edge_m() const { return surface_.edge_m(); }
  [[nodiscard]] std::size_t size() const { return class_of_.size(); }
  /// Voxels whose owner is detected.
  [[nodiscard]] std::size_t detected() const { return visible_.voxels().size(); }
  /// Position of a packed voxel among the visible ones; size() where it is none of them.
  [[nodiscard]] std::size_t find(std::uint64_t packed) const;
  [[nodiscard]] bool is_detected(std::size_t position) const { return class_of_[position] != 0; }

  /// Precision, recall and F1 of a map's detected classes together, against all of this surface,
  /// and the volume that it knows.
  [[nodiscard]] MapState state_of(const SemanticMap& map, double threshold) const;

 private:
  SurfaceTruth surface_;
  ClassTable table_;
  VisibleTruth visible_;  ///< of the detected classes
  std::unordered_map<std::uint64_t, std::uint32_t> positions_;
  std::vector<ClassId> class_of_;  ///< by position; background for classes that are not detected
};

/// Which voxels of a visible surface a robot has seen so far. Used by one thread at a time.
class SeenSurface {
 public:
  /// `surface` must outlive it.
  SeenSurface(const VisibleSurface& surface, const Calibration& truth, const Pose& T_map_world);

  /// Marks the voxels with a depth sample of the frame, noise-free and at its true pose.
  void add(const Frame& frame);

  /// Seen share of the surface; 1 where there is none.
  [[nodiscard]] double coverage() const { return share(seen_, surface_.size()); }
  [[nodiscard]] double coverage_detected() const {
    return share(seen_detected_, surface_.detected());
  }

 private:
  [[nodiscard]] static double share(std::size_t seen, std::size_t all) {
    return all == 0 ? 1.0 : static_cast<double>(seen) / static_cast<double>(all);
  }

  const VisibleSurface& surface_;
  Calibration truth_;
  Pose T_map_world_;
  std::vector<bool> is_seen_;
  std::size_t seen_ = 0, seen_detected_ = 0;
};

}  // namespace mapscore::eval
