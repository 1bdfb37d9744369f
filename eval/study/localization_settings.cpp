// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/localization_settings.hpp"

#include "eval/study/study.hpp"
#include "eval/truth/floor_grid.hpp"

#include <variant>

namespace mapscore::eval {
namespace {

std::variant<LikelihoodFieldParams, BeamModelParams> model_of(
    const ParticleFilterSettings& settings) {
  if (settings.scan_model == ScanModelKind::beam) return settings.model.over(BeamModelParams{});
  return settings.model.values;
}

/// Every key that the filter looks at.
LocalizationSettings resolved_filter(const LocalizationSettings& settings) {
  const FilterSettings used = filter_of(settings, {});
  LocalizationSettings all;
  all.source = PoseSource::particle_filter;
  all.odometry_noise = Overrides<OdometryNoise>::everything(used.filter.noise);
  ParticleFilterSettings& filter = all.filter;
  filter.start = settings.filter.start;
  filter.scan_model = settings.filter.scan_model;
  filter.kld = Overrides<KldParams>::everything(used.filter.kld);
  filter.filter = Overrides<ParticleFilterParams>::everything(settings.filter.filter.values);
  std::visit(
      [&]<class Model>(const Model& model) {
        filter.model = Overrides<LikelihoodFieldParams>::everything(
            Overrides<Model>::everything(model).over(LikelihoodFieldParams{}));
      },
      used.model);
  if (!used.global_start) filter.spread = Overrides<StartSpread>::everything(used.start);
  return all;
}

Dosed<sim::LidarNoise> resolved(const Dosed<sim::LidarNoise>& settings) {
  const sim::LidarNoise noise = settings.dose();
  if (noise == sim::LidarNoise{}) return {};
  return {.own = Overrides<sim::LidarNoise>::everything(noise)};
}

}  // namespace

double grid_resolution_m(const LocalizationSettings& settings) {
  return settings.grid_resolution_m.value_or(FloorGridOptions{}.resolution_m);
}

FilterSettings filter_of(const LocalizationSettings& settings,
                         const Dosed<sim::LidarNoise>& lidar) {
  FilterSettings filter;
  filter.filter = settings.filter.filter.values;
  filter.filter.kld = settings.filter.kld.values;
  filter.filter.noise = settings.odometry_noise.values;
  filter.model = model_of(settings.filter);
  filter.global_start = settings.filter.start == FilterStart::global;
  filter.start = settings.filter.spread.values;
  filter.lidar_noise = lidar.dose();
  return filter;
}

void resolve_localization(LocalizationSettings& localization, FaultSettings& faults,
                          const std::string& content) {
  const PoseSource source = localization.source;
  if (source != PoseSource::gaussian) {
    const sim::PoseNoise pose = std::exchange(faults.pose, {});
    faults.pose.stamp = pose.stamp;
    if (source != PoseSource::truth) faults.pose.reported_scale = pose.reported_scale;
  }
  faults.lidar =
      source == PoseSource::particle_filter ? resolved(faults.lidar) : Dosed<sim::LidarNoise>{};
  const LocalizationSettings given = std::exchange(localization, {});
  switch (source) {
    case PoseSource::gaussian:
    case PoseSource::truth:  // a Gaussian without a dose
      return;
    case PoseSource::odometry:
      localization.source = source;
      localization.odometry_noise =
          Overrides<OdometryNoise>::everything(given.odometry_noise.values);
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
