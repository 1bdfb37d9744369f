// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/posed_depth.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace mapscore {

void check(const PosedDepth& view) {
  const CameraModel& camera = view.camera;
  if (view.depth.cols != camera.width_px || view.depth.rows != camera.height_px)
    throw Error("depth image: " + std::to_string(view.depth.cols) + " x " +
                std::to_string(view.depth.rows) + " px, but its camera has " +
                std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px) +
                "; give the image of this camera");
  if (!(view.range_min_m > 0.0 && view.range_max_m >= view.range_min_m))
    throw Error("range of the depth camera: " + std::to_string(view.range_min_m) + " to " +
                std::to_string(view.range_max_m) + " m; give 0 < least <= greatest");
}

DepthView::DepthView(PosedDepth seen)
    : seen_(std::move(seen)), T_camera_map_(seen_.T_map_camera.inverse()) {
  check(seen_);
}

bool DepthView::sees(const VoxelKey& key, double edge_m) const {
  const Eigen::Vector3d p = T_camera_map_ * centre_of(key, edge_m);
  if (!(p.z() > 0.0 && p.z() >= seen_.range_min_m && p.z() <= seen_.range_max_m)) return false;
  const Eigen::Vector2d pixel = seen_.camera.project(p);
  const cv::Mat1w& depth = seen_.depth;
  const double u = std::floor(pixel.x() + 0.5), v = std::floor(pixel.y() + 0.5);
  if (!(u >= 0.0 && v >= 0.0 && u < depth.cols && v < depth.rows)) return false;
  const double depth_m = depth(static_cast<int>(v), static_cast<int>(u)) / kDepthUnitsPerMetre;
  return depth_m > 0.0 && p.z() <= depth_m + edge_m;
}

Eigen::AlignedBox3d DepthView::box(double edge_m) const {
  std::uint16_t farthest = 0;
  for (const std::uint16_t depth : seen_.depth) farthest = std::max(farthest, depth);
  Eigen::AlignedBox3d box;
  if (farthest == 0) return box;
  const double far_m = std::min(farthest / kDepthUnitsPerMetre + edge_m, seen_.range_max_m);
  box.extend(seen_.T_map_camera.translation());
  for (const double u : {-0.5, seen_.camera.width_px - 0.5})
    for (const double v : {-0.5, seen_.camera.height_px - 0.5})
      box.extend(seen_.T_map_camera * seen_.camera.back_project(u, v, far_m));
  return box;
}

}  // namespace mapscore
