// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/object_merge.hpp"

#include <algorithm>

namespace mapscore {
namespace {

/// Sum of the scores behind a confidence.
double scores_of(const MapObject& object) {
  return object.confidence * (2.0 + object.observations + object.misses) - 1.0;
}

double confidence_of(double scores, int observations, int misses) {
  return std::clamp((1.0 + scores) / (2.0 + observations + misses), 0.0, 1.0);
}

}  // namespace

ObjectBox merged_box(const ObjectBox& kept, double kept_weight, const ObjectBox& other,
                     double other_weight, BoxUpdate rule) {
  const Eigen::AlignedBox3d mine(-0.5 * kept.size_m, 0.5 * kept.size_m);
  const Eigen::AlignedBox3d its = cover_in(kept.T_frame_box, other);
  Eigen::AlignedBox3d both = mine.merged(its);
  if (rule == BoxUpdate::mean) {
    const double share = other_weight / (kept_weight + other_weight);
    both = {mine.min() + share * (its.min() - mine.min()),
            mine.max() + share * (its.max() - mine.max())};
  }
  ObjectBox box = kept;
  box.T_frame_box.translation() = kept.T_frame_box * both.center();
  box.size_m = both.sizes();
  return box;
}

MapObject updated(const MapObject& object, const ObjectDetection& detection, double stamp_s,
                  BoxUpdate rule) {
  MapObject after = object;
  after.box = merged_box(object.box, std::max(1, object.observations), detection.box, 1.0, rule);
  after.confidence =
      confidence_of(scores_of(object) + detection.score, object.observations + 1, object.misses);
  ++after.observations;
  after.last_seen_s = std::max(object.last_seen_s, stamp_s);
  after.age = 0;
  if (!detection.model.empty()) after.model = detection.model;
  return after;
}

MapObject merged(const MapObject& a, const MapObject& b, BoxUpdate rule) {
  const MapObject &low = a.id < b.id ? a : b, &high = a.id < b.id ? b : a;
  const bool low_leads = low.observations >= high.observations;
  const MapObject &kept = low_leads ? low : high, &other = low_leads ? high : low;
  MapObject both = kept;
  both.id = low.id;
  both.box = merged_box(kept.box, std::max(1, kept.observations), other.box,
                        std::max(1, other.observations), rule);
  if (both.model.empty()) both.model = other.model;
  both.observations += other.observations;
  both.misses += other.misses;
  both.last_seen_s = std::max(low.last_seen_s, high.last_seen_s);
  both.age = low.last_seen_s == high.last_seen_s  ? std::min(low.age, high.age)
             : low.last_seen_s > high.last_seen_s ? low.age
                                                  : high.age;
  both.confidence = confidence_of(scores_of(a) + scores_of(b), both.observations, both.misses);
  return both;
}

MapObject missed(const MapObject& object) {
  MapObject after = object;
  after.confidence = confidence_of(scores_of(object), object.observations, object.misses + 1);
  ++after.misses;
  ++after.age;
  return after;
}

}  // namespace mapscore
