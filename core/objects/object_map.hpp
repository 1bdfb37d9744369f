// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/objects/box_depth.hpp"
#include "core/objects/map_object.hpp"

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace mapscore {

/// When a detection may be an object of the map: same class, and centres within `max_distance_m` or
/// boxes that share `min_overlap` of the smaller one, each widened by `margin_m` on every side, so
/// that flat boxes have a volume.
struct AssociationGate {
  double max_distance_m = 0.05;
  double min_overlap = 0.25;
  double margin_m = 0.025;
};

struct ObjectMapParams {
  AssociationGate gate;
  BoxMerge update;
  double merge_overlap = 0.5;  ///< share of the smaller box from which two objects are one
  Visibility visibility;
  int max_age = 5;  ///< an object that reaches this age is removed
};

/// What one frame changed: ids, ascending. Where two objects became one, `merged` lists the id that
/// was given up.
struct ObjectChanges {
  std::vector<ObjectId> added, updated, merged, missed, removed;
};

/// The object map of [N]: a collection of <type, pose, size, model> in the map frame
/// (docs/objects.md). Deterministic: objects stand in the order of their ids, which count up from 1
/// in the order of adding. Not safe to change from several threads.
class ObjectMap {
 public:
  /// `class_count`: classes of the table, background included. Throws Error when a parameter is out
  /// of range.
  explicit ObjectMap(std::size_t class_count, const ObjectMapParams& params = {});

  /// Takes in what one frame says: associates, merges or adds, and, where the frame's depth image
  /// is given, ages what should have been seen and was not. Throws Error naming the detection when
  /// one has no class of the table, a box that is not finite or whose axes are no rotation, or a
  /// score outside (0, 1], and when the stamp is not finite; the map is unchanged then.
  ObjectChanges integrate(std::span<const ObjectDetection> detections, double stamp_s,
                          const PosedDepth* view = nullptr);

  /// Adds an object as it is. Its id: the next, or `object.id` where that is above all given so
  /// far. Throws Error as integrate, and when the id was given before.
  ObjectId add(MapObject object);
  /// One more detection of an object, whatever the gate says. Throws Error when there is no such
  /// object, or as integrate.
  void update(ObjectId id, const ObjectDetection& detection, double stamp_s);
  /// Throws Error when there is no such object.
  void remove(ObjectId id);

  /// Ascending by id.
  [[nodiscard]] const std::vector<MapObject>& objects() const { return objects_; }

  // Queries by class (none: every class) and place; what they give is valid until the map changes.

  [[nodiscard]] const MapObject* find(ObjectId id) const;
  /// Ascending by id.
  [[nodiscard]] std::vector<const MapObject*> of_class(ClassId class_id) const;
  /// Objects whose box meets an axis-aligned box of the map frame; ascending by id.
  [[nodiscard]] std::vector<const MapObject*> in_box(const Eigen::AlignedBox3d& box,
                                                     std::optional<ClassId> class_id = {}) const;
  /// Objects whose centre lies within a distance of p, nearest first, ties by id.
  [[nodiscard]] std::vector<const MapObject*> within(const Eigen::Vector3d& p, double radius_m,
                                                     std::optional<ClassId> class_id = {}) const;
  /// The nearest centre, ties to the lower id; none in an empty map.
  [[nodiscard]] const MapObject* nearest(const Eigen::Vector3d& p,
                                         std::optional<ClassId> class_id = {}) const;

 private:
  void check(const ObjectDetection& detection, std::size_t position) const;
  [[nodiscard]] std::vector<std::optional<std::size_t>> associate(
      std::span<const ObjectDetection> detections) const;
  [[nodiscard]] std::vector<MapObject>::iterator require(ObjectId id);
  void tell_apart(const std::set<ObjectId>& seen);
  void pass_on_apart(ObjectId gone, ObjectId kept);
  void merge_overlapping(ObjectChanges& changes);
  void age(const std::set<ObjectId>& seen, const PosedDepth& view, ObjectChanges& changes);

  std::size_t class_count_;
  ObjectMapParams params_;
  std::vector<MapObject> objects_;
  ObjectId next_ = 1;
  std::set<std::pair<ObjectId, ObjectId>> apart_;  ///< once detected in one frame, as two
};

}  // namespace mapscore
