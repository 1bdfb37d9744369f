// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/detection_score.hpp"

#include "eval/score/label_edges.hpp"

#include <algorithm>
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

/// |both| / |either| in billionths, halves up.
std::int64_t iou_nano(std::int64_t both, std::int64_t either) {
  return (2 * both * kBillion + either) / (2 * either);
}

/// The classes that are detected, by id; the others are background.
std::vector<ClassId> detected_classes(const ClassTable& table) {
  std::vector<ClassId> classes(table.classes.size(), kBackground);
  for (const SemanticClass& c : table.classes)
    if (table.detected(c.id)) classes[c.id] = c.id;
  return classes;
}

/// Class ids at the pixels of the truth, and of the masks.
struct ClassImages {
  cv::Mat1w truth, named;
};

ClassImages class_images(const std::vector<Detection>& detections, const cv::Mat1w& truth,
                         const auto& class_of) {
  ClassImages images{cv::Mat1w(truth.size()), cv::Mat1w::zeros(truth.size())};
  for (int v = 0; v < truth.rows; ++v)
    for (int u = 0; u < truth.cols; ++u)
      images.truth(v, u) =
          u > 0 && truth(v, u) == truth(v, u - 1) ? images.truth(v, u - 1) : class_of(truth(v, u));
  for (const Detection& detection : detections)
    images.named(detection.box.rect()).setTo(detection.class_id, detection.mask);
  return images;
}

void add_edges(const ClassImages& images, Counts& counts) {
  const std::vector<EdgeCounts> edges = count_edges(images.truth, images.named, counts.size(),
                                                    edge_tolerance_px(images.truth.size()));
  for (std::size_t c = 0; c < edges.size(); ++c) {
    LabelCounts& labels = *counts[c].labels;
    labels.true_edge_px += edges[c].true_px;
    labels.found_edge_px += edges[c].found_px;
    labels.named_edge_px += edges[c].named_px;
    labels.right_edge_px += edges[c].right_px;
  }
}

}  // namespace

void score_detections(const std::vector<Detection>& detections, const cv::Mat1w& truth,
                      const ClassTable& table, Counts& counts) {
  const std::vector<ClassId> detected = detected_classes(table);
  const auto class_of = [&](InstanceId instance) { return detected[table.class_of(instance)]; };
  for (ClassCounts& of_class : counts) of_class.labels->named_as.resize(counts.size());
  const Areas true_areas = areas_of(truth);
  LabelCounts& background = *counts[kBackground].labels;
  for (const auto& [instance, area] : true_areas) {
    LabelCounts& of_class = *counts[class_of(instance)].labels;
    of_class.true_px += area;
    of_class.named_as[kBackground] += area;  // less what masks cover
    if (class_of(instance) == kBackground)
      background.right_px += area;  // likewise
    else
      ++of_class.instances;
  }
  background.named_px += sum_of(true_areas);
  for (const Detection& detection : detections) {
    LabelCounts& named = *counts[detection.class_id].labels;
    const Areas covered = areas_in(detection, truth);
    const std::int64_t area = sum_of(covered);
    bool finds = false;
    ++named.detections;
    named.named_px += area;
    background.named_px -= area;
    for (const auto& [instance, both] : covered) {
      const ClassId true_class = class_of(instance);
      std::vector<std::int64_t>& named_as = counts[true_class].labels->named_as;
      named_as[kBackground] -= both;
      named_as[detection.class_id] += both;
      if (true_class == kBackground) background.right_px -= both;
      if (true_class != detection.class_id) continue;
      named.right_px += both;
      const std::int64_t together = area + true_areas.at(instance);
      if (3 * both <= together) continue;
      finds = true;
      ++named.instances_found;
      named.iou_sum_nano += iou_nano(both, together - both);
    }
    named.scores.add(detection.score, finds);
  }
  add_edges(class_images(detections, truth, class_of), counts);
}

void score_pixels(const cv::Mat1w& classes, const cv::Mat1w& thousandths, const cv::Mat1w& truth,
                  const ClassTable& table, Counts& counts) {
  constexpr double kThousandth = 1e-3;
  constexpr int kMost = 1000;
  const std::vector<ClassId> detected = detected_classes(table);
  // Pixels by class named, certainty and whether it is right: there are far fewer of these.
  std::vector<std::int64_t> pixels(2 * (kMost + 1) * counts.size());
  for (int v = 0; v < truth.rows; ++v)
    for (int u = 0; u < truth.cols; ++u) {
      const ClassId named = detected[classes(v, u)];
      const bool is_right = detected[table.class_of(truth(v, u))] == named;
      const std::size_t sure = std::min<std::size_t>(thousandths(v, u), kMost);
      ++pixels[2 * ((kMost + 1) * named + sure) + (is_right ? 1 : 0)];
    }
  for (std::size_t at = 0; at < pixels.size(); ++at)
    if (pixels[at] > 0)
      counts[at / 2 / (kMost + 1)].labels->pixels.add(
          kThousandth * static_cast<double>(at / 2 % (kMost + 1)), at % 2 == 1, pixels[at]);
}

}  // namespace mapscore::eval
