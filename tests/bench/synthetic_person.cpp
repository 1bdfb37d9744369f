// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "synthetic_person.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace mapscore::testing {
namespace {

constexpr double kWall_m = 3.5;
constexpr double kNowhere = std::numeric_limits<double>::infinity();

struct Ellipsoid {
  Eigen::Vector3d centre, half_axes;
};

/// Head, trunk, arms and legs in depth_optical, metres (x right, y down, z forward).
const std::array<Ellipsoid, 6> kBody{{{{0.0, -0.62, 2.0}, {0.1, 0.14, 0.11}},
                                      {{0.0, -0.16, 2.0}, {0.22, 0.36, 0.13}},
                                      {{-0.29, -0.14, 1.97}, {0.065, 0.38, 0.07}},
                                      {{0.29, -0.14, 1.97}, {0.065, 0.38, 0.07}},
                                      {{-0.11, 0.5, 2.02}, {0.095, 0.45, 0.1}},
                                      {{0.11, 0.5, 2.02}, {0.095, 0.45, 0.1}}}};

/// Least planar z > 0 at which the ray z * direction from `eye` meets the ellipsoid.
double hit(const Ellipsoid& body, const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d o = (eye - body.centre).cwiseQuotient(body.half_axes);
  const Eigen::Vector3d d = direction.cwiseQuotient(body.half_axes);
  const double a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - 1.0;
  const double discriminant = b * b - a * c;
  return discriminant < 0.0 ? kNowhere : (-b - std::sqrt(discriminant)) / a;
}

double nearest_hit(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) {
  double nearest = kNowhere;
  for (const Ellipsoid& body : kBody) nearest = std::min(nearest, hit(body, eye, direction));
  return nearest;
}

constexpr double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

}  // namespace

SyntheticPerson synthetic_person() {
  SyntheticPerson person;
  person.calibration.color = CameraModel::from_hfov(640, 480, radians(60.0));
  person.calibration.depth = CameraModel::from_hfov(640, 480, radians(58.4));
  person.calibration.T_color_depth.translation() = Eigen::Vector3d(-0.025, 0.0, 0.0);
  person.table.classes.push_back({1, "person", {255, 0, 0}, true});
  person.table.instances.push_back({1, "person_1", 1});
  person.depth.create(480, 640);
  person.label.create(480, 640);
  const Eigen::Vector3d color_eye = -person.calibration.T_color_depth.translation();
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const Eigen::Vector3d depth_ray = person.calibration.depth.back_project(u, v, 1.0);
      const double z = std::min(kWall_m, nearest_hit(Eigen::Vector3d::Zero(), depth_ray));
      person.depth(v, u) = static_cast<std::uint16_t>(std::lround(z * kDepthUnitsPerMetre));
      const Eigen::Vector3d color_ray = person.calibration.color.back_project(u, v, 1.0);
      person.label(v, u) = nearest_hit(color_eye, color_ray) < kNowhere ? 1 : 0;
    }
  }
  return person;
}

}  // namespace mapscore::testing
