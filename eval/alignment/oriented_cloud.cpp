// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/alignment/oriented_cloud.hpp"

#include "core/geometry/voxel.hpp"
#include "eval/alignment/point_tree.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

constexpr double kReach_cells = 2.6;
constexpr std::size_t kFewestNeighbours = 6;
/// Least spread over the next, of a plane; squared.
constexpr double kFlat = 0.25;

std::vector<Vector3d> means_of_cells(std::span<const Vector3d> points, double cell_m) {
  std::vector<std::pair<VoxelKey, std::size_t>> order;
  order.reserve(points.size());
  for (std::size_t n = 0; n < points.size(); ++n)
    order.emplace_back(voxel_of(points[n], cell_m), n);
  std::ranges::sort(order);
  std::vector<Vector3d> means;
  for (std::size_t n = 0; n < order.size();) {
    const std::size_t first = n;
    Vector3d sum = Vector3d::Zero();
    for (; n < order.size() && order[n].first == order[first].first; ++n)
      sum += points[order[n].second];
    means.emplace_back(sum / static_cast<double>(n - first));
  }
  return means;
}

double norm_of(const Vector3d& v) {
  return v.norm();
}

/// Zero unless the points lie on a plane.
Vector3d normal_of(const std::vector<Vector3d>& points, const std::vector<std::size_t>& chosen) {
  if (chosen.size() < kFewestNeighbours) return Vector3d::Zero();
  Vector3d mean = Vector3d::Zero();
  for (const std::size_t n : chosen) mean += points[n];
  mean /= static_cast<double>(chosen.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const std::size_t n : chosen) spread += (points[n] - mean) * (points[n] - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  const Vector3d values = solver.eigenvalues();  // ascending
  if (values[0] > kFlat * values[1]) return Vector3d::Zero();
  return solver.eigenvectors().col(0);
}

/// Half of the edges of the voxels whose centres the points are; zero where they are none: the
/// steps from most of a thousand points to their nearest neighbours are of one length and, but for
/// their sign, of three directions.
Eigen::Matrix3d half_edges_of(std::span<const Vector3d> points) {
  constexpr std::size_t kSample = 1000;
  constexpr double kEqual = 0.01, kMost = 0.8;
  const PointTree tree({points.begin(), points.end()});
  std::vector<Vector3d> steps;
  for (const std::size_t n : spread_numbers(points.size(), kSample))
    if (const auto next = tree.next_to(n)) steps.emplace_back(points[*next] - points[n]);
  if (steps.empty()) return Eigen::Matrix3d::Zero();
  std::ranges::nth_element(steps, steps.begin() + std::ssize(steps) / 2, {}, &norm_of);
  const double edge_m = norm_of(steps[steps.size() / 2]);
  Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();
  std::size_t fitting = 0, axes = 0;
  for (const Vector3d& step : steps) {
    if (edge_m == 0.0 || std::abs(step.norm() - edge_m) > kEqual * edge_m) continue;
    const Vector3d along = edges.transpose() * step / (edge_m * edge_m);
    if (along.cwiseAbs().maxCoeff() < kEqual && axes < 3)
      edges.col(static_cast<Eigen::Index>(axes++)) = step;
    else if (along.cwiseAbs().maxCoeff() < 1 - kEqual)
      continue;
    ++fitting;
  }
  const bool are_voxels =
      axes == 3 && static_cast<double>(fitting) > kMost * static_cast<double>(steps.size());
  return are_voxels ? Eigen::Matrix3d(edges / 2) : Eigen::Matrix3d::Zero();
}

}  // namespace

std::vector<std::size_t> spread_numbers(std::size_t count, std::size_t most) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  if (count <= most) return numbers;
  std::ranges::nth_element(numbers, numbers.begin() + static_cast<std::ptrdiff_t>(most), {},
                           [](std::size_t n) { return mix_bits(n); });
  numbers.resize(most);
  std::ranges::sort(numbers);
  return numbers;
}

OrientedCloud oriented_cloud(std::span<const Vector3d> points, double cell_m, std::size_t most) {
  OrientedCloud cloud;
  cloud.half_edges = half_edges_of(points);
  const bool are_voxels = !cloud.half_edges.isZero();
  if (are_voxels) cell_m = 2 * cloud.half_edges.col(0).norm();
  const std::vector<Vector3d> all = are_voxels ? std::vector<Vector3d>(points.begin(), points.end())
                                               : means_of_cells(points, cell_m);
  const PointTree tree(all);
  for (const std::size_t n : spread_numbers(all.size(), most))
    cloud.points.push_back({all[n], normal_of(all, tree.within(all[n], kReach_cells * cell_m))});
  return cloud;
}

Eigen::Vector3d up_of(std::span<const OrientedPoint> cloud) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  constexpr double kTilt = 20 * kDegree, kStep = 1.5 * kDegree, kWidth = 4 * kDegree;
  std::vector<Vector3d> steep;
  for (const OrientedPoint& point : cloud)
    if (std::abs(point.n.z()) > std::cos(kTilt + kWidth))
      steep.push_back(point.n.z() > 0 ? point.n : Vector3d(-point.n));
  const auto count = [&](const Vector3d& up) {
    return std::ranges::count_if(steep,
                                 [&](const Vector3d& n) { return n.dot(up) > std::cos(kWidth); });
  };
  Vector3d up = Vector3d::UnitZ();
  auto most = count(up);
  for (double tilt = kStep; tilt <= kTilt; tilt += kStep) {
    const int around = static_cast<int>(std::ceil(2 * std::numbers::pi * std::sin(tilt) / kStep));
    for (int n = 0; n < around; ++n) {
      const double heading = 2 * std::numbers::pi * n / around;
      const Vector3d other(std::sin(tilt) * std::cos(heading), std::sin(tilt) * std::sin(heading),
                           std::cos(tilt));
      if (const auto votes = count(other); votes > most) {
        most = votes;
        up = other;
      }
    }
  }
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& n : steep)
    if (n.dot(up) > std::cos(kWidth)) sum += n;
  return sum.isZero() ? up : sum.normalized();
}

}  // namespace mapscore::eval
