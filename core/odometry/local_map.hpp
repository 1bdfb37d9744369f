// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/odometry/depth_scan.hpp"
#include "core/parameters.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace mapscore {

/// Numbers of the map that scans are matched with.
struct PlaneMapParams {
  double plane_voxel_m = 0.2;
  /// A scan's information is divided by this, since the errors of neighbouring points, and of the
  /// scans that made one plane, are not independent.
  double correlation = 40;

  static void fields(auto& s, auto&& visit) {
    visit(s.plane_voxel_m,
          Field{"plane_voxel_m", "edge of the cubes that hold one plane each", above(0, 10)});
    visit(s.correlation,
          Field{"correlation", "points that are worth one: divides the scan's information",
                above(0, 1e6)});
  }
  bool operator==(const PlaneMapParams&) const = default;
};

/// A pose that is expected before a scan is looked at: T_true = mean Exp(xi), xi ~ N(0, covariance)
/// in the order x y z roll pitch yaw, in the axes of base_footprint.
struct PosePrior {
  Pose mean = Pose::Identity();
  Covariance6 covariance = Covariance6::Identity();
  /// The base stands level on z = 0 for the most part: a robust prior of its own, in the sum.
  bool on_floor = false;
};

/// What a map knows of a scan's points on upright surfaces (upright_points), at least 50.
struct UprightMatch {
  double known_share = 0.0;  ///< in a cube that holds a plane
  double on_plane_share = 0.0;
};

/// One of a scan's upright points.
struct UprightPoint {
  std::size_t index = 0;  ///< in the scan
  bool on_plane = false;  ///< of the map
};

/// What a scan says of a pose, together with its prior.
struct ScanMatch {
  Pose T_map_base = Pose::Identity();
  Covariance6 covariance = Covariance6::Zero();   ///< of prior and scan together
  Covariance6 information = Covariance6::Zero();  ///< of the scan alone, same axes
  double known_share = 0.0;   ///< of the points: those in a cube that holds a plane
  double inlier_share = 0.0;  ///< of those: how many lie on the plane
  std::optional<UprightMatch> upright = {};

  /// Share of all points that lie on the map's planes.
  [[nodiscard]] double support() const { return known_share * inlier_share; }
  /// That of the upright ones, which alone tell one place on a floor from another; 0 of too few.
  [[nodiscard]] double upright_support() const { return upright ? upright->on_plane_share : 0.0; }
};

/// A map of planes, one in each cube of a lattice, from the scans of key frames. Scans are matched
/// with it by point-to-plane distances, weighed by their variances (Y. Chen, G. Medioni, 1992; as
/// voxels: K. Koide et al., Voxelized GICP, 2021), on small_gicp's voxel map and optimizer. Along a
/// plane a point says nothing, so that a bare wall or a corridor leaves the prior as it is. Const
/// members are safe from several threads while nothing inserts.
class LocalMap {
 public:
  /// Cubes that none of the last `horizon` scans met are forgotten. Throws Error when a parameter
  /// is out of range.
  explicit LocalMap(const PlaneMapParams& params, std::size_t horizon);
  LocalMap(LocalMap&&) noexcept;
  LocalMap& operator=(LocalMap&&) noexcept;
  ~LocalMap();

  void insert(const DepthScan& scan, const Pose& T_map_base);
  [[nodiscard]] bool empty() const;

  /// The most probable pose given the prior and the scan, by Gauss-Newton from a pose within reach
  /// of it (centimetres and a degree or two); of a scan without a point in a known cube the prior.
  [[nodiscard]] ScanMatch match(const DepthScan& scan, const PosePrior& prior,
                                const Pose& T_map_start) const;
  [[nodiscard]] ScanMatch match(const DepthScan& scan, const PosePrior& prior) const {
    return match(scan, prior, prior.mean);
  }

  /// Which of the scan's upright points lie on planes at this very pose.
  [[nodiscard]] std::vector<UprightPoint> upright_at(const DepthScan& scan,
                                                     const Pose& T_map_base) const;

 private:
  struct Planes;
  PlaneMapParams params_;
  std::unique_ptr<Planes> planes_;
};

}  // namespace mapscore
