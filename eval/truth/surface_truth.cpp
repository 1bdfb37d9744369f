// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/surface_truth.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "eval/truth/shapes/shape_tests.hpp"
#include "eval/truth/voxelise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>  // says whether this is glibc
#include <string>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace mapscore::eval {
namespace {

// A row of a slab in 62 bits, in the order of the result: i within the slab (3), j and k (21 each),
// class (16), touch_only (1), so that of equal pairs the one that truly meets comes first.
using SlabRow = std::uint64_t;
using SlabRows = std::vector<SlabRow>;
static_assert(kSlabVoxels == 8 && sizeof(ClassId) == 2);

constexpr std::size_t kRowsToRelease = std::size_t{1} << 21;  // 16 MiB

constexpr std::uint64_t kPackedOrigin = (std::uint64_t{1} << 20) << 42;  // of i = 0

SlabRow row_of(const PieceVoxel& voxel, const Slab& slab, ClassId class_id) {
  const VoxelKey in_slab{voxel.key.i - slab.first_i, voxel.key.j, voxel.key.k};
  return (pack(in_slab) - kPackedOrigin) << 17 | SlabRow{class_id} << 1 | SlabRow{voxel.touch_only};
}

SurfaceVoxel voxel_of_row(SlabRow row, const Slab& slab) {
  VoxelKey key = unpack((row >> 17) + kPackedOrigin);
  key.i += slab.first_i;
  return {key, static_cast<ClassId>(row >> 1 & 0xffff), (row & 1) == 1};
}

void check(const SurfaceOptions& options) {
  if (!(std::isfinite(options.edge_m) && options.edge_m > 0)) {
    throw Error("voxel_m: is " + std::to_string(options.edge_m) +
                "; give a positive edge in metres");
  }
  if (!(options.epsilon_m >= 0 && options.epsilon_m < options.edge_m)) {
    throw Error(fmt::format(
        "epsilon_m: is {}; give metres from 0 to below the voxel's edge (voxel_m), which is {}",
        options.epsilon_m, options.edge_m));
  }
  if (options.jobs < 1) {
    throw Error("jobs: is " + std::to_string(options.jobs) + "; give at least 1");
  }
}

/// Rows of every slab, sorted, each pair of voxel and class once; threads take slabs in turn.
std::vector<SlabRows> voxelise_slabs(const std::vector<Slab>& slabs, const ClassTable& table,
                                     const SurfaceOptions& options) {
  std::vector<SlabRows> rows_of_slabs(slabs.size());
  Runs runs(slabs.size(), 1);
  run_jobs(options.jobs, [&](int) {
    Voxeliser voxeliser(options.edge_m, options.epsilon_m);
    std::vector<PieceVoxel> voxels;
    SlabRows rows;
    for (Runs::Run run; runs.next(run);) {
      const Slab& slab = slabs[run.first];
      rows.clear();
      for (const PreparedShape* piece : slab.pieces) {
        const ClassId class_id = table.class_of(piece->instance());
        voxels.clear();
        voxeliser.voxelise(*piece, slab.block(), slab.solids, voxels);
        for (const PieceVoxel& voxel : voxels) rows.push_back(row_of(voxel, slab, class_id));
      }
      std::sort(rows.begin(), rows.end());
      rows.erase(std::unique(rows.begin(), rows.end(),
                             [](SlabRow a, SlabRow b) { return a >> 1 == b >> 1; }),
                 rows.end());
      rows_of_slabs[run.first].assign(rows.begin(), rows.end());
    }
  });
  return rows_of_slabs;
}

/// Hands freed memory back to the system; the C library alone would keep it for its threads.
void release_freed() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

/// Gives the slabs' memory back as it goes, so that the peak is the result's own size.
std::vector<SurfaceVoxel> joined(std::vector<SlabRows> rows_of_slabs,
                                 const std::vector<Slab>& slabs) {
  std::size_t count = 0;
  for (const SlabRows& rows : rows_of_slabs) count += rows.size();
  std::vector<SurfaceVoxel> voxels;
  voxels.reserve(count);
  std::size_t freed = 0;
  for (std::size_t n = 0; n < slabs.size(); ++n) {
    for (const SlabRow row : rows_of_slabs[n]) voxels.push_back(voxel_of_row(row, slabs[n]));
    freed += rows_of_slabs[n].size();
    rows_of_slabs[n] = SlabRows();  // `= {}` would keep the memory
    if (freed < kRowsToRelease) continue;
    release_freed();
    freed = 0;
  }
  return voxels;
}

}  // namespace

SurfaceTruth::SurfaceTruth(std::vector<SurfaceVoxel> voxels, double edge_m)
    : rows_(std::make_shared<const std::vector<SurfaceVoxel>>(std::move(voxels))), edge_m_(edge_m) {
  if (!rows_->empty()) least_i_ = rows_->front().key.i;
  for (std::size_t row = 0; row < rows_->size(); ++row) {
    const SurfaceVoxel& voxel = (*rows_)[row];
    const auto layer = static_cast<std::size_t>(voxel.key.i - least_i_);
    if (layer >= layers_.size()) layers_.resize(layer + 1, row);
    if (voxel.class_id >= counts_.size()) counts_.resize(voxel.class_id + 1u);
    ++counts_[voxel.class_id];
  }
  layers_.push_back(rows_->size());
}

bool SurfaceTruth::contains(const VoxelKey& key, ClassId class_id) const {
  const auto rows = classes_at(key);
  return std::ranges::find(rows, class_id, &SurfaceVoxel::class_id) != rows.end();
}

std::span<const SurfaceVoxel> SurfaceTruth::classes_at(const VoxelKey& key) const {
  const std::int64_t layer = std::int64_t{key.i} - least_i_;
  if (layer < 0 || layer + 1 >= static_cast<std::int64_t>(layers_.size())) return {};
  const std::span<const SurfaceVoxel> all = voxels();
  const auto at = static_cast<std::size_t>(layer);
  const std::span rows = all.subspan(layers_[at], layers_[at + 1] - layers_[at]);
  const auto first = std::ranges::lower_bound(rows, key, {}, &SurfaceVoxel::key);
  const auto last =
      std::find_if(first, rows.end(), [&key](const SurfaceVoxel& row) { return row.key != key; });
  return {first, last};
}

SurfaceTruth surface_truth(const std::vector<Shape>& shapes, const ClassTable& table,
                           const Pose& T_map_world, const SurfaceOptions& options) {
  check(options);
  const std::vector<PreparedShape> pieces = prepare(shapes, T_map_world);
  const std::vector<Slab> slabs = slabs_of(pieces, options.edge_m, options.epsilon_m);
  return {joined(voxelise_slabs(slabs, table, options), slabs), options.edge_m};
}

}  // namespace mapscore::eval
