// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/box_depth.hpp"

#include <cmath>
#include <limits>

namespace mapscore {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Pixels of the corners beyond `near_m`, and of where edges pass through it.
std::vector<Eigen::Vector2d> pixels_beyond(const ObjectBox& box, const CameraModel& camera,
                                           double near_m) {
  const auto corners = box.corners();
  std::vector<Eigen::Vector2d> pixels;
  for (std::size_t n = 0; n < 8; ++n) {
    if (corners[n].z() >= near_m) pixels.push_back(camera.project(corners[n]));
    for (std::size_t axis = 1; axis < 8; axis *= 2) {
      const Eigen::Vector3d &from = corners[n], &to = corners[n | axis];
      if ((from.z() < near_m) == (to.z() < near_m)) continue;
      const double share = (near_m - from.z()) / (to.z() - from.z());
      Eigen::Vector3d through = from + share * (to - from);
      through.z() = near_m;
      pixels.push_back(camera.project(through));
    }
  }
  return pixels;
}

int within(double pixel, int last) {
  return static_cast<int>(std::clamp(pixel, -1.0, static_cast<double>(last) + 1.0));
}

}  // namespace

PixelBox pixels_of(const ObjectBox& box, const CameraModel& camera, double near_m) {
  const std::vector<Eigen::Vector2d> pixels = pixels_beyond(box, camera, near_m);
  if (pixels.empty()) return {};
  Eigen::Vector2d low = pixels.front(), high = pixels.front();
  for (const Eigen::Vector2d& pixel : pixels) {
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
  }
  const int right = camera.width_px - 1, bottom = camera.height_px - 1;
  return {std::max(0, within(std::floor(low.x()) - 1.0, right)),
          std::max(0, within(std::floor(low.y()) - 1.0, bottom)),
          std::min(right, within(std::ceil(high.x()) + 1.0, right)),
          std::min(bottom, within(std::ceil(high.y()) + 1.0, bottom))};
}

double outline_px(const ObjectBox& box, const CameraModel& camera, double near_m) {
  std::vector<Eigen::Vector2d> pixels;
  for (const Eigen::Vector3d& corner : box.corners()) {
    if (corner.z() < near_m) return std::numeric_limits<double>::infinity();
    pixels.push_back(camera.project(corner));
  }
  std::sort(pixels.begin(), pixels.end(), [](const auto& a, const auto& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  // Andrew's chains: lower, then upper back.
  std::vector<Eigen::Vector2d> hull;
  for (const int pass : {0, 1}) {
    const std::size_t start = hull.size();
    for (const Eigen::Vector2d& pixel : pixels) {
      while (hull.size() >= start + 2 &&
             cross(hull.back() - hull[hull.size() - 2], pixel - hull.back()) <= 0.0)
        hull.pop_back();
      hull.push_back(pixel);
    }
    hull.pop_back();
    if (pass == 0) std::reverse(pixels.begin(), pixels.end());
  }
  double twice = 0.0;
  for (std::size_t n = 0; n < hull.size(); ++n)
    twice += cross(hull[n] - hull[0], hull[(n + 1) % hull.size()] - hull[0]);
  return 0.5 * twice;
}

}  // namespace mapscore
