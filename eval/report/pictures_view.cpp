// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures_view.hpp"

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
constexpr double kPlace_m = 0.75;  ///< edge of the squares in which errors are counted
constexpr double kNearby_m = 1.9;  ///< distance that a close view prefers
constexpr double kAbove_m = 1.3;   ///< how far a close view looks down

Eigen::AlignedBox3d seen_in_world(const std::vector<TrialMap>& maps) {
  Eigen::AlignedBox3d seen;
  for (const TrialMap& map : maps)
    for (int corner = 0; corner < 8; ++corner)
      seen.extend(map.T_world_map *
                  map.seen_map.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  return seen;
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
Eigen::Vector3d worst_place(const std::vector<TrialMap>& maps) {
  std::map<std::pair<long, long>, std::pair<int, Eigen::Vector3d>> squares;
  for (const TrialMap& map : maps) {
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

sim::View overview(const std::vector<TrialMap>& maps) {
  const Eigen::AlignedBox3d seen = seen_in_world(maps);
  const Eigen::Vector3d sizes = seen.sizes();
  const double heading = (sizes.x() >= sizes.y() ? -0.5 * std::numbers::pi : std::numbers::pi);
  const Eigen::Vector3d towards_eye(std::cos(heading) * std::cos(kElevation_rad),
                                    std::sin(heading) * std::cos(kElevation_rad),
                                    std::sin(kElevation_rad));
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

sim::View error_view(const std::vector<TrialMap>& maps, const Recording& recording) {
  sim::View view;
  view.vfov_deg = 50.0;
  view.target_m = worst_place(maps);
  const Pose T_base_depth = recording.info().calibration.T_base_depth;
  double best = std::numeric_limits<double>::infinity();
  for (int frame = 0; frame < recording.frame_count(); ++frame) {
    const Pose T_world_depth = recording.T_world_base(frame) * T_base_depth;
    const Eigen::Vector3d target_depth = T_world_depth.inverse() * view.target_m;
    const bool in_view =
        target_depth.z() > 0.5 && target_depth.head<2>().norm() < 0.6 * target_depth.z();
    const double unlike = std::abs(target_depth.norm() - kNearby_m) + (in_view ? 0.0 : 100.0);
    if (unlike >= best) continue;
    best = unlike;
    view.eye_m = T_world_depth.translation();
  }
  view.eye_m.z() = std::max(view.eye_m.z(), view.target_m.z() + kAbove_m);
  return view;
}

}  // namespace mapscore::eval
