// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/fusion/fusion_rule.hpp"
#include "core/mapping/semantic_map.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace mapscore {

/// What a cube of voxels holds, read as one voxel.
struct CoarseVoxel {
  VoxelKey key;  ///< on the lattice of the coarse edge, anchored as the map's
  bool occupied = false;
  float log_odds = 0.0f;
  ClassBeliefs beliefs;
  std::optional<Colour> colour;

  [[nodiscard]] ClassProbability best() const { return beliefs.best(); }
};

/// The map read at `times` (1, 2, 4, 8, ... up to 1024) its voxel size, ascending by key, as the
/// inner nodes of [R, section 3.4] hold it: occupancy the maximum of the children, colour the mean
/// of those that have one, beliefs combined(rule) of those that are occupied; from the finest
/// voxels upwards, so a pruned leaf reads as the eight equal children that it stands for. The map
/// does not change. Throws Error for another `times` or a rule out of range.
[[nodiscard]] std::vector<CoarseVoxel> read_at(const SemanticMap& map, const FusionRule& rule,
                                               int times);

/// Colours of an export.
enum class Paint {
  classes,  ///< class colours of voxels whose best class has at least the threshold; no others
  seen      ///< mean colours of occupied voxels that have one
};

/// Writes what read_at gives as a ColorOcTree .ot with voxels of the coarse size, which octovis and
/// ROS open; free voxels are left out. Throws Error.
void export_color_at(const SemanticMap& map, const FusionRule& rule, int times, Paint paint,
                     const ClassTable& table, double threshold, const std::filesystem::path& file);

}  // namespace mapscore
