// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/simulated_labels.hpp"

#include "core/error.hpp"
#include "core/segmentation/registered_cloud.hpp"
#include "eval/objects/object_file.hpp"
#include "eval/objects/true_objects.hpp"

#include <fmt/format.h>

#include <limits>
#include <variant>

namespace mapscore::eval {
namespace {

/// The objects of a file, each an instance beyond those of the table; in the scene's world.
std::vector<PerceivedModel> models_of_file(const std::filesystem::path& path, ClassTable& table) {
  const ObjectFile file = read_objects(path, table);
  const Pose T_world_map = file.T_world_map();
  std::vector<PerceivedModel> models;
  for (const MapObject& object : file.objects) {
    const std::size_t id = table.instances.size();
    if (id > std::numeric_limits<InstanceId>::max())
      throw Error(fmt::format("{}: more objects than label images can tell apart; remove some",
                              path.string()));
    const auto instance = static_cast<InstanceId>(id);
    table.instances.push_back({instance, fmt::format("object_{}", object.id), object.class_id});
    if (table.detected(object.class_id))
      models.push_back({instance, {moved(T_world_map, object.box)}});
  }
  return models;
}

}  // namespace

SimulatedLabels::SimulatedLabels(const SimulatedPerception& settings, const Study& config,
                                 const Recording& recording, const ClassTable& table)
    : settings_(settings), calibration_(recording.info().calibration), table_(table) {
  if (settings.objects) {
    models_ = models_of_file(resolve_path(config, *settings.objects), table_);
    return;
  }
  if (!recording.info().has_truth)
    throw Error(recording.folder().string() +
                ": has no truth to simulate perception of; name an object map as "
                "perception.simulated.objects");
  shapes_ = shapes_of(recording);
  if (!shapes_.poses.empty()) return;
  models_ = models_of(shapes_.shapes, Pose::Identity(), table_,
                      settings_.boxes == PerceivedBoxes::surfaces);
  shapes_ = {};
}

std::vector<PerceivedModel> SimulatedLabels::models_at(double stamp_s) const {
  if (shapes_.poses.empty()) return models_;
  return models_of(shapes_.at(stamp_s), Pose::Identity(), table_,
                   settings_.boxes == PerceivedBoxes::surfaces);
}

cv::Mat1w SimulatedLabels::of(const Frame& frame) const {
  const PosedDepth view{calibration_.depth, frame.T_world_base * calibration_.T_base_depth,
                        calibration_.range_min_m, calibration_.range_max_m, frame.depth};
  const cv::Mat1w seen =
      perceive(models_at(frame.stamp_s), view, settings_.tolerance_m, settings_.min_pixels);
  return labels_in_color(seen, register_depth(frame.depth, calibration_));
}

std::optional<SimulatedLabels> simulated_labels(const Study& config, const Recording& recording,
                                                const ClassTable& table) {
  const auto* settings = std::get_if<SimulatedPerception>(&config.perception);
  if (!settings) return std::nullopt;
  return std::optional<SimulatedLabels>(std::in_place, *settings, config, recording, table);
}

}  // namespace mapscore::eval
