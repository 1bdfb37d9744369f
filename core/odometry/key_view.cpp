// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/key_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mapscore {
namespace {

/// A surface is behind another where it is this many times as far.
constexpr double kBehind = 1.05;
constexpr double kLeastOnPlanes = 0.3, kLeastShown = 0.3;
constexpr double kLeastShownPoints = 50;
constexpr int kCells = 16;  ///< of a key frame's image, along its width

/// Pixels by which a silhouette may stand elsewhere, by the noise of image and pose.
constexpr int kRagged_px = 2;

/// visit(depth of the point in metres, its pixel) for points in view.
void for_each_in_view(const DepthScan& scan, const std::vector<std::size_t>& points,
                      const Calibration& believed, const Pose& T_image_scan, auto&& visit) {
  const Pose T_camera_scan = believed.T_base_depth.inverse() * T_image_scan;
  for (const std::size_t i : points) {
    const Eigen::Vector3d p = T_camera_scan * scan.points[i];
    if (const auto pixel = pixel_in_view(p, believed)) visit(p.z(), *pixel);
  }
}

/// The nearest depth that an image shows about a pixel, 0 where there is none.
std::uint16_t nearest_about(const cv::Mat1w& depth, const cv::Point& pixel) {
  std::uint16_t nearest = 0;
  for (int v = std::max(pixel.y - kRagged_px, 0);
       v <= std::min(pixel.y + kRagged_px, depth.rows - 1); ++v)
    for (int u = std::max(pixel.x - kRagged_px, 0);
         u <= std::min(pixel.x + kRagged_px, depth.cols - 1); ++u)
      if (depth(v, u) != 0 && (nearest == 0 || depth(v, u) < nearest)) nearest = depth(v, u);
  return nearest;
}

}  // namespace

std::optional<cv::Point> pixel_in_view(const Eigen::Vector3d& p, const Calibration& believed) {
  if (p.z() < believed.range_min_m || p.z() > believed.range_max_m) return {};
  const Eigen::Vector2d pixel = believed.depth.project(p);
  if (pixel.x() < -0.5 || pixel.x() >= believed.depth.width_px - 0.5 || pixel.y() < -0.5 ||
      pixel.y() >= believed.depth.height_px - 0.5)
    return {};
  return cv::Point(static_cast<int>(std::floor(pixel.x() + 0.5)),
                   static_cast<int>(std::floor(pixel.y() + 0.5)));
}

double seen_through(const cv::Mat1w& depth, const Pose& T_map_image, const DepthScan& scan,
                    const Pose& T_map_scan, const Calibration& believed) {
  std::size_t shown = 0, through = 0;
  for_each_in_view(scan, upright_points(scan, T_map_scan), believed,
                   T_map_image.inverse() * T_map_scan, [&](double z_m, const cv::Point& pixel) {
                     if (depth(pixel) == 0) return;
                     ++shown;
                     const double behind_z = kBehind * z_m * kDepthUnitsPerMetre;
                     if (depth(pixel) > behind_z && nearest_about(depth, pixel) > behind_z)
                       ++through;
                   });
  return shown < kLeastShownPoints ? 0.0
                                   : static_cast<double>(through) / static_cast<double>(shown);
}

KeyView::KeyView(const cv::Mat1w& depth, const DepthScan& scan,
                 const std::vector<UprightPoint>& upright, const Calibration& believed)
    : depth_(depth.clone()), cell_px_(std::max(depth.cols / kCells, 1)) {
  const cv::Size cells(depth.cols / cell_px_ + 1, depth.rows / cell_px_ + 1);
  cv::Mat1f count(cells, 0.0F), on_plane(cells, 0.0F);
  const Pose T_camera_base = believed.T_base_depth.inverse();
  for (const UprightPoint& point : upright) {
    const auto pixel = pixel_in_view(T_camera_base * scan.points[point.index], believed);
    if (!pixel) continue;
    count(*pixel / cell_px_) += 1.0F;
    on_plane(*pixel / cell_px_) += point.on_plane ? 1.0F : 0.0F;
  }
  cv::divide(on_plane, count, local_share_);  // 0 where there is none
  if (const double all = cv::sum(count)[0]; all >= kLeastShownPoints)
    on_plane_share_ = cv::sum(on_plane)[0] / all;
}

bool KeyView::misses(const DepthScan& scan, const ScanMatch& match, const Calibration& believed,
                     const Pose& T_key_base) const {
  if (!match.upright) return false;
  const std::vector<std::size_t> upright = upright_points(scan, match.T_map_base);
  double should = 0.0;
  for_each_in_view(scan, upright, believed, T_key_base, [&](double z_m, const cv::Point& pixel) {
    const double seen_z_m = depth_(pixel) / kDepthUnitsPerMetre;
    if (z_m <= seen_z_m / kBehind)
      should += on_plane_share_;
    else if (z_m <= seen_z_m * kBehind)
      should += static_cast<double>(local_share_(pixel / cell_px_));
  });
  should /= static_cast<double>(upright.size());
  return should >= kLeastShown && match.upright->on_plane_share < kLeastOnPlanes * should;
}

}  // namespace mapscore
