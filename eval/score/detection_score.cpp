// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/detection_score.hpp"

#include <cstdint>
#include <map>

namespace mapscore::eval {
namespace {

/// Pixels by instance.
using Areas = std::map<InstanceId, std::int64_t>;

/// Adds a row's pixels, those alone where `mask` is not 0 if there is one.
void add_row(const std::uint16_t* ids, const std::uint8_t* mask, int columns, Areas& areas) {
  const auto differs = [&](int u, int first) {
    return ids[u] != ids[first] || (mask && mask[u] != mask[first]);
  };
  for (int u = 0; u < columns;) {
    const int first = u++;
    while (u < columns && !differs(u, first)) ++u;
    if (!mask || mask[first] != 0) areas[ids[first]] += u - first;
  }
}

Areas areas_of(const cv::Mat1w& truth) {
  Areas areas;
  for (int v = 0; v < truth.rows; ++v) add_row(truth[v], nullptr, truth.cols, areas);
  return areas;
}

/// Of the true instances in a detection's mask.
Areas areas_in(const Detection& detection, const cv::Mat1w& truth) {
  Areas areas;
  for (int v = 0; v < detection.box.height(); ++v)
    add_row(truth[detection.box.v_min + v] + detection.box.u_min, detection.mask[v],
            detection.box.width(), areas);
  return areas;
}

std::int64_t sum_of(const Areas& areas) {
  std::int64_t sum = 0;
  for (const auto& [instance, area] : areas) sum += area;
  return sum;
}

}  // namespace

void score_detections(const std::vector<Detection>& detections, const cv::Mat1w& truth,
                      const ClassTable& table, Counts& counts) {
  const auto class_of = [&](InstanceId instance) {
    const ClassId id = table.class_of(instance);
    return table.detected(id) ? id : kBackground;
  };
  const Areas true_areas = areas_of(truth);
  LabelCounts& background = *counts[kBackground].labels;
  for (const auto& [instance, area] : true_areas) {
    LabelCounts& of_class = *counts[class_of(instance)].labels;
    of_class.true_px += area;
    if (class_of(instance) == kBackground)
      background.right_px += area;  // less what masks cover
    else
      ++of_class.instances;
  }
  background.named_px += sum_of(true_areas);
  for (const Detection& detection : detections) {
    LabelCounts& named = *counts[detection.class_id].labels;
    const Areas covered = areas_in(detection, truth);
    const std::int64_t area = sum_of(covered);
    ++named.detections;
    named.named_px += area;
    background.named_px -= area;
    for (const auto& [instance, both] : covered) {
      const ClassId true_class = class_of(instance);
      if (true_class == kBackground) background.right_px -= both;
      if (true_class != detection.class_id) continue;
      named.right_px += both;
      if (3 * both > area + true_areas.at(instance)) ++named.instances_found;
    }
  }
}

}  // namespace mapscore::eval
