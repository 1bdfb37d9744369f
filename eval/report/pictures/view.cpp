// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr double kElevation_rad = 66.0 * std::numbers::pi / 180.0;
constexpr double kVerticalField_deg = 32.0;
constexpr int kOverviewHeight_px = 880;
constexpr double kMargin = 1.01;
constexpr double kPlanMargin = 1.04, kLeastPlan_m = 0.5;
constexpr double kPlanDistance = 10.0;  ///< of the eye, over the longest side of what was seen
constexpr double kPlace_m = 0.75;       ///< edge of the squares in which errors are counted
constexpr double kNearby_m = 1.9;       ///< distance that a close view prefers
constexpr double kAbove_m = 1.3;        ///< how far a close view looks down

/// Bounds of what was seen; of the voxels, where nothing was.
Eigen::AlignedBox3d seen_in_world(const std::vector<JudgedMap>& maps) {
  Eigen::AlignedBox3d seen;
  for (const JudgedMap& map : maps)
    for (int corner = 0; corner < 8 && !map.seen_map.isEmpty(); ++corner)
      seen.extend(map.T_world_map *
                  map.seen_map.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  for (const JudgedMap& map : maps)
    for (std::size_t i = 0; i < map.voxels.size() && map.seen_map.isEmpty(); ++i)
      seen.extend(map.T_world_map * centre_of(map.voxels[i].key, map.edge_m));
  return seen.isEmpty() ? Eigen::AlignedBox3d(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero())
                        : seen;
}

/// Horizontal direction from the middle of a box to an eye that sees its longer side.
Eigen::Vector3d viewing_side(const Eigen::AlignedBox3d& seen) {
  return seen.sizes().x() >= seen.sizes().y() ? -Eigen::Vector3d::UnitY()
                                              : -Eigen::Vector3d::UnitX();
}

/// True when the whole box lies in the picture.
bool holds(const sim::View& view, const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d forward = (view.target_m - view.eye_m).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d up = right.cross(forward);
  const double tangent = std::tan(view.vfov_deg * std::numbers::pi / 360.0);
  const double aspect = static_cast<double>(view.width_px) / view.height_px;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d ray =
        box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)) - view.eye_m;
    const double depth = forward.dot(ray);
    if (depth <= 0 || kMargin * std::abs(up.dot(ray)) > depth * tangent ||
        kMargin * std::abs(right.dot(ray)) > depth * tangent * aspect)
      return false;
  }
  return true;
}

/// Middle of the errors in the square that has most of them.
Eigen::Vector3d worst_place(const std::vector<JudgedMap>& maps) {
  std::map<std::pair<long, long>, std::pair<int, Eigen::Vector3d>> squares;
  for (const JudgedMap& map : maps) {
    for (const JudgedVoxel& voxel : map.voxels) {
      if (voxel.verdict == Verdict::right || voxel.covered) continue;
      const Eigen::Vector3d p = map.T_world_map * centre_of(voxel.key, map.edge_m);
      auto& [errors, sum] =
          squares
              .try_emplace({std::lround(p.x() / kPlace_m), std::lround(p.y() / kPlace_m)}, 0,
                           Eigen::Vector3d::Zero())
              .first->second;
      ++errors;
      sum += p;
    }
  }
  if (squares.empty()) return seen_in_world(maps).center();
  const auto worst = std::max_element(
      squares.begin(), squares.end(),
      [](const auto& a, const auto& b) { return a.second.first < b.second.first; });
  return worst->second.second / worst->second.first;
}

}  // namespace

sim::View overview(const std::vector<JudgedMap>& maps) {
  return overview(seen_in_world(maps));
}

sim::View overview(const Eigen::AlignedBox3d& seen) {
  const Eigen::Vector3d towards_eye = std::cos(kElevation_rad) * viewing_side(seen) +
                                      std::sin(kElevation_rad) * Eigen::Vector3d::UnitZ();
  sim::View view;
  view.height_px = kOverviewHeight_px;
  view.vfov_deg = kVerticalField_deg;
  view.target_m = seen.center();
  double distance_m = 1.0;
  do {
    view.eye_m = view.target_m + distance_m * towards_eye;
    distance_m *= 1.02;
  } while (!holds(view, seen) && distance_m < 1000.0);
  return view;
}

sim::View plan_view(const std::vector<JudgedMap>& maps, int width_px) {
  const Eigen::AlignedBox3d seen = seen_in_world(maps);
  const Eigen::Vector2d size =
      (kPlanMargin * seen.sizes().head<2>()).cwiseMax(Eigen::Vector2d(kLeastPlan_m, kLeastPlan_m));
  sim::View view;
  view.width_px = width_px;
  view.height_px = std::max(1, static_cast<int>(std::lround(width_px * size.y() / size.x())));
  view.target_m = seen.center();
  const double distance_m = std::max(size.maxCoeff(), seen.sizes().z()) * kPlanDistance;
  view.eye_m = view.target_m + distance_m * Eigen::Vector3d::UnitZ();
  view.vfov_deg = 2.0 * std::atan2(0.5 * size.y(), distance_m) * 180.0 / std::numbers::pi;
  return view;
}

std::optional<double> pixels_per_metre(const sim::View& view) {
  const Eigen::Vector3d ray = view.target_m - view.eye_m;
  if (ray.head<2>().norm() > 1e-6 * ray.norm() || ray.z() > 0) return std::nullopt;
  return 0.5 * view.height_px /
         (std::tan(0.5 * view.vfov_deg * std::numbers::pi / 180.0) * ray.norm());
}

sim::View error_view(const std::vector<JudgedMap>& maps, const std::vector<Pose>& T_world_depth) {
  sim::View view;
  view.vfov_deg = 50.0;
  view.target_m = worst_place(maps);
  view.eye_m = view.target_m + kNearby_m * viewing_side(seen_in_world(maps));
  double best = std::numeric_limits<double>::infinity();
  for (const Pose& T_world_camera : T_world_depth) {
    const Eigen::Vector3d target_camera = T_world_camera.inverse() * view.target_m;
    const bool in_view =
        target_camera.z() > 0.5 && target_camera.head<2>().norm() < 0.6 * target_camera.z();
    const double unlike = std::abs(target_camera.norm() - kNearby_m) + (in_view ? 0.0 : 100.0);
    if (unlike >= best) continue;
    best = unlike;
    view.eye_m = T_world_camera.translation();
  }
  view.eye_m.z() = std::max(view.eye_m.z(), view.target_m.z() + kAbove_m);
  return view;
}

std::vector<sim::View> error_views(const std::vector<JudgedMap>& maps,
                                   const std::optional<sim::View>& chosen,
                                   const std::vector<Pose>& T_world_depth) {
  if (chosen) return {*chosen};
  return {overview(maps), error_view(maps, T_world_depth)};
}

std::vector<Pose> depth_camera_poses(const Recording& recording) {
  std::vector<Pose> poses;
  for (int frame = 0; frame < recording.frame_count(); ++frame)
    poses.push_back(recording.T_world_base(frame) * recording.info().calibration.T_base_depth);
  return poses;
}

}  // namespace mapscore::eval
