// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/posed_depth.hpp"
#include "core/mapping/fusion_rule.hpp"
#include "core/mapping/semantic_map.hpp"
#include "core/mapping/voxel_hit.hpp"
#include "eval/experiment/occupancy_settings.hpp"

#include <cstddef>
#include <span>

namespace mapscore::eval {

/// A map of nothing yet, which carves where the settings say so.
[[nodiscard]] SemanticMap empty_map(double voxel_m, const OccupancySettings& occupancy);

/// Takes one frame into a map: its depth image carves free space where the map carves, and lets
/// voxels in view decay where the rule is a blend that does; then the hits of its draws are fused.
/// `seen`: posed at the mean of the pose belief. Throws Error.
void fuse_frame(SemanticMap& map, const PosedDepth& seen, std::span<const VoxelHit> hits, int draws,
                const FusionRule& rule, std::size_t class_count);

}  // namespace mapscore::eval
