// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/alignment/surface_aligner.hpp"

#include "core/geometry/voxel.hpp"
#include "core/parallel.hpp"
#include "eval/alignment/oriented_cloud.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kPointSpacing_m = 0.05;
constexpr std::size_t kMostPoints = 12'000, kFewPoints = 1'500;
/// Yaws that are tried, and how many peaks each may have.
constexpr int kYaws = 72;
constexpr std::size_t kPeaks = 4, kCandidates = 20;
/// Placements nearer to each other than this are one.
constexpr double kSameShift_m = 0.25, kSameTurn = 8 * kDegree;
constexpr double kNear_m = 0.05;
/// A map of surfaces has at least this share at them where it belongs, and the next best place at
/// most this part of it.
constexpr double kLeastShare = 0.4, kMostOfNext = 0.85;
/// Moved by 10 cm it has at most this part of it.
constexpr double kMostOfSlid = 0.95;
constexpr std::size_t kFewestPoints = 50;

std::vector<Vector3d> positions(std::span<const WeightedPoint> points) {
  std::vector<Vector3d> all;
  for (const WeightedPoint& point : points) all.push_back(point.p);
  return all;
}

/// Weights that let each direction of normals count alike, so that a floor does
/// not outweigh all else; points without a normal count little.
std::vector<WeightedPoint> weighted(std::span<const OrientedPoint> cloud) {
  constexpr double kOneBin = 0.94;  // 20 degrees
  std::vector<Vector3d> bins;
  std::vector<double> counts;
  std::vector<std::size_t> bin_of;
  for (const OrientedPoint& point : cloud) {
    if (point.n.isZero()) {
      bin_of.push_back(0);
      continue;
    }
    std::size_t bin = 0;
    while (bin < bins.size() && std::abs(bins[bin].dot(point.n)) < kOneBin) ++bin;
    if (bin == bins.size()) {
      bins.push_back(point.n);
      counts.push_back(0);
    }
    counts[bin] += 1;
    bin_of.push_back(bin);
  }
  std::vector<WeightedPoint> points;
  const double all = static_cast<double>(cloud.size());
  for (std::size_t n = 0; n < cloud.size(); ++n) {
    const double weight =
        cloud[n].n.isZero() ? 0.5 : 1.0 / std::sqrt(std::max(counts[bin_of[n]] / all, 0.01));
    points.push_back({cloud[n], weight});
  }
  return points;
}

std::vector<WeightedPoint> some_of(const std::vector<WeightedPoint>& points, std::size_t most) {
  std::vector<WeightedPoint> some;
  for (const std::size_t n : spread_numbers(points.size(), most)) some.push_back(points[n]);
  return some;
}

/// The middle of points, and how far the farthest but a fiftieth of them lie from it.
std::pair<Vector3d, double> extent_of(std::span<const WeightedPoint> points) {
  Vector3d centre = Vector3d::Zero();
  for (const WeightedPoint& point : points) centre += point.p / static_cast<double>(points.size());
  std::vector<double> radii;
  for (const WeightedPoint& point : points) radii.push_back((point.p - centre).norm());
  std::ranges::sort(radii);
  return {centre, radii[(radii.size() - 1) * 49 / 50]};
}

bool same(const Pose& a, const Pose& b, const Vector3d& centre) {
  const double turn = Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
  return (a * centre - b * centre).norm() < kSameShift_m && turn < kSameTurn;
}

/// Placements to look at, by the share of weight that the correlation gives
/// them.
std::vector<Placement> candidates(const SurfaceIndex& surface,
                                  const std::vector<WeightedPoint>& points, const Vector3d& up,
                                  int jobs) {
  const std::vector<Vector3d> cloud = positions(points);
  double weight = 0.0;
  std::vector<double> weights;
  for (const WeightedPoint& point : points) {
    weights.push_back(point.weight);
    weight += point.weight;
  }
  std::vector<Vector3d> field;
  for (const OrientedPoint& point : surface.points()) field.push_back(point.p);
  const ShiftSearch search(field);
  const Eigen::Matrix3d upright =
      Eigen::Quaterniond::FromTwoVectors(up, Vector3d::UnitZ()).toRotationMatrix();
  const auto turned = [&](int yaw) {
    Pose turn = Pose::Identity();
    turn.linear() =
        Eigen::AngleAxisd(2 * std::numbers::pi * yaw / kYaws, Vector3d::UnitZ()) * upright;
    return turn;
  };
  std::vector<std::vector<Placement>> by_yaw(kYaws);
  for_each_in_parallel(kYaws / 2, jobs, [&](std::size_t pair) {
    std::array<std::vector<Vector3d>, 2> clouds;
    const std::array yaws{static_cast<int>(pair), static_cast<int>(pair) + kYaws / 2};
    for (int part = 0; part < 2; ++part)
      for (const Vector3d& p : cloud) clouds[part].push_back(turned(yaws[part]) * p);
    const auto peaks = search.peaks(clouds, weights, kPeaks);
    for (int part = 0; part < 2; ++part)
      for (const Shift& peak : peaks[part])
        by_yaw[yaws[part]].push_back(
            {Eigen::Translation3d(peak.by) * turned(yaws[part]), peak.score / weight});
  });
  std::vector<Placement> all;
  for (const auto& of_yaw : by_yaw) all.insert(all.end(), of_yaw.begin(), of_yaw.end());
  std::ranges::stable_sort(all, std::ranges::greater(), &Placement::share);
  if (all.size() > kCandidates) all.resize(kCandidates);
  return all;
}

/// The motion brought to where the surfaces lie within the points' voxels. A floor that lies on the
/// border of two layers of voxels holds a map by either of them, or aslant, so steps of half a
/// voxel and of one, and turns that move the map's rim as far, are tried from where it came to
/// rest.
Pose settled(const std::vector<WeightedPoint>& points, const std::vector<WeightedPoint>& few,
             const SurfaceIndex& surface, Pose T, const Eigen::Matrix3d& half_edges) {
  constexpr int kMostSteps = 3;
  constexpr double kRounding_m = 0.003, kClose_m = 0.01, kBetter = 0.01;
  const auto [centre, radius_m] = extent_of(few);
  const double step_m = half_edges.isZero() ? kPointSpacing_m : 2 * half_edges.col(0).norm();
  const auto share = [&](const Pose& at) {
    return share_at_surfaces(few, surface, at, half_edges.isZero() ? kClose_m : kRounding_m,
                             half_edges);
  };
  T = point_to_plane(points, surface, T, {0.1, 0.05, 10});
  for (int n = 0; n < kMostSteps; ++n) {
    T = point_to_plane(points, surface, T, {0.05, 0.01, 25, half_edges});
    const double here = share(T);
    Placement best{T, here};
    const Eigen::Translation3d about_centre(T * centre);
    for (int axis = 0; axis < 6; ++axis)
      for (const double step : {-1.0, -0.5, 0.5, 1.0}) {
        const Vector6 xi = step * (axis < 3 ? step_m : step_m / radius_m) * Vector6::Unit(axis);
        const Pose other = about_centre * exp_pose(xi) * about_centre.inverse() * T;
        if (const double there = share(other); there > best.share) best = {other, there};
      }
    if (best.share < here + kBetter) break;
    T = best.motion;
  }
  return T;
}

/// Of surfaces too large for the points' own spacing the next point may lie farther along them.
SurfaceIndex index_of(std::span<const PreparedShape> pieces, std::span<const Vector3d> seen) {
  const double spacing_m = bounded_spacing_m(pieces);
  std::vector<OrientedPoint> points = surface_points(pieces, spacing_m);
  if (!seen.empty()) keep_seen(points, seen);
  return SurfaceIndex(std::move(points), spacing_m - kPointSpacing_m);
}

/// The best of placements moved by 10 cm, or turned by 30 cm at the map's rim: where one of them
/// fits nearly as well, as on a bare floor, the surfaces do not say where along it the map lies.
Placement slid(const std::vector<WeightedPoint>& few, const SurfaceIndex& surface,
               const Placement& from) {
  constexpr double kStep_m = 0.1, kRimStep_m = 0.3;
  const auto [centre, radius_m] = extent_of(few);
  const Eigen::Translation3d about_centre(from.motion * centre);
  Placement best;
  for (int axis = 0; axis < 6; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const Vector6 xi = sign * (axis < 3 ? kStep_m : kRimStep_m / radius_m) * Vector6::Unit(axis);
      const Pose other = about_centre * exp_pose(xi) * about_centre.inverse() * from.motion;
      if (const double share = share_at_surfaces(few, surface, other, kNear_m); share > best.share)
        best = {other, share};
    }
  return best;
}

/// Why the best placement is not to be trusted; empty where it is.
std::string refusal_of(const Alignment& found) {
  if (found.best.share < kLeastShare)
    return fmt::format(
        "nowhere does more than {:.0f} % of the map's surfaces lie on the truth's, which takes "
        "{:.0f} %",
        100 * found.best.share, 100 * kLeastShare);
  if (found.next.share > kMostOfNext * found.best.share)
    return fmt::format(
        "two places fit alike: {:.1f} % of the map's surfaces lie on the truth's at one "
        "and {:.1f} % at another",
        100 * found.best.share, 100 * found.next.share);
  return {};
}

std::string refusal_of_slid(const Placement& best, const Placement& slid) {
  if (slid.share <= kMostOfSlid * best.share) return {};
  return fmt::format(
      "the surfaces do not hold the map: moved by 10 cm or turned as far, {:.1f} % of it lie on "
      "them in place of "
      "{:.1f} %",
      100 * slid.share, 100 * best.share);
}

}  // namespace

SurfaceAligner::SurfaceAligner(std::span<const PreparedShape> pieces, int jobs,
                               std::span<const Vector3d> seen)
    : surface_(index_of(pieces, seen)), jobs_(jobs) {}

Alignment SurfaceAligner::align(std::span<const Vector3d> map) const {
  Alignment result;
  if (map.size() < kFewestPoints || surface_.points().empty()) {
    result.refusal = fmt::format("{} points on {} of the truth's surfaces are too few to align by",
                                 map.size(), surface_.points().size());
    return result;
  }
  const OrientedCloud cloud = oriented_cloud(map, kPointSpacing_m, kMostPoints);
  const std::vector<WeightedPoint> points = weighted(cloud.points);
  const std::vector<WeightedPoint> few = some_of(points, kFewPoints);
  const Vector3d centre = extent_of(points).first;
  result.before = {Pose::Identity(),
                   share_at_surfaces(points, surface_, Pose::Identity(), kNear_m)};
  std::vector<Placement> placements =
      candidates(surface_, some_of(points, 6000), up_of(cloud.points), jobs_);
  placements.push_back(result.before);
  for_each_in_parallel(placements.size(), jobs_, [&](std::size_t n) {
    Placement& placement = placements[n];
    placement.motion = point_to_plane(few, surface_, placement.motion, {});
    placement.share = share_at_surfaces(few, surface_, placement.motion, kNear_m);
  });
  std::ranges::stable_sort(placements, std::ranges::greater(), &Placement::share);
  // The best few that differ, to the end.
  std::vector<Placement> distinct;
  for (const Placement& placement : placements)
    if (distinct.size() < 3 && std::ranges::none_of(distinct, [&](const Placement& other) {
          return same(other.motion, placement.motion, centre);
        }))
      distinct.push_back(placement);
  for_each_in_parallel(distinct.size(), jobs_, [&](std::size_t n) {
    Placement& placement = distinct[n];
    placement.motion = settled(few, few, surface_, placement.motion, cloud.half_edges);
    placement.share = share_at_surfaces(few, surface_, placement.motion, kNear_m);
  });
  std::ranges::stable_sort(distinct, std::ranges::greater(), &Placement::share);
  result.best = distinct.front();
  for (const Placement& placement : distinct)
    if (!same(placement.motion, result.best.motion, centre)) {
      result.next = placement;
      break;
    }
  result.refusal = refusal_of(result);
  if (result.refusal.empty())
    result.refusal = refusal_of_slid(result.best, slid(few, surface_, result.best));
  // Never to a worse place than it came from, or than it lay at.
  const auto on_all = [&](const Pose& motion) {
    return Placement{motion, share_at_surfaces(points, surface_, motion, kNear_m)};
  };
  result.best = on_all(result.best.motion);
  const Placement last =
      on_all(settled(points, few, surface_, result.best.motion, cloud.half_edges));
  if (last.share >= result.best.share) result.best = last;
  if (result.before.share >= result.best.share) result.best = result.before;
  return result;
}

}  // namespace mapscore::eval
