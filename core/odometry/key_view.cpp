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
constexpr std::size_t kLeastShownPoints = 50;

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

bool KeyView::misses(const DepthScan& scan, const ScanMatch& match, const Calibration& believed,
                     const Pose& T_key_base) const {
  if (!match.upright) return false;
  const std::vector<std::size_t> upright = upright_points(scan, match.T_map_base);
  std::size_t shown = 0;
  for_each_in_view(scan, upright, believed, T_key_base, [&](double z_m, const cv::Point& pixel) {
    if (z_m <= kBehind * (depth_(pixel) / kDepthUnitsPerMetre)) ++shown;
  });
  const double known =
      upright_share_ * static_cast<double>(shown) / static_cast<double>(upright.size());
  return known >= kLeastShown && match.upright->on_plane_share < kLeastOnPlanes * known;
}

}  // namespace mapscore
