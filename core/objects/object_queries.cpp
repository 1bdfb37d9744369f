// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/object_map.hpp"

#include <algorithm>

namespace mapscore {
namespace {

bool is_of(const MapObject& object, std::optional<ClassId> class_id) {
  return !class_id || object.class_id == *class_id;
}

}  // namespace

const MapObject* ObjectMap::find(ObjectId id) const {
  const auto at = std::lower_bound(objects_.begin(), objects_.end(), id,
                                   [](const MapObject& o, ObjectId key) { return o.id < key; });
  return at != objects_.end() && at->id == id ? &*at : nullptr;
}

std::vector<const MapObject*> ObjectMap::of_class(ClassId class_id) const {
  std::vector<const MapObject*> found;
  for (const MapObject& object : objects_)
    if (object.class_id == class_id) found.push_back(&object);
  return found;
}

std::vector<const MapObject*> ObjectMap::in_box(const Eigen::AlignedBox3d& box,
                                                std::optional<ClassId> class_id) const {
  std::vector<const MapObject*> found;
  if (box.isEmpty()) return found;
  for (const MapObject& object : objects_)
    if (is_of(object, class_id) && meet(object.box, oriented(box))) found.push_back(&object);
  return found;
}

std::vector<const MapObject*> ObjectMap::within(const Eigen::Vector3d& p, double radius_m,
                                                std::optional<ClassId> class_id) const {
  const auto distance_m = [&](const MapObject* object) {
    return (object->box.centre() - p).norm();
  };
  std::vector<const MapObject*> found;
  for (const MapObject& object : objects_)
    if (is_of(object, class_id) && distance_m(&object) <= radius_m) found.push_back(&object);
  std::stable_sort(found.begin(), found.end(), [&](const MapObject* a, const MapObject* b) {
    return distance_m(a) < distance_m(b);
  });
  return found;
}

const MapObject* ObjectMap::nearest(const Eigen::Vector3d& p,
                                    std::optional<ClassId> class_id) const {
  const MapObject* nearest = nullptr;
  for (const MapObject& object : objects_)
    if (is_of(object, class_id) &&
        (!nearest || (object.box.centre() - p).norm() < (nearest->box.centre() - p).norm()))
      nearest = &object;
  return nearest;
}

}  // namespace mapscore
