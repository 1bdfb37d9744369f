// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/frame_check.hpp"

#include "core/error.hpp"
#include "eval/alignment/surface_aligner.hpp"
#include "eval/score/surface_share.hpp"
#include "eval/score/voxel_window.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

/// Below these a map is more likely turned or shifted than bad.
constexpr double kDoubtfulShare = 0.25, kDoubtfulUpright = 0.5;
/// Another unit, or other axes, explain a map that lies at surfaces this well with them.
constexpr double kExplained = 0.5, kBetter = 0.1;
/// A motion that is worth a word.
constexpr double kFar_m = 0.1, kFarTurn = 2 * std::numbers::pi / 180.0;

/// Where the occupied voxels of a map lie.
struct Places {
  SurfaceShare surfaces, upright, detected;
  std::vector<Vector3d> p_map;  ///< their centres
  Eigen::AlignedBox3d bounds;

  [[nodiscard]] bool odd() const {
    return surfaces.share() < kDoubtfulShare || upright.share() < kDoubtfulUpright ||
           detected.share() < kDoubtfulShare;
  }
};

Places places_of(const InputMap& map, const SurfaceTruth& surface, const ClassTable& table) {
  const auto occupied = [&](const VoxelKey& key) {
    const MapVoxel* voxel = map.snapshot.find(key);
    return voxel != nullptr && voxel->occupied;
  };
  Places places;
  for (const auto& [key, best_class, probability, is_occupied] : map.snapshot.voxels()) {
    if (!is_occupied) continue;
    places.p_map.push_back(centre_of(key, surface.edge_m()));
    places.bounds.extend(places.p_map.back());
    const bool is_near = at_surface(key, surface);
    places.surfaces.count(is_near);
    if (occupied({key.i, key.j, key.k - 1}) && occupied({key.i, key.j, key.k + 1}))
      places.upright.count(is_near);
    if (!map.geometry && table.detected(best_class))
      places.detected.count(surface.contains(key, best_class) ||
                            any_in_shell(key, 1, [&, c = best_class](const VoxelKey& at) {
                              return surface.contains(at, c);
                            }));
  }
  return places;
}

std::string span_of(const Eigen::AlignedBox3d& box) {
  return fmt::format("x {:.2f}..{:.2f} y {:.2f}..{:.2f} z {:.2f}..{:.2f} m", box.min().x(),
                     box.max().x(), box.min().y(), box.max().y(), box.min().z(), box.max().z());
}

/// The share of some of the points, in the file's frame, that a change brings to surfaces.
template <class Change>
double share_after(const std::vector<Vector3d>& p_file, const SurfaceTruth& surface,
                   const Change& change) {
  constexpr std::size_t kSample = 5000;
  SurfaceShare share;
  const std::size_t step = std::max(std::size_t{1}, p_file.size() / kSample);
  for (std::size_t n = 0; n < p_file.size(); n += step)
    if (const auto key = packable_voxel_of(change(p_file[n]), surface.edge_m()))
      share.count(at_surface(*key, surface));
  return share.share();
}

Eigen::AlignedBox3d bounds_of(const SurfaceTruth& surface) {
  Eigen::AlignedBox3d bounds;
  for (const SurfaceVoxel& row : surface.voxels())
    bounds.extend(centre_of(row.key, surface.edge_m()));
  return bounds;
}

/// Another unit of length, by the bounds; `scale`: the metres in a unit that the map was read with.
std::string unit_trouble(const Eigen::AlignedBox3d& map, const Eigen::AlignedBox3d& truth,
                         double scale) {
  constexpr double kNearest = 2.5;
  const double times = map.diagonal().norm() / truth.diagonal().norm();
  for (const double units : {1000.0, 100.0, 0.01, 0.001}) {
    if (times <= units / kNearest || times >= units * kNearest) continue;
    const std::string size = times > 1.0 ? fmt::format("its bounds are {:.0f} times", times)
                                         : fmt::format("its bounds are {:.2g} of", times);
    return fmt::format("{} the truth's; if its unit is {:g} m, give --scale {:g}", size,
                       scale / units, scale / units);
  }
  return {};
}

/// What a turn by right angles, or a reflection, mends.
std::string turn_text(const Eigen::Matrix3d& R) {
  if (R.determinant() < 0.0) {
    std::string axes;
    for (int row = 0; row < 3; ++row) {
      int axis = 0;
      R.row(row).cwiseAbs().maxCoeff(&axis);
      axes += fmt::format("{}{}{}", row ? ", " : "", R(row, axis) < 0 ? "-" : "", "xyz"[axis]);
    }
    return fmt::format("it is a mirror image; write its ({}) as (x, y, z)", axes);
  }
  int up = 0;
  R.row(2).cwiseAbs().maxCoeff(&up);
  const bool is_upright = up == 2 && R(2, 2) > 0;
  const double yaw_deg = 180.0 / std::numbers::pi * std::atan2(R(1, 0), R(0, 0));
  return is_upright
             ? fmt::format("it lacks a turn of {:.0f} deg about z", yaw_deg)
             : fmt::format("its axes are swapped ({}{} is up)", R(2, up) < 0 ? "-" : "", "xyz"[up]);
}

/// Axes of the file in another order, or pointing the other way.
std::string axes_trouble(const std::vector<Vector3d>& p_file, const Pose& T_map_file,
                         const SurfaceTruth& surface, double share_now) {
  double most = std::max(kExplained, share_now + kBetter);
  Pose best = Pose::Identity();
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 6; ++y) {
      if (x / 2 == y / 2) continue;
      const auto unit = [](int axis) {
        return Vector3d((axis % 2 == 0 ? 1 : -1) * Vector3d::Unit(axis / 2));
      };
      for (const double side : {1.0, -1.0}) {  // -1: another handedness
        Pose turn = Pose::Identity();
        turn.linear() << unit(x), unit(y), side * unit(x).cross(unit(y));
        const double share = share_after(
            p_file, surface, [&](const Vector3d& p) { return Vector3d(T_map_file * turn * p); });
        if (share <= most + (side < 0 ? kBetter : 0.0)) continue;
        most = share;
        best = turn;
      }
    }
  if (best.isApprox(Pose::Identity())) return {};
  if (best.linear().determinant() < 0.0)
    return fmt::format("{}: {:.0f} % then lie at surfaces", turn_text(best.linear()), 100 * most);
  return fmt::format("{}: {:.0f} % lie at surfaces with --transform '{}'", turn_text(best.linear()),
                     100 * most, transform_text(T_map_file * best));
}

/// A rigid motion that explains the map better.
std::string motion_trouble(const std::vector<Vector3d>& p_map, TruthSource& source) {
  const Alignment found = source.aligner().align(p_map);
  const Pose& motion = found.best.motion;
  const Vector3d p = p_map[p_map.size() / 2];
  const bool is_far =
      (motion * p - p).norm() > kFar_m || Eigen::AngleAxisd(motion.linear()).angle() > kFarTurn;
  if (!found.refusal.empty() || !is_far || found.best.share < found.before.share + kBetter)
    return {};
  return fmt::format(
      "it fits better after {}: {:.0f} % of its surfaces then lie on the truth's, {:.0f} % now; "
      "--align scores it there",
      motion_text(motion), 100 * found.best.share, 100 * found.before.share);
}

/// What is odd about the classes of a map that lies where the truth does.
std::string class_note(const InputMap& map, const Places& places) {
  if (map.geometry) return {};
  if (places.detected.occupied == 0)
    return "none of the map's occupied voxels is of a detected class; --detect chooses others";
  if (places.detected.share() >= kDoubtfulShare) return {};
  return fmt::format(
      "only {:.0f} % of the voxels of detected classes lie on or beside a surface of their class; "
      "are its classes and its scene those of the truth?",
      100.0 * places.detected.share());
}

}  // namespace

std::string motion_text(const Pose& motion) {
  const Eigen::Matrix3d& R = motion.linear();
  const double degrees = 180.0 / std::numbers::pi;
  return fmt::format(
      "a shift of {:.3f} {:.3f} {:.3f} m and a turn of yaw {:.2f}, pitch {:.2f}, roll {:.2f} deg",
      motion.translation().x(), motion.translation().y(), motion.translation().z(),
      degrees * std::atan2(R(1, 0), R(0, 0)), degrees * std::asin(std::clamp(-R(2, 0), -1.0, 1.0)),
      degrees * std::atan2(R(2, 1), R(2, 2)));
}

std::string transform_text(const Pose& T) {
  const Eigen::Quaterniond q(T.linear());
  const Vector3d t = T.translation();
  return fmt::format("{:.6f} {:.6f} {:.6f} {:.12f} {:.12f} {:.12f} {:.12f}", t.x(), t.y(), t.z(),
                     q.x(), q.y(), q.z(), q.w());
}

std::string unit_trouble(std::span<const Vector3d> map, const SurfaceTruth& surface, double scale) {
  Eigen::AlignedBox3d bounds;
  for (const Vector3d& p : map) bounds.extend(p);
  const Eigen::AlignedBox3d truth = bounds_of(surface);
  return bounds.isEmpty() || truth.isEmpty() ? std::string() : unit_trouble(bounds, truth, scale);
}

std::string frame_note(const MapFlags& flags, const InputMap& map, const SurfaceTruth& surface,
                       TruthSource& source) {
  const Places places = places_of(map, surface, source.table());
  if (places.p_map.empty()) return {};
  if (!places.odd()) return class_note(map, places);
  const Eigen::AlignedBox3d truth = bounds_of(surface);
  std::string trouble;
  if (!truth.isEmpty()) {
    std::vector<Vector3d> p_file;
    for (const Vector3d& p : places.p_map) p_file.push_back(map.T_map_file.inverse() * p);
    trouble = unit_trouble(map.bounds.isEmpty() ? places.bounds : map.bounds, truth, flags.scale);
    if (trouble.empty())
      trouble = axes_trouble(p_file, map.T_map_file, surface, places.surfaces.share());
    if (trouble.empty()) trouble = motion_trouble(places.p_map, source);
  }
  if (places.surfaces.in_another_frame())
    throw Error(fmt::format(
        "{}: only {} of {} occupied voxels lie on or beside a surface, so the map seems to lie in "
        "another frame (map {}; truth {}); {}, or score it as it is with --trust_frame",
        flags.file, places.surfaces.at_surfaces, places.surfaces.occupied, span_of(places.bounds),
        truth.isEmpty() ? "empty" : span_of(truth),
        trouble.empty() ? "give --transform, --origin_m or --yaw_deg, or try --align" : trouble));
  if (!trouble.empty()) return "the map seems to lie in another frame: " + trouble;
  if (places.surfaces.share() < kDoubtfulShare)
    return fmt::format(
        "only {:.0f} % of the map's occupied voxels lie on or beside a surface; is it in the frame "
        "that --transform, --origin_m and --yaw_deg say?",
        100.0 * places.surfaces.share());
  return class_note(map, places);
}

}  // namespace mapscore::eval
