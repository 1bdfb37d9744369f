// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/objects/map_object.hpp"

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mapscore::eval {

/// One object that is really there, in the map frame.
struct TrueObject {
  InstanceId instance = 0;
  ClassId class_id = kBackground;
  ObjectBox box;
};

/// When an object of the map may stand for a true one: same class, and boxes that share at least
/// `min_iou`, each widened by `margin_m` on every side, or centres within `max_distance_m`.
struct ObjectMatchGate {
  double min_iou = 0.1;
  double max_distance_m = 0.1;
  double margin_m = 0.025;
};

/// Of one pair that was matched.
struct ObjectMatch {
  std::size_t truth = 0, object = 0;  ///< positions
  double iou = 0.0;                   ///< of the widened boxes
  double centre_m = 0.0;              ///< distance of the centres
  Eigen::Vector3d size_m;             ///< object's size minus the truth's, along the map's axes
  Eigen::Vector3d size_share;         ///< the same over the truth's, widened as for the IoU
};

/// Matches of `objects` with `truth`: pairs that pass the gate, taken from the greatest IoU on,
/// then the least distance of centres; ties to the lower position of truth, then object. Each once.
/// Ascending by truth. Sizes are those of the bounds along the map's axes.
[[nodiscard]] std::vector<ObjectMatch> match_objects(std::span<const MapObject> objects,
                                                     std::span<const TrueObject> truth,
                                                     const ObjectMatchGate& gate = {});

/// Counts of one class or of several together, and sums of errors over the found ones.
struct ObjectCounts {
  std::int64_t truth = 0, found = 0, objects = 0;
  double iou_sum = 0.0, centre_sum_m = 0.0, centre_max_m = 0.0;
  Eigen::Vector3d size_sum_m = Eigen::Vector3d::Zero();      ///< of absolute errors, by axis
  Eigen::Vector3d size_share_sum = Eigen::Vector3d::Zero();  ///< of absolute shares, by axis

  [[nodiscard]] std::int64_t missed() const { return truth - found; }
  [[nodiscard]] std::int64_t falsely() const { return objects - found; }
  /// A sum over the found ones as their mean; none where nothing was found.
  [[nodiscard]] std::optional<double> mean(double sum) const;
  ObjectCounts& operator+=(const ObjectCounts& other);
};

/// By class id.
[[nodiscard]] std::vector<ObjectCounts> score_objects(std::span<const MapObject> objects,
                                                      std::span<const TrueObject> truth,
                                                      std::size_t class_count,
                                                      const ObjectMatchGate& gate = {});

}  // namespace mapscore::eval
