// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/objects/map_object.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// An object map on disk (docs/objects.md): its objects, ascending by id, in a map frame that lies
/// in the scene's world as a study's does.
struct ObjectFile {
  Eigen::Vector3d map_origin_m = Eigen::Vector3d::Zero();
  double map_yaw_deg = 0.0;
  std::vector<MapObject> objects;

  [[nodiscard]] Pose T_world_map() const;
};

/// The text of objects.yaml; classes by their names in `table`. Throws Error when an object has no
/// class of the table.
[[nodiscard]] std::string object_text(const ObjectFile& file, const ClassTable& table);

/// Throws Error with file, line and key when the file is missing or broken, has an unknown key or
/// class, or a value out of range.
[[nodiscard]] ObjectFile read_objects(const std::filesystem::path& path, const ClassTable& table);

/// An object map as a scene that MuJoCo loads, in the scene's world: a body CLASS_ID an object, in
/// the colour of its class. Its geom is the model where that names a mesh (.obj, .stl, .msh; at its
/// own size), its body what an MJCF file holds where it names one (.xml), else the box, at least 1
/// mm thick on each axis, which MuJoCo needs. Files of models stay where they are: paths are
/// written as the map has them. Throws Error naming the object when its model is of another kind or
/// it has no class of the table.
[[nodiscard]] std::string object_mjcf(const ObjectFile& file, const ClassTable& table);

/// An object map as triangles for CloudCompare and MeshLab: ascii PLY in the map frame, 8 vertices
/// (x y z red green blue, object id) and 12 faces, outwards, an object; its model is not looked at.
/// Throws Error as object_mjcf.
[[nodiscard]] std::string object_ply(const std::vector<MapObject>& objects,
                                     const ClassTable& table);

}  // namespace mapscore::eval
