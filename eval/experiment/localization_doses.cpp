// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/localization_doses.hpp"

#include "eval/truth/floor_grid.hpp"

#include <numbers>
#include <type_traits>
#include <variant>

namespace mapscore::eval {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

// Each calls link(key of the study, member of the core, unit of the key in that of the member).

void link_noise(auto& s, auto& p, const auto& link) {
  link(s.alpha1, p.alpha1, 1.0);
  link(s.alpha2, p.alpha2, 1.0);
  link(s.alpha3, p.alpha3, 1.0);
  link(s.alpha4, p.alpha4, 1.0);
}

void link_filter(auto& s, auto& p, const auto& link) {
  link(s.least_particles, p.kld.min_particles, 1);
  link(s.most_particles, p.kld.max_particles, 1);
  link(s.kld_epsilon, p.kld.epsilon, 1.0);
  link(s.update_way_m, p.update_way_m, 1.0);
  link(s.update_turn_deg, p.update_turn_rad, kRadiansPerDegree);
}

void link_model(auto& s, auto& p, const auto& link) {
  link(s.beams, p.beams, 1);
  link(s.sigma_hit_m, p.sigma_hit_m, 1.0);
  link(s.temper, p.temper, 1.0);
}

/// Key to member where the key is given.
constexpr auto kApply = [](const auto& key, auto& member, auto unit) {
  using Member = std::remove_reference_t<decltype(member)>;
  if (key) member = static_cast<Member>(*key * unit);
};

/// Member to key.
constexpr auto kTell = [](auto& key, const auto& member, auto unit) {
  using Key = typename std::remove_reference_t<decltype(key)>::value_type;
  key = static_cast<Key>(member) / static_cast<Key>(unit);
};

std::variant<LikelihoodFieldParams, BeamModelParams> model_of(
    const ParticleFilterSettings& settings) {
  const auto with_keys = [&](auto params) {
    link_model(settings, params, kApply);
    return params;
  };
  if (settings.scan_model == ScanModelKind::beam) return with_keys(BeamModelParams{});
  return with_keys(LikelihoodFieldParams{});
}

OdometryNoiseSettings resolved(const OdometryNoiseSettings& settings) {
  const OdometryNoise noise = noise_of(settings);
  OdometryNoiseSettings all;
  link_noise(all, noise, kTell);
  return all;
}

/// Every key that the filter looks at.
LocalizationSettings resolved_filter(const LocalizationSettings& settings) {
  const FilterSettings filter = filter_of(settings, {});
  LocalizationSettings all;
  all.source = PoseSource::particle_filter;
  all.odometry_noise = resolved(settings.odometry_noise);
  all.filter.start = settings.filter.start;
  all.filter.scan_model = settings.filter.scan_model;
  link_filter(all.filter, filter.filter, kTell);
  std::visit([&](const auto& model) { link_model(all.filter, model, kTell); }, filter.model);
  if (filter.global_start) return all;
  all.filter.start_sigma_xy_m = filter.start_sigma_xy_m;
  all.filter.start_sigma_yaw_deg = filter.start_sigma_yaw_rad / kRadiansPerDegree;
  return all;
}

LidarFaultSettings resolved(const LidarFaultSettings& settings) {
  const sim::LidarNoise noise = noise_of(settings);
  if (noise.sigma_m == 0 && noise.sigma_per_metre == 0 && noise.dropout_rate == 0) return {};
  return {.preset = LidarPreset::ideal,
          .scale = 1,
          .sigma_m = noise.sigma_m,
          .sigma_per_metre = noise.sigma_per_metre,
          .dropout_rate = noise.dropout_rate};
}

}  // namespace

double grid_resolution_m(const LocalizationSettings& settings) {
  return settings.grid_resolution_m.value_or(FloorGridOptions{}.resolution_m);
}

sim::LidarNoise noise_of(const LidarFaultSettings& settings) {
  sim::LidarNoise noise;
  const bool ideal = settings.preset == LidarPreset::ideal;
  const auto dose = [&](const std::optional<double>& key, double& member) {
    member = settings.scale * key.value_or(ideal ? 0.0 : member);
  };
  dose(settings.sigma_m, noise.sigma_m);
  dose(settings.sigma_per_metre, noise.sigma_per_metre);
  dose(settings.dropout_rate, noise.dropout_rate);
  return noise;
}

OdometryNoise noise_of(const OdometryNoiseSettings& settings) {
  OdometryNoise noise;
  link_noise(settings, noise, kApply);
  return noise;
}

FilterSettings filter_of(const LocalizationSettings& settings, const LidarFaultSettings& lidar) {
  FilterSettings filter;
  link_filter(settings.filter, filter.filter, kApply);
  filter.filter.noise = noise_of(settings.odometry_noise);
  filter.model = model_of(settings.filter);
  filter.global_start = settings.filter.start == FilterStart::global;
  kApply(settings.filter.start_sigma_xy_m, filter.start_sigma_xy_m, 1.0);
  kApply(settings.filter.start_sigma_yaw_deg, filter.start_sigma_yaw_rad, kRadiansPerDegree);
  filter.lidar_noise = noise_of(lidar);
  return filter;
}

std::pair<std::size_t, std::size_t> particle_bounds(const ParticleFilterSettings& settings) {
  LocalizationSettings of_filter;
  of_filter.filter = settings;
  const KldParams kld = filter_of(of_filter, {}).filter.kld;
  return {kld.min_particles, kld.max_particles};
}

void resolve_localization(LocalizationSettings& localization, FaultSettings& faults,
                          const std::string& content) {
  const PoseSource source = localization.source;
  if (source != PoseSource::gaussian) {
    const PoseNoiseSettings pose = std::exchange(faults.pose, {});
    faults.pose.stamp = pose.stamp;
    if (source != PoseSource::truth) faults.pose.reported_scale = pose.reported_scale;
  }
  faults.lidar =
      source == PoseSource::particle_filter ? resolved(faults.lidar) : LidarFaultSettings{};
  const LocalizationSettings given = std::exchange(localization, {});
  switch (source) {
    case PoseSource::gaussian:
    case PoseSource::truth:  // told as a Gaussian without a dose
      return;
    case PoseSource::odometry:
      localization.source = source;
      localization.odometry_noise = resolved(given.odometry_noise);
      return;
    case PoseSource::particle_filter:
      localization = resolved_filter(given);
      if (given.grid)
        localization.grid = content;
      else
        localization.grid_resolution_m = grid_resolution_m(given);
      return;
    case PoseSource::trajectory:
      localization.source = source;
      localization.trajectory = content;
      return;
  }
}

}  // namespace mapscore::eval
