// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/visible_truth.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

/// Owner and samples of one voxel from its counts, which are sorted by class and not empty.
VisibleVoxel owned(std::span<const SampleCount> counts) {
  VisibleVoxel voxel{counts.front().key, counts.front().class_id, 0};
  std::uint32_t most = 0;
  for (const SampleCount& count : counts) {
    voxel.samples += count.samples;
    if (count.samples > most) {
      most = count.samples;
      voxel.owner = count.class_id;
    }
  }
  return voxel;
}

}  // namespace

VisibleTruth::VisibleTruth(std::vector<VisibleVoxel> voxels, double edge_m)
    : voxels_(std::move(voxels)), slots_(std::bit_ceil(2 * voxels_.size() + 2)), edge_m_(edge_m) {
  std::ranges::sort(voxels_, {},
                    [](const VisibleVoxel& v) { return std::pair(v.owner, pack(v.key)); });
  for (std::size_t row = 0; row < voxels_.size(); ++row) {
    const std::uint64_t key = pack(voxels_[row].key);
    slots_[position(key)] = {key, static_cast<std::uint32_t>(row)};
  }
}

std::size_t VisibleTruth::position(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = mix_bits(key) & mask;
  while (slots_[at].row != kNone && slots_[at].key != key) at = (at + 1) & mask;
  return at;
}

const VisibleVoxel* VisibleTruth::find(const VoxelKey& key) const {
  const std::uint32_t row = slots_[position(pack(key))].row;
  return row == kNone ? nullptr : &voxels_[row];
}

std::span<const VisibleVoxel> VisibleTruth::of(ClassId class_id) const {
  const auto rows = std::ranges::equal_range(voxels_, class_id, {}, &VisibleVoxel::owner);
  return {rows.begin(), rows.end()};
}

std::optional<ClassId> VisibleTruth::owner_of(const VoxelKey& key) const {
  const VisibleVoxel* voxel = find(key);
  return voxel == nullptr ? std::nullopt : std::optional(voxel->owner);
}

std::uint32_t VisibleTruth::samples(const VoxelKey& key, ClassId class_id) const {
  const VisibleVoxel* voxel = find(key);
  return voxel == nullptr || voxel->owner != class_id ? 0 : voxel->samples;
}

VisibleTruth visible_truth(const SampleCounter& samples, const SurfaceTruth& surface,
                           int min_samples) {
  if (min_samples < 1) {
    throw Error("min_samples: is " + std::to_string(min_samples) + "; give at least 1");
  }
  if (samples.edge_m() != surface.edge_m()) {
    throw Error("voxel_m: samples of " + std::to_string(samples.edge_m()) + " m and a surface of " +
                std::to_string(surface.edge_m()) + " m do not match; compute both at one size");
  }
  const std::vector<SampleCount> counts = samples.counts();
  std::vector<VisibleVoxel> voxels;
  for (auto first = counts.begin(); first != counts.end();) {
    const auto last = std::find_if(first, counts.end(),
                                   [&](const SampleCount& c) { return c.key != first->key; });
    const VisibleVoxel voxel = owned({first, last});
    const bool enough = voxel.samples >= static_cast<std::uint32_t>(min_samples);
    if (enough && voxel.owner != kBackground && surface.contains(voxel.key, voxel.owner)) {
      voxels.push_back(voxel);
    }
    first = last;
  }
  return {std::move(voxels), samples.edge_m()};
}

VisibleTruth whole_surface(const SurfaceTruth& surface) {
  std::vector<VisibleVoxel> voxels;
  bool owned_by_touch = false;
  for (const SurfaceVoxel& row : surface.voxels()) {  // by key, then class
    if (row.class_id == kBackground) continue;
    if (voxels.empty() || voxels.back().key != row.key) {
      voxels.push_back({row.key, row.class_id, 0});
      owned_by_touch = row.touch_only;
    } else if (owned_by_touch && !row.touch_only) {
      voxels.back().owner = row.class_id;
      owned_by_touch = false;
    }
  }
  return {std::move(voxels), surface.edge_m()};
}

void check_same_lattice(const SurfaceTruth& surface, const VisibleTruth& visible) {
  if (surface.edge_m() == visible.edge_m()) return;
  throw Error(
      fmt::format("voxel_m: surface truth has {} m, visible truth {} m; make both with one size",
                  surface.edge_m(), visible.edge_m()));
}

}  // namespace mapscore::eval
