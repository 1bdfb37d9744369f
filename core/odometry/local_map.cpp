// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/local_map.hpp"

#include <small_gicp/ann/incremental_voxelmap.hpp>
#include <small_gicp/registration/registration.hpp>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mapscore {
namespace {

/// Standard deviations at which a point weighs half (Cauchy), and beyond which it is no inlier.
constexpr double kCauchySigmas = 2.0, kInlierSigmas = 4.0;
/// Added to all variances of the first pass (m^2), which so finds its planes from 10 cm off.
constexpr double kFirstBlur = 0.03 * 0.03;
/// Points that make a plane, and how flat they lie: standard deviation across over that along.
constexpr std::size_t kPlanePoints = 6;
constexpr double kFlatness = 0.25;
/// Standard deviation of a plane's tilt (rad) beyond which its normal tells nothing: far floor, of
/// which few noisy rows fall into a cube, would turn a robot that sees nothing else.
constexpr double kMostTilt = 6.0 * std::numbers::pi / 180.0;
/// Least cosine between the normals of a point and of its plane.
constexpr double kFacing = 0.7;
/// Of a base that stands on a floor: standard deviations of its height (m) and tilt (rad). Where
/// either is this many times as far off, as on a rug's edge or a sill, it weighs a quarter, and
/// soon nothing (S. Geman and D. McClure, 1987).
constexpr double kFloorZ_m = 0.004, kFloorTilt = 0.1 * std::numbers::pi / 180.0, kFloorSigmas = 2.0;
/// Fewer points on upright surfaces say nothing of their own.
constexpr std::size_t kLeastUpright = 50;
/// Of a plane's place: what no number of points takes away (m^2).
constexpr double kPlaneFloor = 1e-6;

/// Points of one orientation in a cube, as moments weighed by their variances, and the plane
/// through them.
struct Plane {
  std::size_t count = 0;
  double weight = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), facing = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
  double variance = 0.0;  ///< of points about the plane: its roughness does not average out
  bool flat = false;

  void add(const Eigen::Vector3d& p, const Eigen::Vector3d& n, double sigma_m) {
    const double w = 1.0 / (sigma_m * sigma_m);
    weight += w;
    sum += w * p;
    facing += w * n;
    squares += w * p * p.transpose();
    ++count;
  }

  void fit() {
    if (count < kPlanePoints) return;
    centre = sum / weight;
    const Eigen::Matrix3d spread = squares / weight - centre * centre.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    const double across = std::max(axes.eigenvalues()[0], 0.0), along = axes.eigenvalues()[1];
    const double noise = static_cast<double>(count) / weight;
    const double tilt_squared = 1.0 / (weight * along);
    flat = across < kFlatness * kFlatness * along + noise && tilt_squared < kMostTilt * kMostTilt;
    normal = axes.eigenvectors().col(0);
    if (normal.dot(facing) < 0.0) normal = -normal;
    variance = across + 1.0 / weight + kPlaneFloor;
  }
};

/// The planes of a cube, one for each of the six ways that surfaces may face: a voxel of
/// small_gicp's map.
struct PlaneVoxel {
  struct Setting {};

  std::array<Plane, 6> planes;
  bool finalized = true;

  void add(const Setting&, const Eigen::Vector4d& p_map, const DepthScan& scan, std::size_t i,
           const Eigen::Isometry3d& T_map_base) {
    const Eigen::Vector3d n = T_map_base.linear() * scan.normals[i];
    Eigen::Index axis = 0;
    n.cwiseAbs().maxCoeff(&axis);
    planes[static_cast<std::size_t>(2 * axis + (n[axis] < 0.0 ? 1 : 0))].add(p_map.head<3>(), n,
                                                                             scan.sigma_m[i]);
    finalized = false;
  }

  void finalize() {
    if (!finalized)
      for (Plane& plane : planes) plane.fit();
    finalized = true;
  }

  /// The plane that faces as a normal does; none where no plane does.
  [[nodiscard]] const Plane* facing(const Eigen::Vector3d& n) const {
    const Plane* best = nullptr;
    double closest = kFacing;
    for (const Plane& plane : planes) {
      const double cosine = plane.normal.dot(n);
      if (!plane.flat || cosine < closest) continue;
      closest = cosine;
      best = &plane;
    }
    return best;
  }
};

}  // namespace
}  // namespace mapscore

namespace small_gicp::traits {

template <>
struct Traits<mapscore::DepthScan> {
  static std::size_t size(const mapscore::DepthScan& scan) { return scan.size(); }
  static Eigen::Vector4d point(const mapscore::DepthScan& scan, std::size_t i) {
    return scan.points[i].homogeneous();
  }
};

}  // namespace small_gicp::traits

namespace mapscore {
namespace {

using PlaneVoxelMap = small_gicp::IncrementalVoxelMap<PlaneVoxel>;

/// small_gicp's order of a perturbation, rotation first, from ours and back.
Vector6 turned_round(const Vector6& xi) {
  Vector6 result;
  result << xi.tail<3>(), xi.head<3>();
  return result;
}
Covariance6 turned_round(const Covariance6& m) {
  Covariance6 result;
  result << m.bottomRightCorner<3, 3>(), m.bottomLeftCorner<3, 3>(), m.topRightCorner<3, 3>(),
      m.topLeftCorner<3, 3>();
  return result;
}

/// Distance of a point from the plane of its cube, over its standard deviation, as a factor of
/// small_gicp's registration: r = n . (m - T p).
struct PlaneFactor {
  double correlation = 1.0, blur = 0.0;  ///< `blur` adds to the variance
  bool known = false;
  double sigmas = 0.0;  ///< the residual

  bool linearize(const PlaneVoxelMap& map, const DepthScan& scan, const PlaneVoxelMap&,
                 const Eigen::Isometry3d& T, std::size_t i, const small_gicp::NullRejector&,
                 Covariance6* H, Vector6* b, double* e) {
    const Eigen::Vector3d& p = scan.points[i];
    const Eigen::Vector3d p_map = T * p;
    known = false;
    const Eigen::Vector4d cell = map.inv_leaf_size * Eigen::Vector4d(p_map.homogeneous());
    const auto found = map.voxels.find(small_gicp::fast_floor(cell).head<3>());
    if (found == map.voxels.end()) return false;
    const Plane* plane =
        map.flat_voxels[found->second]->second.facing(T.linear() * scan.normals[i]);
    if (plane == nullptr) return false;
    known = true;
    const double variance = plane->variance + scan.sigma_m[i] * scan.sigma_m[i] + blur;
    const double residual_m = plane->normal.dot(plane->centre - p_map);
    sigmas = residual_m / std::sqrt(variance);
    const Eigen::RowVector3d n_base = plane->normal.transpose() * T.linear();
    Eigen::Matrix<double, 1, 6> J;
    J << n_base * small_gicp::skew(p), -n_base;
    const double cauchy = 1.0 / (1.0 + sigmas * sigmas / (kCauchySigmas * kCauchySigmas));
    const double weight = cauchy / (variance * correlation);
    *H = weight * J.transpose() * J;
    *b = weight * residual_m * J.transpose();
    *e = 0.5 * weight * residual_m * residual_m;
    return true;
  }

  [[nodiscard]] bool inlier() const { return known && std::abs(sigmas) < kInlierSigmas; }
};

/// The prior in the sum of information, as a factor of all points together; keeps that of the scan
/// alone.
struct PriorFactor {
  Pose T_prior_map;
  Covariance6 information;  ///< rotation first
  bool on_floor = false;
  mutable Covariance6 of_scan = Covariance6::Zero();

  void update_linearized_system(const auto&, const auto&, const auto&, const Eigen::Isometry3d& T,
                                Covariance6* H, Vector6* b, double* e) const {
    of_scan = *H;
    const Vector6 xi = turned_round(log_pose(T_prior_map * T));
    *H += information;
    *b += information * xi;
    *e += 0.5 * xi.dot(information * xi);
    if (on_floor) add_floor(T, *H, *b);
  }

  /// What z = 0, roll 0 and pitch 0 say, each by its own weight.
  static void add_floor(const Eigen::Isometry3d& T, Covariance6& H, Vector6& b) {
    const auto information = [](double squared, double sigma) {
      const double kept = 1.0 / (1.0 + squared / std::pow(kFloorSigmas * sigma, 2));
      return std::pow(kept / sigma, 2);
    };
    const Eigen::Vector3d up = T.linear().row(2);
    const Eigen::Vector2d tilt(up.y(), -up.x());
    const double level = information(tilt.squaredNorm(), kFloorTilt);
    H.topLeftCorner<2, 2>() += level * Eigen::Matrix2d::Identity();
    b.head<2>() += level * tilt;
    const double z_m = T.translation().z(), low = information(z_m * z_m, kFloorZ_m);
    H.bottomRightCorner<3, 3>() += low * up * up.transpose();
    b.tail<3>() += low * z_m * up;
  }
};

/// Of the points on upright surfaces: those in a cube with a plane, and those on it. Nothing where
/// there are too few to say.
std::optional<UprightMatch> upright_match(const DepthScan& scan, const Pose& T_map_base,
                                          const std::vector<PlaneFactor>& factors) {
  const std::vector<std::size_t> upright = upright_points(scan, T_map_base);
  if (upright.size() < kLeastUpright) return {};
  const auto share = [&](auto holds) {
    const auto count =
        std::ranges::count_if(upright, [&](std::size_t i) { return holds(factors[i]); });
    return static_cast<double>(count) / static_cast<double>(upright.size());
  };
  return UprightMatch{share([](const PlaneFactor& f) { return f.known; }),
                      share([](const PlaneFactor& f) { return f.inlier(); })};
}

}  // namespace

struct LocalMap::Planes {
  explicit Planes(double voxel_m) : map(voxel_m) {}
  PlaneVoxelMap map;
};

LocalMap::LocalMap(const PlaneMapParams& params, std::size_t horizon) : params_(params) {
  check_ranges(params);
  planes_ = std::make_unique<Planes>(params.plane_voxel_m);
  planes_->map.lru_horizon = horizon;
}
LocalMap::LocalMap(LocalMap&&) noexcept = default;
LocalMap& LocalMap::operator=(LocalMap&&) noexcept = default;
LocalMap::~LocalMap() = default;

void LocalMap::insert(const DepthScan& scan, const Pose& T_map_base) {
  planes_->map.insert(scan, T_map_base);
}

bool LocalMap::empty() const {
  return planes_->map.size() == 0;
}

ScanMatch LocalMap::match(const DepthScan& scan, const PosePrior& prior,
                          const Pose& T_map_start) const {
  ScanMatch match{.T_map_base = prior.mean, .covariance = prior.covariance};
  if (scan.size() == 0 || empty()) return match;
  PriorFactor expected{prior.mean.inverse(), turned_round(Covariance6(prior.covariance.inverse()))};
  small_gicp::GaussNewtonOptimizer optimizer;
  optimizer.lambda = 0.0;
  small_gicp::TerminationCriteria criteria;
  criteria.translation_eps = 1e-4;
  criteria.rotation_eps = 1e-4;
  small_gicp::SerialReduction reduction;
  small_gicp::RegistrationResult result(T_map_start);
  std::vector<PlaneFactor> factors;
  for (const double blur : {kFirstBlur, 0.0}) {
    factors.assign(scan.size(), PlaneFactor{params_.correlation, blur});
    expected.on_floor = prior.on_floor && blur == 0.0;  // weighed where the scan alone has led
    result = optimizer.optimize(planes_->map, scan, planes_->map, small_gicp::NullRejector{},
                                criteria, reduction, result.T_target_source, factors, expected);
  }
  const auto known = std::ranges::count_if(factors, &PlaneFactor::known);
  match.known_share = static_cast<double>(known) / static_cast<double>(scan.size());
  match.upright = upright_match(scan, result.T_target_source, factors);
  if (known == 0) return match;
  match.inlier_share = static_cast<double>(result.num_inliers) / static_cast<double>(known);
  match.T_map_base = result.T_target_source;
  match.information = turned_round(expected.of_scan);
  match.covariance = turned_round(Covariance6(result.H)).inverse();
  return match;
}

std::vector<UprightPoint> LocalMap::upright_at(const DepthScan& scan,
                                               const Pose& T_map_base) const {
  PlaneFactor factor{params_.correlation, 0.0};
  Covariance6 H;
  Vector6 b;
  double e = 0.0;
  std::vector<UprightPoint> points;
  for (const std::size_t i : upright_points(scan, T_map_base)) {
    factor.linearize(planes_->map, scan, planes_->map, T_map_base, i, {}, &H, &b, &e);
    points.push_back({i, factor.inlier()});
  }
  return points;
}

}  // namespace mapscore
