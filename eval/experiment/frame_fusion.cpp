// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/frame_fusion.hpp"

#include "core/geometry/depth_rays.hpp"
#include "core/mapping/depth_view.hpp"

#include <variant>
#include <vector>

namespace mapscore::eval {
namespace {

void see(SemanticMap& map, const PosedDepth& seen, std::span<const VoxelHit> hits) {
  const DepthRays rays(seen.camera);
  std::vector<Eigen::Vector3d> points;
  for (int v = 0; v < seen.depth.rows; ++v)
    for (int u = 0; u < seen.depth.cols; ++u)
      if (const double z = seen.depth(v, u) / kDepthUnitsPerMetre;
          z > 0.0 && z >= seen.range_min_m && z <= seen.range_max_m)
        points.push_back(seen.T_map_camera * rays.point(u, v, z));
  map.see(seen.T_map_camera.translation(), points, hits);
}

}  // namespace

SemanticMap empty_map(double voxel_m, const OccupancySettings& o) {
  SemanticMap map(voxel_m);
  if (o.carve) map.set_carving({{o.hit, o.miss, o.clamp_min, o.clamp_max}, o.max_range_m});
  return map;
}

void fuse_frame(SemanticMap& map, const PosedDepth& seen, std::span<const VoxelHit> hits, int draws,
                const FusionRule& rule, std::size_t class_count) {
  if (map.carves()) see(map, seen, hits);
  if (const auto* blend = std::get_if<BlendRule>(&rule); blend && blend->decay == Decay::view)
    map.decay_in_view(DepthView(seen), *blend, hits);
  map.fuse(hits, draws, rule, class_count);
}

}  // namespace mapscore::eval
