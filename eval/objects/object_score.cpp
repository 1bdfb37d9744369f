// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/objects/object_score.hpp"

#include "core/objects/object_box.hpp"

#include <algorithm>
#include <tuple>

namespace mapscore::eval {
namespace {

ObjectMatch compared(const MapObject& object, const TrueObject& truth, double margin_m) {
  ObjectMatch match;
  match.iou = mapscore::iou(object.box.widened(margin_m), truth.box.widened(margin_m));
  match.centre_m = (object.box.centre() - truth.box.centre()).norm();
  const Eigen::Vector3d true_size = truth.box.bounds().sizes();
  match.size_m = object.box.bounds().sizes() - true_size;
  match.size_share = (match.size_m.array() / (true_size.array() + 2.0 * margin_m)).matrix();
  return match;
}

}  // namespace

std::vector<ObjectMatch> match_objects(std::span<const MapObject> objects,
                                       std::span<const TrueObject> truth,
                                       const ObjectMatchGate& gate) {
  std::vector<ObjectMatch> pairs;
  for (std::size_t t = 0; t < truth.size(); ++t) {
    for (std::size_t o = 0; o < objects.size(); ++o) {
      if (truth[t].class_id != objects[o].class_id) continue;
      ObjectMatch pair = compared(objects[o], truth[t], gate.margin_m);
      pair.truth = t;
      pair.object = o;
      if (pair.iou >= gate.min_iou || pair.centre_m <= gate.max_distance_m) pairs.push_back(pair);
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const ObjectMatch& a, const ObjectMatch& b) {
    return std::tuple(-a.iou, a.centre_m, a.truth, a.object) <
           std::tuple(-b.iou, b.centre_m, b.truth, b.object);
  });
  std::vector<bool> truth_taken(truth.size()), object_taken(objects.size());
  std::erase_if(pairs, [&](const ObjectMatch& pair) {
    if (truth_taken[pair.truth] || object_taken[pair.object]) return true;
    truth_taken[pair.truth] = object_taken[pair.object] = true;
    return false;
  });
  std::sort(pairs.begin(), pairs.end(),
            [](const ObjectMatch& a, const ObjectMatch& b) { return a.truth < b.truth; });
  return pairs;
}

std::optional<double> ObjectCounts::mean(double sum) const {
  return found ? std::optional(sum / static_cast<double>(found)) : std::nullopt;
}

ObjectCounts& ObjectCounts::operator+=(const ObjectCounts& other) {
  truth += other.truth;
  found += other.found;
  objects += other.objects;
  iou_sum += other.iou_sum;
  centre_sum_m += other.centre_sum_m;
  centre_max_m = std::max(centre_max_m, other.centre_max_m);
  size_sum_m += other.size_sum_m;
  size_share_sum += other.size_share_sum;
  return *this;
}

std::vector<ObjectCounts> score_objects(std::span<const MapObject> objects,
                                        std::span<const TrueObject> truth, std::size_t class_count,
                                        const ObjectMatchGate& gate) {
  std::vector<ObjectCounts> counts(class_count);
  for (const TrueObject& real : truth) ++counts.at(real.class_id).truth;
  for (const MapObject& object : objects) ++counts.at(object.class_id).objects;
  for (const ObjectMatch& match : match_objects(objects, truth, gate)) {
    ObjectCounts& of_class = counts[truth[match.truth].class_id];
    ++of_class.found;
    of_class.iou_sum += match.iou;
    of_class.centre_sum_m += match.centre_m;
    of_class.centre_max_m = std::max(of_class.centre_max_m, match.centre_m);
    of_class.size_sum_m += match.size_m.cwiseAbs();
    of_class.size_share_sum += match.size_share.cwiseAbs();
  }
  return counts;
}

}  // namespace mapscore::eval
