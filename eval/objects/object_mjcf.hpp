// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/objects/object_file.hpp"

#include <string>
#include <vector>

namespace mapscore::eval {

/// An object map as a scene that MuJoCo loads, in the scene's world: a body CLASS_ID an object, in
/// the colour of its class. Its geom is the model where that names a mesh (.obj, .stl, .msh; at its
/// own size), its body what an MJCF file holds where it names one (.xml), else the box, at least
/// `least_size_m` thick on each axis, which MuJoCo needs. Files of models stay where they are:
/// paths are written as the map has them. Throws Error naming the object when its model is of
/// another kind or it has no class of the table.
[[nodiscard]] std::string object_mjcf(const ObjectFile& file, const ClassTable& table,
                                      double least_size_m = 1e-3);

/// An object map as triangles for CloudCompare and MeshLab: ascii PLY in the map frame, 8 vertices
/// (x y z red green blue, object id) and 12 faces, outwards, an object; its model is not looked at.
/// Throws Error as object_mjcf.
[[nodiscard]] std::string object_ply(const std::vector<MapObject>& objects,
                                     const ClassTable& table);

}  // namespace mapscore::eval
