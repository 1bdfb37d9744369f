// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/localization_settings.hpp"

#include "eval/study/study.hpp"
#include "eval/truth/floor_grid.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace mapscore::eval {
namespace {

/// Every key that the filter looks at.
ParticleFilterSettings resolved_filter(const LocalizationSettings& settings) {
  const FilterSettings used = filter_of(settings, {});
  ParticleFilterSettings filter;
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
  return filter;
}

/// Every key that visual odometry looks at.
VisualOdometrySettings resolved_visual(const LocalizationSettings& settings) {
  VisualOdometrySettings visual;
  visual.visual = settings.visual.visual;
  visual.sampling = Overrides<DepthSampling>::everything(settings.visual.sampling.values);
  visual.map = Overrides<PlaneMapParams>::everything(settings.visual.map.values);
  visual.key = Overrides<KeyFrameRule>::everything(settings.visual.key.values);
  if (settings.source == PoseSource::visual_slam)
    visual.loops = Overrides<LoopClosure>::everything(settings.visual.loops.values);
  else
    visual.visual.corrected = false;
  return visual;
}

/// A leaf itself, or below a section.
bool is_below(std::string_view path, std::string_view key) {
  return path.starts_with(key) && (path.size() == key.size() || path[key.size()] == '.');
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
  if (settings.filter.scan_model == ScanModelKind::beam)
    filter.model = settings.filter.model.over(BeamModelParams{});
  else
    filter.model = settings.filter.model.values;
  filter.global_start = settings.filter.start == FilterStart::global;
  filter.start = settings.filter.spread.values;
  filter.lidar_noise = lidar.dose();
  return filter;
}

VisualOdometryParams visual_of(const LocalizationSettings& settings) {
  VisualOdometryParams params{settings.visual.sampling.values,
                              settings.visual.map.values,
                              settings.visual.key.values,
                              settings.odometry_noise.values,
                              {}};
  if (settings.source == PoseSource::visual_slam) params.loops = settings.visual.loops.values;
  return params;
}

Dosed<sim::LidarNoise> canonical_lidar(const Dosed<sim::LidarNoise>& settings) {
  const sim::LidarNoise noise = settings.dose();
  if (noise == sim::LidarNoise{}) return {};
  return {.own = Overrides<sim::LidarNoise>::everything(noise)};
}

void resolve_localization(LocalizationSettings& localization, FaultSettings& faults,
                          const std::string& content) {
  const PoseSource source = localization.source;
  if (source != PoseSource::gaussian) {
    const sim::PoseNoise pose = std::exchange(faults.pose, {});
    faults.pose.stamp = pose.stamp;
    if (source != PoseSource::truth) faults.pose.reported_scale = pose.reported_scale;
  }
  faults.lidar = source == PoseSource::particle_filter ? canonical_lidar(faults.lidar)
                                                       : Dosed<sim::LidarNoise>{};
  const LocalizationSettings given = std::exchange(localization, {});
  if (source == PoseSource::gaussian || source == PoseSource::truth)
    return;  // the truth is a Gaussian without a dose
  localization.source = source;
  if (source == PoseSource::trajectory) {
    localization.trajectory = content;
    return;
  }
  if (is_visual(source)) localization.visual = resolved_visual(given);
  if (is_visual(source) && !given.visual.visual.wheels) return;
  localization.odometry_noise = Overrides<OdometryNoise>::everything(given.odometry_noise.values);
  if (source != PoseSource::particle_filter) return;
  localization.filter = resolved_filter(given);
  if (given.grid)
    localization.grid = content;
  else
    localization.grid_resolution_m = grid_resolution_m(given);
}

std::vector<std::string> keys_of_poses(const LocalizationSettings& settings) {
  const std::string noise = "localization.odometry_noise";
  switch (settings.source) {
    case PoseSource::gaussian:
      return {"faults.pose"};
    case PoseSource::truth:
      return {};
    case PoseSource::odometry:
      return {noise};
    case PoseSource::particle_filter:
      return {"localization.filter", "localization.grid", "localization.grid_resolution_m", noise,
              "faults.lidar"};
    case PoseSource::trajectory:
      return {"localization.trajectory"};
    case PoseSource::visual_odometry:
    case PoseSource::visual_slam:
      break;
  }
  std::vector<std::string> keys{"localization.visual", "faults.depth", "faults.mount"};
  if (settings.visual.visual.wheels) keys.push_back(noise);
  return keys;
}

bool decides_poses(const Study& study, std::string_view path) {
  const auto holds = [&](const std::string& key) { return is_below(path, key); };
  Study resolved = study;
  resolve_localization(resolved.localization, resolved.faults, "content");
  const bool is_used = leaf_text(resolved, path) != "-";  // throws where there is no such leaf
  if (std::ranges::none_of(keys_of_poses(study.localization), holds)) return false;
  if (path == "localization.visual.corrected")
    return study.localization.source == PoseSource::visual_slam;
  return is_used || !path.starts_with("localization.");
}

}  // namespace mapscore::eval
