// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/box_depth.hpp"

#include "core/geometry/depth_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

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

struct Interval {
  double low, high;
};

Interval along(const Eigen::Vector3d& axis, const std::array<Eigen::Vector3d, 8>& corners) {
  Interval interval{axis.dot(corners[0]), axis.dot(corners[0])};
  for (const Eigen::Vector3d& corner : corners) {
    interval.low = std::min(interval.low, axis.dot(corner));
    interval.high = std::max(interval.high, axis.dot(corner));
  }
  return interval;
}

}  // namespace

PixelBox pixels_of(const ObjectBox& box, const CameraModel& camera, double near_m) {
  const std::vector<Eigen::Vector2d> pixels = pixels_beyond(box, camera, near_m);
  if (pixels.empty()) return {};
  Eigen::AlignedBox2d bounds;
  for (const Eigen::Vector2d& pixel : pixels) bounds.extend(pixel);
  const Eigen::Vector2d &low = bounds.min(), &high = bounds.max();
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

Frustum::Frustum(const CameraModel& camera, double near_m, double far_m) {
  const double left = -0.5, right = camera.width_px - 0.5;
  const double top = -0.5, bottom = camera.height_px - 0.5;
  std::size_t n = 0;
  for (const double z : {near_m, far_m})
    for (const auto& [u, v] : {std::pair(left, top), std::pair(right, top),
                               std::pair(right, bottom), std::pair(left, bottom)})
      corners_[n++] = camera.back_project(u, v, z);
  for (std::size_t side = 0; side < 4; ++side) edges_[side] = corners_[side].normalized();
  edges_[4] = Eigen::Vector3d::UnitX();
  edges_[5] = Eigen::Vector3d::UnitY();
  for (std::size_t side = 0; side < 4; ++side)
    normals_[side] = edges_[side].cross(edges_[(side + 1) % 4]);
  normals_[4] = Eigen::Vector3d::UnitZ();
}

bool Frustum::meets(const ObjectBox& box) const {
  const std::array<Eigen::Vector3d, 8> box_corners = box.corners();
  const Eigen::Matrix3d axes = box.T_frame_box.linear();
  const auto separated_along = [&](const Eigen::Vector3d& axis) {
    if (axis.squaredNorm() < 1e-18) return false;  // of parallel edges: no direction at all
    const Interval mine = along(axis, corners_), its = along(axis, box_corners);
    return mine.high < its.low || its.high < mine.low;
  };
  for (const Eigen::Vector3d& normal : normals_)
    if (separated_along(normal)) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (separated_along(axes.col(axis))) return false;
  for (const Eigen::Vector3d& edge : edges_)
    for (int axis = 0; axis < 3; ++axis)
      if (separated_along(edge.cross(axes.col(axis)))) return false;
  return true;
}

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
