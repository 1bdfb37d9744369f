// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/doses.hpp"

#include <numbers>

namespace mapscore::eval {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

Eigen::Vector3d vector_of(const std::array<double, 3>& values) {
  return {values[0], values[1], values[2]};
}

template <class Settings>
sim::RigidDose rigid_dose(const Settings& settings) {
  return {.translation_m = vector_of(settings.translation_m),
          .rotation_rad = kRadiansPerDegree * vector_of(settings.rotation_deg),
          .magnitude_m = settings.magnitude_m,
          .angle_rad = kRadiansPerDegree * settings.angle_deg};
}

/// Covariance of scale 1.
Covariance6 unit_covariance(const PoseNoiseSettings& settings) {
  Covariance6 covariance = Covariance6::Zero();
  if (settings.covariance_m_rad) {
    for (int row = 0; row < 6; ++row)
      for (int column = 0; column < 6; ++column)
        covariance(row, column) = settings.covariance_m_rad->at(row).at(column);
    return covariance;
  }
  const double tilt = kRadiansPerDegree * settings.sigma_roll_pitch_deg;
  Vector6 sigma;
  sigma << settings.sigma_xy_m, settings.sigma_xy_m, settings.sigma_z_m, tilt, tilt,
      kRadiansPerDegree * settings.sigma_yaw_deg;
  covariance.diagonal() = sigma.cwiseAbs2();
  return covariance;
}

}  // namespace

sim::MisregistrationDose dose_of(const MisregistrationSettings& settings) {
  return {.rigid = rigid_dose(settings),
          .focal_error = settings.focal_error_percent / 100.0,
          .principal_point_px = {settings.principal_point_px[0], settings.principal_point_px[1]}};
}

sim::RigidDose dose_of(const MountSettings& settings) {
  return rigid_dose(settings);
}

sim::PoseDose dose_of(const PoseNoiseSettings& settings) {
  return {.covariance = settings.sigma_scale * settings.sigma_scale * unit_covariance(settings),
          .kind = settings.kind};
}

Covariance6 reported_covariance(const PoseNoiseSettings& settings) {
  return settings.reported_scale * dose_of(settings).covariance;
}

SegmentationParams segmentation_params(const SegmentationSettings& settings) {
  struct Convert {
    SegmentationParams operator()(const DirectSettings&) const { return DirectParams{}; }
    SegmentationParams operator()(const ErosionSettings& s) const {
      return ErosionParams{s.radius_px};
    }
    SegmentationParams operator()(const RegionGrowingSettings& s) const {
      return RegionGrowingParams{s.radius_factor, s.released, s.seed, s.kd_tree};
    }
    SegmentationParams operator()(const EdgeAlignedSettings& s) const {
      return EdgeAlignedParams{s.search_px, s.reach_px};
    }
  };
  return std::visit(Convert{}, settings);
}

}  // namespace mapscore::eval
