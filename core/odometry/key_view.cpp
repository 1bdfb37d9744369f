// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/key_view.hpp"

#include <cmath>

namespace mapscore {
namespace {

/// A surface is behind another where it is this many times as far.
constexpr double kBehind = 1.05;
constexpr double kLeastOnPlanes = 0.3, kLeastShown = 0.3;
constexpr std::size_t kLeastShownPoints = 50;

/// visit(depth of the point, depth that the image shows there) in metres, 0 where it shows none.
void for_each_in_view(const DepthScan& scan, const std::vector<std::size_t>& points,
                      const cv::Mat1w& depth, const Calibration& believed, const Pose& T_image_scan,
                      auto&& visit) {
  const Pose T_camera_scan = believed.T_base_depth.inverse() * T_image_scan;
  for (const std::size_t i : points) {
    const Eigen::Vector3d p = T_camera_scan * scan.points[i];
    if (const auto pixel = pixel_in_view(p, believed))
      visit(p.z(), depth(*pixel) / kDepthUnitsPerMetre);
  }
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
  for_each_in_view(scan, upright_points(scan, T_map_scan), depth, believed,
                   T_map_image.inverse() * T_map_scan, [&](double z_m, double shown_z_m) {
                     if (shown_z_m == 0.0) return;
                     ++shown;
                     if (shown_z_m > kBehind * z_m) ++through;
                   });
  return shown < kLeastShownPoints ? 0.0
                                   : static_cast<double>(through) / static_cast<double>(shown);
}

bool KeyView::misses(const DepthScan& scan, const ScanMatch& match, const Calibration& believed,
                     const Pose& T_key_base) const {
  if (!match.upright) return false;
  const std::vector<std::size_t> upright = upright_points(scan, match.T_map_base);
  std::size_t shown = 0;
  for_each_in_view(scan, upright, depth_, believed, T_key_base, [&](double z_m, double shown_z_m) {
    if (z_m <= kBehind * shown_z_m) ++shown;
  });
  const double known =
      upright_share_ * static_cast<double>(shown) / static_cast<double>(upright.size());
  return known >= kLeastShown && match.upright->on_plane_share < kLeastOnPlanes * known;
}

}  // namespace mapscore
