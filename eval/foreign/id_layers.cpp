// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/id_layers.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace mapscore::eval {
namespace {

bool named_apart(const std::vector<Detection>& detections) {
  std::set<InstanceId> ids{0};
  return std::ranges::all_of(detections,
                             [&](const Detection& one) { return ids.insert(one.instance).second; });
}

/// Puts the mask into the first layer that is free there.
int place(const Detection& detection, InstanceId id, cv::Size size,
          std::vector<cv::Mat1w>& layers) {
  const cv::Rect window = detection.box.rect();
  for (std::size_t n = 0;; ++n) {
    if (n == layers.size()) layers.emplace_back(cv::Mat1w::zeros(size));
    cv::Mat1w part = layers[n](window);
    if (cv::countNonZero((part != 0) & detection.mask) > 0) continue;
    part.setTo(id, detection.mask);
    return static_cast<int>(n);
  }
}

}  // namespace

IdLayers id_layers(const std::vector<Detection>& detections, cv::Size size) {
  if (detections.size() > std::numeric_limits<InstanceId>::max())
    throw Error("more than 65535 detections in an image; detect fewer");
  IdLayers layers{{cv::Mat1w::zeros(size)}, {}};
  const bool own_ids = named_apart(detections);
  for (const Detection& one : detections) {
    check(one, size.width, size.height);
    const InstanceId id =
        own_ids ? one.instance : static_cast<InstanceId>(layers.meanings.size() + 1);
    layers.meanings.push_back(
        {{}, place(one, id, size, layers.images), id, one.class_id, one.score});
  }
  return layers;
}

std::vector<Detection> detections_of(const std::vector<TrialDetection>& meanings,
                                     const std::vector<SemanticClass>& classes,
                                     const std::function<cv::Mat1w(int)>& layer) {
  std::map<int, ClassTable> tables;  // by layer
  for (const TrialDetection& one : meanings) {
    ClassTable& table = tables.try_emplace(one.layer, ClassTable{classes}).first->second;
    while (table.instances.size() <= one.id)
      table.instances.push_back({static_cast<InstanceId>(table.instances.size()), "", kBackground});
    if (table.instances[one.id].class_id != kBackground)
      throw Error(
          fmt::format("detections.csv: id {} of layer {} stands twice for one frame; keep one",
                      one.id, one.layer));
    table.instances[one.id].class_id = one.class_id;
  }
  std::map<std::pair<int, InstanceId>, Detection> found;
  for (const auto& [number, table] : tables)
    for (Detection& one : mapscore::detections_of(layer(number), table))
      found.emplace(std::pair(number, one.instance), std::move(one));
  std::vector<Detection> detections;
  for (const TrialDetection& one : meanings)
    if (auto at = found.find({one.layer, one.id}); at != found.end()) {
      at->second.score = one.score;
      detections.push_back(std::move(at->second));
      found.erase(at);
    }
  return detections;
}

}  // namespace mapscore::eval
