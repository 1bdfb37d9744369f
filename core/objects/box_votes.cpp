// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/box_votes.hpp"

#include "core/geometry/depth_rays.hpp"
#include "core/objects/box_depth.hpp"
#include "core/objects/frustum.hpp"

namespace mapscore {

BoxVotes vote(const ObjectBox& box, const PosedDepth& view, double tolerance_m) {
  check(view);
  BoxVotes votes;
  const ObjectBox seen = moved(view.T_map_camera.inverse(), box);
  if (!Frustum(view.camera, view.range_min_m, view.range_max_m).meets(seen)) return votes;
  votes.outline_px = outline_px(seen, view.camera, view.range_min_m);
  const BoxRays rays(seen, view.range_min_m, view.range_max_m);
  const DepthRays slopes(view.camera);
  const PixelBox pixels = pixels_of(seen, view.camera, view.range_min_m);
  for (int v = pixels.v_min; v <= pixels.v_max; ++v) {
    const std::uint16_t* depth = view.depth[v];
    const double y = slopes.y()[static_cast<std::size_t>(v)];
    for (int u = pixels.u_min; u <= pixels.u_max; ++u) {
      const DepthInterval in_box = rays.at(slopes.x()[static_cast<std::size_t>(u)], y);
      const double z = depth[u] / kDepthUnitsPerMetre;
      const bool hit = in_box.in_m <= in_box.out_m, measured = depth[u] != 0;
      const bool before = z<in_box.in_m - tolerance_m, behind = z> in_box.out_m + tolerance_m;
      votes.unmeasured += hit & !measured;
      votes.occluded += hit & measured & before;
      votes.beyond += hit & measured & behind;
      votes.within += hit & measured & !before & !behind;
    }
  }
  return votes;
}

bool should_be_seen(const BoxVotes& votes, const Visibility& visibility) {
  return votes.looked() >= visibility.min_pixels &&
         votes.looked() >= visibility.min_share * votes.outline_px;
}

}  // namespace mapscore
