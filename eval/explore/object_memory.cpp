// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/explore/object_memory.hpp"

#include "core/mapping/mapper.hpp"

namespace mapscore::eval {

void ObjectMemory::add(const std::vector<Segment>& segments, const Sight& sight,
                       const PoseBelief& belief, double stamp_s) {
  const Calibration& believed = sight.believed();
  const Pose T_map_depth = mean_sensor_pose(belief, believed);
  const PosedDepth view{believed.depth, T_map_depth, believed.range_min_m, believed.range_max_m,
                        sight.depth()};
  const ObjectChanges changes =
      map_.integrate(object_detections(segments, T_map_depth, {}), stamp_s, &view);
  for (const ObjectId id : changes.updated)
    if (missed_.contains(id)) found_again_.insert(id);
  missed_.insert(changes.missed.begin(), changes.missed.end());
}

std::vector<LookAgain> ObjectMemory::again() const {
  std::vector<LookAgain> places;
  for (const MapObject& object : map_.objects())
    if (object.age > 0) places.push_back({object.box.centre(), priority_voxels_});
  return places;
}

}  // namespace mapscore::eval
