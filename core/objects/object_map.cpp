// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/object_map.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

namespace mapscore {
namespace {

void check_params(const ObjectMapParams& params) {
  const auto require = [](bool holds, const char* name, const char* mend) {
    if (!holds) throw Error(std::string("object map: ") + name + ": " + mend);
  };
  const auto length = [&](double value, const char* name) {
    require(value >= 0.0 && std::isfinite(value), name, "give a length of at least 0");
  };
  const auto share = [&](double value, const char* name) {
    require(value > 0.0 && value <= 1.0, name, "give a share above 0, up to 1");
  };
  const Visibility& visibility = params.visibility;
  length(params.gate.max_distance_m, "max_distance_m");
  length(params.gate.margin_m, "margin_m");
  share(params.gate.min_overlap, "min_overlap");
  share(params.merge_overlap, "merge_overlap");
  length(visibility.tolerance_m, "tolerance_m");
  require(visibility.min_share >= 0.0 && visibility.min_share <= 1.0, "min_share",
          "give a share from 0 to 1");
  require(visibility.min_pixels >= 1, "min_pixels", "give at least 1");
  share(params.update.share, "update.share");
  require(params.max_age >= 1, "max_age", "give at least 1");
}

/// Rotations read from files with six digits pass.
bool is_rotation(const Eigen::Matrix3d& R) {
  constexpr double kTolerance = 1e-4;
  return (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kTolerance &&
         R.determinant() > 0.0;
}

bool is_box(const ObjectBox& box) {
  return box.T_frame_box.matrix().allFinite() && box.size_m.allFinite() &&
         box.size_m.minCoeff() >= 0.0;
}

void check_stamp(double stamp_s) {
  if (!std::isfinite(stamp_s))
    throw Error("object map: stamp " + std::to_string(stamp_s) + "; give the frame's, in seconds");
}

MapObject first_of(const ObjectDetection& detection, double stamp_s) {
  return {.class_id = detection.class_id,
          .box = detection.box,
          .model = detection.model,
          .last_seen_s = stamp_s,
          .observations = 1,
          .confidence = (1.0 + detection.score) / 3.0};
}

/// A detection and an object that pass the gate.
struct Pair {
  double distance_m;
  std::size_t object, detection;
};

/// Those of a class (none: every class) that pass, ascending by id.
std::vector<const MapObject*> those_of(const std::vector<MapObject>& objects,
                                       std::optional<ClassId> class_id, const auto& pass) {
  std::vector<const MapObject*> found;
  for (const MapObject& object : objects)
    if ((!class_id || object.class_id == *class_id) && pass(object)) found.push_back(&object);
  return found;
}

}  // namespace

ObjectMap::ObjectMap(std::size_t class_count, const ObjectMapParams& params)
    : class_count_(class_count), params_(params) {
  if (class_count < 1)
    throw Error("object map: class_count: give that of the class table, background included");
  check_params(params);
}

void ObjectMap::check(const ObjectDetection& detection, std::size_t position) const {
  const auto refuse = [&](const std::string& what) {
    throw Error("object map: detection " + std::to_string(position) + ": " + what);
  };
  if (detection.class_id == kBackground || detection.class_id >= class_count_)
    refuse("class " + std::to_string(detection.class_id) + " is none; classes are 1 to " +
           std::to_string(class_count_ - 1));
  if (!is_box(detection.box)) refuse("its box is not finite, or has a negative size; leave it out");
  if (!is_rotation(detection.box.T_frame_box.linear()))
    refuse("its box's axes are no rotation; give orthogonal ones of length 1, right-handed");
  if (!(detection.score > 0.0 && detection.score <= 1.0))
    refuse("score " + std::to_string(detection.score) + "; give one above 0, up to 1");
}

/// Position of each detection's object, or nothing. Pairs that pass the gate are taken from the
/// least distance of centres on, each detection and each object once; ties go to the earlier
/// object, then the earlier detection.
std::vector<std::optional<std::size_t>> ObjectMap::associate(
    std::span<const ObjectDetection> detections) const {
  const AssociationGate& gate = params_.gate;
  std::vector<Pair> pairs;
  for (std::size_t d = 0; d < detections.size(); ++d) {
    for (std::size_t o = 0; o < objects_.size(); ++o) {
      if (detections[d].class_id != objects_[o].class_id) continue;
      const ObjectBox &seen = detections[d].box, &known = objects_[o].box;
      const double distance_m = (seen.centre() - known.centre()).norm();
      if (distance_m <= gate.max_distance_m ||
          overlap_share(seen.widened(gate.margin_m), known.widened(gate.margin_m)) >=
              gate.min_overlap)
        pairs.push_back({distance_m, o, d});
    }
  }
  std::ranges::sort(pairs, {}, [](const Pair& pair) {
    return std::tie(pair.distance_m, pair.object, pair.detection);
  });
  std::vector<std::optional<std::size_t>> object_of(detections.size());
  std::vector<bool> taken(objects_.size());
  for (const Pair& pair : pairs) {
    if (object_of[pair.detection] || taken[pair.object]) continue;
    object_of[pair.detection] = pair.object;
    taken[pair.object] = true;
  }
  return object_of;
}

ObjectChanges ObjectMap::integrate(std::span<const ObjectDetection> detections, double stamp_s,
                                   const PosedDepth* view) {
  check_stamp(stamp_s);
  for (std::size_t d = 0; d < detections.size(); ++d) check(detections[d], d);
  if (view) mapscore::check(*view);
  const auto object_of = associate(detections);
  ObjectChanges changes;
  std::set<ObjectId> seen;
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (object_of[d]) {
      MapObject& object = objects_[*object_of[d]];
      object = updated(object, detections[d], stamp_s, params_.update);
      changes.updated.push_back(object.id);
      seen.insert(object.id);
    } else {
      changes.added.push_back(add(first_of(detections[d], stamp_s)));
      seen.insert(changes.added.back());
    }
  }
  std::sort(changes.updated.begin(), changes.updated.end());
  tell_apart(seen);
  merge_overlapping(changes);
  if (view) age(seen, *view, changes);
  return changes;
}

/// Two detections of one frame are two objects: such a pair is never merged.
void ObjectMap::tell_apart(const std::set<ObjectId>& seen) {
  for (auto low = seen.begin(); low != seen.end(); ++low)
    for (auto high = std::next(low); high != seen.end(); ++high)
      if (find(*low)->class_id == find(*high)->class_id) apart_.insert({*low, *high});
}

/// What was told apart from the one that goes is apart from the one that stays.
void ObjectMap::pass_on_apart(ObjectId gone, ObjectId kept) {
  const auto pairs = apart_;
  for (const auto& [low, high] : pairs) {
    if (low != gone && high != gone) continue;
    const ObjectId other = low == gone ? high : low;
    apart_.erase({low, high});
    apart_.insert({std::min(kept, other), std::max(kept, other)});
  }
}

void ObjectMap::merge_overlapping(ObjectChanges& changes) {
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    for (std::size_t j = i + 1; j < objects_.size(); ++j) {
      const MapObject &low = objects_[i], &high = objects_[j];
      if (low.class_id != high.class_id || apart_.contains({low.id, high.id})) continue;
      const double margin_m = params_.gate.margin_m;
      if (overlap_share(low.box.widened(margin_m), high.box.widened(margin_m)) <
          params_.merge_overlap)
        continue;
      changes.merged.push_back(high.id);
      pass_on_apart(high.id, low.id);
      objects_[i] = merged(low, high, params_.update);
      objects_.erase(objects_.begin() + static_cast<std::ptrdiff_t>(j));
      j = i;  // it has grown: look at all the others again
    }
  }
  std::sort(changes.merged.begin(), changes.merged.end());
}

void ObjectMap::age(const std::set<ObjectId>& seen, const PosedDepth& view,
                    ObjectChanges& changes) {
  for (MapObject& object : objects_) {
    if (seen.contains(object.id)) continue;
    const BoxVotes votes = vote(object.box, view, params_.visibility.tolerance_m);
    if (!should_be_seen(votes, params_.visibility)) continue;
    object = missed(object);
    changes.missed.push_back(object.id);
    if (object.age >= params_.max_age) changes.removed.push_back(object.id);
  }
  for (const ObjectId id : changes.removed) remove(id);
}

ObjectId ObjectMap::add(MapObject object) {
  check({object.class_id, object.box, 1.0, {}}, 0);
  check_stamp(object.last_seen_s);
  if (object.observations < 0 || object.misses < 0 || object.age < 0)
    throw Error("object map: observations, misses and age must be at least 0; mend the object");
  if (!(object.confidence >= 0.0 && object.confidence <= 1.0))
    throw Error("object map: confidence " + std::to_string(object.confidence) +
                "; give one from 0 to 1");
  if (object.id == 0) object.id = next_;
  if (object.id < next_)
    throw Error("object map: id " + std::to_string(object.id) +
                " was given before; leave it 0 for the next");
  next_ = object.id + 1;
  objects_.push_back(std::move(object));
  return objects_.back().id;
}

std::vector<MapObject>::iterator ObjectMap::require(ObjectId id) {
  const MapObject* found = find(id);
  if (!found) throw Error("object map: there is no object " + std::to_string(id));
  return objects_.begin() + (found - objects_.data());
}

void ObjectMap::update(ObjectId id, const ObjectDetection& detection, double stamp_s) {
  check_stamp(stamp_s);
  check(detection, 0);
  const auto at = require(id);
  if (at->class_id != detection.class_id)
    throw Error("object map: object " + std::to_string(id) +
                " is of another class than the detection; add it as one of its own");
  *at = updated(*at, detection, stamp_s, params_.update);
}

void ObjectMap::remove(ObjectId id) {
  objects_.erase(require(id));
  std::erase_if(apart_, [&](const auto& pair) { return pair.first == id || pair.second == id; });
}

const MapObject* ObjectMap::find(ObjectId id) const {
  const auto at = std::ranges::lower_bound(objects_, id, {}, &MapObject::id);
  return at != objects_.end() && at->id == id ? &*at : nullptr;
}

std::vector<const MapObject*> ObjectMap::of_class(ClassId class_id) const {
  return those_of(objects_, class_id, [](const MapObject&) { return true; });
}

std::vector<const MapObject*> ObjectMap::in_box(const Eigen::AlignedBox3d& box,
                                                std::optional<ClassId> class_id) const {
  if (box.isEmpty()) return {};
  return those_of(objects_, class_id,
                  [&](const MapObject& object) { return meet(object.box, oriented(box)); });
}

std::vector<const MapObject*> ObjectMap::within(const Eigen::Vector3d& p, double radius_m,
                                                std::optional<ClassId> class_id) const {
  const auto distance_m = [&](const MapObject* object) {
    return (object->box.centre() - p).norm();
  };
  std::vector<const MapObject*> found = those_of(
      objects_, class_id, [&](const MapObject& object) { return distance_m(&object) <= radius_m; });
  std::ranges::stable_sort(found, {}, distance_m);
  return found;
}

const MapObject* ObjectMap::nearest(const Eigen::Vector3d& p,
                                    std::optional<ClassId> class_id) const {
  const auto all = within(p, std::numeric_limits<double>::infinity(), class_id);
  return all.empty() ? nullptr : all.front();
}

}  // namespace mapscore
