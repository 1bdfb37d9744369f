// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/surface_truth.hpp"

#include "core/error.hpp"
#include "eval/truth/shape_tests.hpp"
#include "eval/truth/voxelise.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

/// A row in the order of the result. `class_touch` is class * 2 + touch_only, so that of equal
/// pairs the one that truly meets comes first.
struct PackedRow {
  std::uint64_t key;
  std::uint32_t class_touch;
  auto operator<=>(const PackedRow&) const = default;
  [[nodiscard]] bool same_pair(const PackedRow& other) const {
    return key == other.key && class_touch / 2 == other.class_touch / 2;
  }
};
using PackedRows = std::vector<PackedRow>;

void check(const SurfaceOptions& options) {
  if (!(std::isfinite(options.edge_m) && options.edge_m > 0)) {
    throw Error("voxel_m: is " + std::to_string(options.edge_m) +
                "; give a positive edge in metres");
  }
  if (!(options.epsilon_m >= 0 && options.epsilon_m < options.edge_m)) {
    throw Error("epsilon_m: is " + std::to_string(options.epsilon_m) +
                "; give metres from 0 to below the voxel's edge");
  }
  if (options.jobs < 1) {
    throw Error("jobs: is " + std::to_string(options.jobs) + "; give at least 1");
  }
}

std::vector<PreparedShape> solids_of(const std::vector<PreparedShape>& pieces) {
  std::vector<PreparedShape> solids;
  std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(solids),
               [](const PreparedShape& piece) { return piece.solid(); });
  return solids;
}

/// Sorts and keeps each pair once.
void make_unique(PackedRows& rows) {
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end(),
                         [](const PackedRow& a, const PackedRow& b) { return a.same_pair(b); }),
             rows.end());
}

/// Takes pieces in turn until none is left.
PackedRows voxelise_pieces(const std::vector<PreparedShape>& pieces,
                           const std::vector<PreparedShape>& solids, const ClassTable& table,
                           const SurfaceOptions& options, std::atomic<std::size_t>& next) {
  Voxeliser voxeliser(solids, options.edge_m, options.epsilon_m);
  std::vector<PieceVoxel> voxels;
  PackedRows rows;
  for (std::size_t i = next++; i < pieces.size(); i = next++) {
    voxels.clear();
    voxeliser.voxelise(pieces[i], voxels);
    const std::uint32_t class_id = table.class_of(pieces[i].instance());
    for (const PieceVoxel& voxel : voxels) {
      rows.push_back({pack(voxel.key), class_id * 2 + voxel.touch_only});
    }
  }
  make_unique(rows);
  return rows;
}

PackedRows voxelise_all(const std::vector<PreparedShape>& pieces, const ClassTable& table,
                        const SurfaceOptions& options) {
  const std::vector<PreparedShape> solids = solids_of(pieces);
  std::atomic<std::size_t> next = 0;
  const auto work = [&] { return voxelise_pieces(pieces, solids, table, options, next); };
  std::vector<std::future<PackedRows>> helpers;
  for (int job = 1; job < options.jobs; ++job) {
    helpers.push_back(std::async(std::launch::async, work));
  }
  PackedRows rows = work();
  for (auto& helper : helpers) {
    const PackedRows more = helper.get();
    const auto middle = rows.insert(rows.end(), more.begin(), more.end());
    std::inplace_merge(rows.begin(), middle, rows.end());
  }
  make_unique(rows);
  return rows;
}

}  // namespace

SurfaceTruth::SurfaceTruth(std::vector<SurfaceVoxel> voxels, double edge_m)
    : voxels_(std::move(voxels)), index_(voxels_.size()), edge_m_(edge_m) {
  for (std::size_t row = 0; row < voxels_.size(); ++row) {
    const SurfaceVoxel& voxel = voxels_[row];
    index_.insert(pack(voxel.key), static_cast<std::uint32_t>(row));
    if (voxel.class_id >= counts_.size()) counts_.resize(voxel.class_id + 1u);
    ++counts_[voxel.class_id];
  }
}

bool SurfaceTruth::contains(const VoxelKey& key, ClassId class_id) const {
  const auto rows = classes_at(key);
  return std::any_of(rows.begin(), rows.end(),
                     [class_id](const SurfaceVoxel& row) { return row.class_id == class_id; });
}

bool SurfaceTruth::touches_any(const VoxelKey& key) const {
  return index_.find(pack(key)) != KeyIndex::kNone;
}

std::span<const SurfaceVoxel> SurfaceTruth::classes_at(const VoxelKey& key) const {
  const std::size_t first = index_.find(pack(key));
  if (first == KeyIndex::kNone) return {};
  std::size_t last = first;
  while (last < voxels_.size() && voxels_[last].key == key) ++last;
  return std::span(voxels_).subspan(first, last - first);
}

std::size_t SurfaceTruth::count(ClassId class_id) const {
  return class_id < counts_.size() ? counts_[class_id] : 0;
}

SurfaceTruth surface_truth(const std::vector<Shape>& shapes, const ClassTable& table,
                           const Pose& T_map_world, const SurfaceOptions& options) {
  check(options);
  const std::vector<PreparedShape> pieces = prepare(shapes, T_map_world);
  const PackedRows rows = voxelise_all(pieces, table, options);
  std::vector<SurfaceVoxel> voxels;
  voxels.reserve(rows.size());
  for (const PackedRow& row : rows) {
    voxels.push_back(
        {unpack(row.key), static_cast<ClassId>(row.class_touch / 2), row.class_touch % 2 == 1});
  }
  return {std::move(voxels), options.edge_m};
}

}  // namespace mapscore::eval
