// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/depth_view.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore {

DepthView::DepthView(const cv::Mat1w& depth, const CameraModel& camera, const Pose& T_map_depth,
                     double range_min_m, double range_max_m)
    : depth_(depth),
      camera_(camera),
      T_map_depth_(T_map_depth),
      T_depth_map_(T_map_depth.inverse()),
      range_min_m_(range_min_m),
      range_max_m_(range_max_m) {
  if (depth.cols != camera.width_px || depth.rows != camera.height_px)
    throw Error("depth: the image has another size than its camera; give the camera that took it");
}

bool DepthView::sees(const VoxelKey& key, double edge_m) const {
  const Eigen::Vector3d p = T_depth_map_ * centre_of(key, edge_m);
  if (!(p.z() > 0.0 && p.z() >= range_min_m_ && p.z() <= range_max_m_)) return false;
  const Eigen::Vector2d pixel = camera_.project(p);
  const double u = std::floor(pixel.x() + 0.5), v = std::floor(pixel.y() + 0.5);
  if (!(u >= 0.0 && v >= 0.0 && u < depth_.cols && v < depth_.rows)) return false;
  const double depth_m = depth_(static_cast<int>(v), static_cast<int>(u)) / kDepthUnitsPerMetre;
  return depth_m > 0.0 && p.z() <= depth_m + edge_m;
}

Eigen::AlignedBox3d DepthView::box(double edge_m) const {
  std::uint16_t farthest = 0;
  for (const std::uint16_t depth : depth_) farthest = std::max(farthest, depth);
  Eigen::AlignedBox3d box;
  if (farthest == 0) return box;
  const double far_m = std::min(farthest / kDepthUnitsPerMetre + edge_m, range_max_m_);
  box.extend(T_map_depth_.translation());
  for (const double u : {-0.5, camera_.width_px - 0.5})
    for (const double v : {-0.5, camera_.height_px - 0.5})
      box.extend(T_map_depth_ * camera_.back_project(u, v, far_m));
  return box;
}

}  // namespace mapscore
