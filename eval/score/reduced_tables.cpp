// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/reduced_tables.hpp"

namespace mapscore::eval {

ClassTable instance_table(const ClassTable& table) {
  ClassTable reduced;
  reduced.classes.clear();
  reduced.instances.clear();
  for (const Instance& instance : table.instances) {
    const SemanticClass& semantic = table.classes.at(instance.class_id);
    reduced.classes.push_back({instance.id, instance.name, semantic.colour, semantic.detect});
    reduced.instances.push_back({instance.id, instance.name, instance.id});
  }
  return reduced;
}

ClassTable geometry_table(const ClassTable& table) {
  ClassTable reduced;
  reduced.classes.push_back({kSurfaceClass, "surface", {200, 200, 200}, true});
  reduced.instances = table.instances;
  for (Instance& instance : reduced.instances) instance.class_id = kSurfaceClass;
  return reduced;
}

MapSnapshot geometry_map(const MapSnapshot& map) {
  std::vector<MapVoxel> voxels = map.voxels();
  for (MapVoxel& voxel : voxels) voxel.best_class = voxel.occupied ? kSurfaceClass : kBackground;
  return MapSnapshot(std::move(voxels));
}

}  // namespace mapscore::eval
