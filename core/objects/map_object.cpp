// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/map_object.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mapscore {
namespace {

/// Latest views that an object keeps.
constexpr std::size_t kMaxViews = 200;

/// Sum of the scores behind a confidence.
double scores_of(const MapObject& object) {
  return object.confidence * (2.0 + object.observations + object.misses) - 1.0;
}

double confidence_of(double scores, int observations, int misses) {
  return std::clamp((1.0 + scores) / (2.0 + observations + misses), 0.0, 1.0);
}

/// Coordinates with the axes of a box and the map's origin.
Pose axes_of(const ObjectBox& box) {
  Pose axes = box.T_frame_box;
  axes.translation().setZero();
  return axes;
}

/// Views of an object along the axes of `box`, in their order.
std::vector<Eigen::AlignedBox3d> views_along(const ObjectBox& box, const MapObject& object) {
  const Pose axes = axes_of(box);
  if (object.views.empty()) {
    const auto count = static_cast<std::size_t>(std::max(1, object.observations));
    return {std::min(kMaxViews, count), cover_in(axes, object.box)};
  }
  if (axes.linear() == object.box.T_frame_box.linear()) return object.views;
  std::vector<Eigen::AlignedBox3d> views;
  for (const Eigen::AlignedBox3d& view : object.views)
    views.push_back(cover_in(axes, moved(axes_of(object.box), oriented(view))));
  return views;
}

void keep_latest(std::vector<Eigen::AlignedBox3d>& views) {
  if (views.size() > kMaxViews)
    views.erase(views.begin(), views.end() - static_cast<std::ptrdiff_t>(kMaxViews));
}

/// The box with these axes whose faces are the quantiles of the views'.
ObjectBox quantile_box(const ObjectBox& axes, const std::vector<Eigen::AlignedBox3d>& views,
                       double share) {
  const auto count = static_cast<double>(views.size());
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * count - 1e-9)) - 1;
  const auto outward = [&](auto position) {
    std::vector<double> faces;
    for (const Eigen::AlignedBox3d& view : views) faces.push_back(position(view));
    std::nth_element(faces.begin(), faces.begin() + rank, faces.end());
    return faces[static_cast<std::size_t>(rank)];
  };
  Eigen::AlignedBox3d box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min()[axis] = -outward([&](const auto& view) { return -view.min()[axis]; });
    box.max()[axis] = outward([&](const auto& view) { return view.max()[axis]; });
    if (box.min()[axis] > box.max()[axis])  // views that do not overlap
      box.min()[axis] = box.max()[axis] = 0.5 * (box.min()[axis] + box.max()[axis]);
  }
  return moved(axes_of(axes), oriented(box));
}

/// `kept` after taking in `other`, which together were seen in these views.
ObjectBox merged_box(const ObjectBox& kept, double kept_weight, const ObjectBox& other,
                     double other_weight, const std::vector<Eigen::AlignedBox3d>& views,
                     const BoxMerge& merge) {
  if (merge.rule == BoxUpdate::quantile) return quantile_box(kept, views, merge.share);
  const Eigen::AlignedBox3d mine(-0.5 * kept.size_m, 0.5 * kept.size_m);
  const Eigen::AlignedBox3d its = cover_in(kept.T_frame_box, other);
  Eigen::AlignedBox3d both = mine.merged(its);
  if (merge.rule == BoxUpdate::mean) {
    const double share = other_weight / (kept_weight + other_weight);
    both = {mine.min() + share * (its.min() - mine.min()),
            mine.max() + share * (its.max() - mine.max())};
  }
  ObjectBox box = kept;
  box.T_frame_box.translation() = kept.T_frame_box * both.center();
  box.size_m = both.sizes();
  return box;
}

}  // namespace

MapObject updated(const MapObject& object, const ObjectDetection& detection, double stamp_s,
                  const BoxMerge& merge) {
  MapObject after = object;
  after.views = views_along(object.box, object);
  after.views.push_back(cover_in(axes_of(object.box), detection.box));
  keep_latest(after.views);
  after.box = merged_box(object.box, std::max(1, object.observations), detection.box, 1.0,
                         after.views, merge);
  after.confidence =
      confidence_of(scores_of(object) + detection.score, object.observations + 1, object.misses);
  ++after.observations;
  after.last_seen_s = std::max(object.last_seen_s, stamp_s);
  after.age = 0;
  if (!detection.model.empty()) after.model = detection.model;
  return after;
}

MapObject merged(const MapObject& a, const MapObject& b, const BoxMerge& merge) {
  const MapObject &low = a.id < b.id ? a : b, &high = a.id < b.id ? b : a;
  const bool low_leads = low.observations >= high.observations;
  const MapObject &kept = low_leads ? low : high, &other = low_leads ? high : low;
  MapObject both = kept;
  both.id = low.id;
  both.views = views_along(kept.box, other);
  const std::vector<Eigen::AlignedBox3d> own = views_along(kept.box, kept);
  both.views.insert(both.views.end(), own.begin(), own.end());
  keep_latest(both.views);
  both.box = merged_box(kept.box, std::max(1, kept.observations), other.box,
                        std::max(1, other.observations), both.views, merge);
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
