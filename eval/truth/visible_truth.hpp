// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/voxel.hpp"
#include "eval/truth/sample_counter.hpp"
#include "eval/truth/surface_truth.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mapscore::eval {

struct VisibleVoxel {
  VoxelKey key;
  ClassId owner = kBackground;
  std::uint32_t samples = 0;  ///< of all classes
  bool operator==(const VisibleVoxel&) const = default;
};

/// V_c(r) of every class but background. Immutable, safe to share between threads.
class VisibleTruth {
 public:
  VisibleTruth() = default;
  /// `voxels` in any order, each key once, none owned by background.
  VisibleTruth(std::vector<VisibleVoxel> voxels, double edge_m);

  [[nodiscard]] double edge_m() const { return edge_m_; }
  /// All voxels, sorted by owner, then key.
  [[nodiscard]] std::span<const VisibleVoxel> voxels() const { return voxels_; }
  /// V_c, sorted by key.
  [[nodiscard]] std::span<const VisibleVoxel> of(ClassId class_id) const;
  /// |V_c|.
  [[nodiscard]] std::size_t count(ClassId class_id) const { return of(class_id).size(); }
  /// The class whose V holds the voxel, if any; expected constant time.
  [[nodiscard]] std::optional<ClassId> owner_of(const VoxelKey& key) const;
  /// Samples of all classes in the voxel when it lies in V_c, else 0; expected constant time.
  [[nodiscard]] std::uint32_t samples(const VoxelKey& key, ClassId class_id) const;

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t row = kNone;
  };
  /// Where a packed key stands, or belongs.
  [[nodiscard]] std::size_t position(std::uint64_t key) const;
  /// The row of a voxel, or nullptr.
  [[nodiscard]] const VisibleVoxel* find(const VoxelKey& key) const;

  std::vector<VisibleVoxel> voxels_;
  /// Rows by packed key: open addressing, linear probing, at most half full.
  std::vector<Slot> slots_ = std::vector<Slot>(2);
  double edge_m_ = 0;
};

/// Voxels with at least `min_samples` samples of any class, background included. The owner is the
/// class with most samples in the voxel, ties to the lower id. A voxel owned by background, or by a
/// class whose surface truth does not hold it, belongs to none and is left out. Throws Error when
/// the edges differ or min_samples is below 1.
[[nodiscard]] VisibleTruth visible_truth(const SampleCounter& samples, const SurfaceTruth& surface,
                                         int min_samples = 1);

/// Visible truth without a camera, as of a scene: every voxel of the surface, with 0 samples. The
/// owner is the lowest class, background apart, whose surface the open cube meets (not
/// `touch_only`), or else the lowest that touches it. Voxels of background alone belong to none.
[[nodiscard]] VisibleTruth whole_surface(const SurfaceTruth& surface);

/// Throws Error when the voxels of the two have different edges.
void check_same_lattice(const SurfaceTruth& surface, const VisibleTruth& visible);

}  // namespace mapscore::eval
