// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/alignment/point_to_plane.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace mapscore::eval {
namespace {

using Eigen::Vector3d;

/// |cosine| between normals of one surface, at least.
constexpr double kAlike = 0.7;
/// How much residuals within voxels count.
constexpr double kPull = 0.004;
/// Ties what the surfaces leave free, as a plane does along itself, to where it
/// is.
constexpr double kDamping = 1e-6;
/// Done when nothing moves farther, metres and radians.
constexpr double kStill = 1e-6;

std::vector<Vector3d> positions(const std::vector<OrientedPoint>& points) {
  std::vector<Vector3d> all;
  all.reserve(points.size());
  for (const OrientedPoint& point : points) all.push_back(point.p);
  return all;
}

bool alike(const Vector3d& a, const Vector3d& b) {
  return a.isZero() || std::abs(a.dot(b)) > kAlike;
}

/// How far a voxel reaches along a normal from its centre, metres.
double reach_of(const Eigen::Matrix3d& half_edges, const Pose& T, const Vector3d& n) {
  return (half_edges.transpose() * (T.linear().transpose() * n)).lpNorm<1>();
}

}  // namespace

SurfaceIndex::SurfaceIndex(std::vector<OrientedPoint> points, double slack_m)
    : points_(std::move(points)), tree_(positions(points_)), slack_m_(slack_m) {}

const OrientedPoint* SurfaceIndex::nearest(const OrientedPoint& point, double reach_m) const {
  const auto found = tree_.nearest(point.p, reach_m + slack_m_);
  if (!found || !alike(point.n, points_[*found].n)) return nullptr;
  return &points_[*found];
}

Pose point_to_plane(std::span<const WeightedPoint> points, const SurfaceIndex& surface, Pose T,
                    const PointToPlane& options) {
  // The scale reaches its end after two thirds of the iterations.
  const double fall =
      std::pow(options.to_m / options.from_m, 1.5 / std::max(1, options.iterations - 1));
  double s_m = options.from_m;
  const bool are_voxels = !options.half_edges.isZero();
  const double voxel_m = options.half_edges.norm();  // half of its diagonal
  for (int n = 0; n < options.iterations; ++n, s_m = std::max(s_m * fall, options.to_m)) {
    Covariance6 A = Covariance6::Zero();
    Vector6 b = Vector6::Zero();
    double weights = 0.0;
    for (const WeightedPoint& point : points) {
      const Vector3d p = T * point.p;
      const OrientedPoint* there = surface.nearest({p, T.linear() * point.n}, 3 * s_m + voxel_m);
      if (there == nullptr) continue;
      const double r = there->n.dot(p - there->p);
      const double beyond = std::max(0.0, std::abs(r) - reach_of(options.half_edges, T, there->n));
      const double fit = s_m * s_m / (s_m * s_m + beyond * beyond);
      // The pull of what lies within the slack, and beyond it of what is
      // beyond.
      const double pulled = are_voxels ? std::copysign(beyond, r) + kPull * r : r;
      const double w = point.weight * fit * fit;
      Vector6 J;
      J << there->n, p.cross(there->n);
      A += (beyond > 0.0 || !are_voxels ? w : kPull * w) * J * J.transpose();
      b -= w * pulled * J;
      weights += w;
    }
    if (weights == 0.0) return T;
    A += kDamping * weights * Covariance6::Identity();
    const Vector6 xi = A.ldlt().solve(b);
    T = Eigen::Translation3d(xi.head<3>()) * Pose(exp_rotation(xi.tail<3>())) * T;
    T.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
    if (s_m <= options.to_m && xi.cwiseAbs().maxCoeff() < kStill) break;
  }
  return T;
}

double share_at_surfaces(std::span<const WeightedPoint> points, const SurfaceIndex& surface,
                         const Pose& T, double near_m, const Eigen::Matrix3d& half_edges) {
  const double voxel_m = half_edges.norm();
  double near = 0.0, all = 0.0;
  for (const WeightedPoint& point : points) {
    all += point.weight;
    const Vector3d p = T * point.p;
    const OrientedPoint* there = surface.nearest({p, T.linear() * point.n}, 2 * near_m + voxel_m);
    if (there == nullptr) continue;
    if (std::abs(there->n.dot(p - there->p)) <= near_m + reach_of(half_edges, T, there->n))
      near += point.weight;
  }
  return all > 0.0 ? near / all : 0.0;
}

}  // namespace mapscore::eval
